"""Tables and descriptions turned into each other.

- `convert`: DH table → URDF; standard ↔ modified. `housings`: bodies for one of an arm that is built.
- `from_chain`: chain → DH table, by the geometry of its axes.
- `screws`: chain → product of exponentials; `from_screws`: product of exponentials → description.
- `columns`: their names and order.
"""
