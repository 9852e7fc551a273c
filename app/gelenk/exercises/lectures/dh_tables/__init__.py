"""Denavit-Hartenberg tables, standard and Craig's.

- `rows`: from a row to its matrix, and back; the pose of an arm.
- `tables`: from Craig's table to the standard one, and an exam: from the axes of an arm to its table and its poses.
"""
