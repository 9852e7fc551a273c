"""Tables and descriptions turned into each other.

- `convert`: DH table → URDF; standard ↔ modified.
- `from_chain`: chain → DH table, by the geometry of its axes.
"""
