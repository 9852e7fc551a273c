"""Inverse kinematics as it is done by hand, with a standard DH table and the numbers of a target.

- `arm`: the table with the axes turned as the lecture has them, and what a solution is.
- `planar`: two links, by the law of cosines; arms in a plane, SCARA.
- `shoulder`: the first axis, and an elbow or a slide behind it.
- `wrist`: the last three axes in a point, by ZYZ. `parallel`: three parallel axes. `by_hand`: chooses among them.
- `agreement`: compares their solutions with those that are sent; how the numbers of other arms were found.
- `contact`: which solutions touch something.
"""
