"""Statics: joint torques under a force, forces of torques, and the four subspaces.

- `two_links`: the planar arm under a force or a weight. `polar`: an arm that turns and slides.
- `subspaces`: what a stretched arm can do and bear. `three_links`: an exam.
"""
