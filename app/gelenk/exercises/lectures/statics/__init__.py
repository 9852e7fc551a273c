"""Statics: joint torques under a force, forces of torques, and the four subspaces.

- `two_links`: two joints under a force or a weight. `three_links`: what a stretched arm can do and bear, and an exam.
"""
