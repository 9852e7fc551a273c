"""Inverse kinematics as it is done by hand, with a standard DH table and the numbers of a target.

- `arm`: the table with the axes turned as the lecture has them. `elbow`: two links, by the law of cosines.
- `planar`: arms in a plane, SCARA. `shoulder`: the first axis, and an elbow or a slide behind it.
- `wrist`: the last three axes in a point, by ZYZ. `parallel`: three parallel axes. `by_hand`: chooses among them.
- `solution`: what these return. `agreement`: compares it with the solutions that are sent.
- `solver`: how the numbers of other arms were found. `contact`: which solutions touch something.
"""
