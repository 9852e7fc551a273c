"""Denavit-Hartenberg tables, standard and Craig's.

- `rows`: from a row to its matrix, and back. `forward`: poses. `conventions`: from Craig's table to the standard one.
- `arm`: an exam, from the axes of an arm to its table and its poses.
"""
