"""Workspaces of planar arms: what is reached with one orientation, and what with all.

- `rings`: the two workspaces of two and of three links. `points`: a point, with which orientations it is reached.
"""
