"""The request for a trajectory and its result, as plain data.

- `problem`: what is requested, and the motion with its audit. `parts`: a part of it, planned by itself.
"""
