"""Robots as resources.

- `robots`: the collection and its members; `table`: a robot's DH table; `meshes`: its files.
- `skeleton`: shapes for a robot without visuals.
"""
