"""What a robot is: descriptions, tables, chains, poses; no HTTP, no settings.

- `errors`: every error of the core, as a tree.
- `arrays`: array types; `compilation`: the decorators for compiled functions.
- `poses`: SO(3) and SE(3) as matrices; `notations`: in every notation.
- `dh`: Denavit-Hartenberg tables and their product of transforms.
- `urdf`: untrusted XML → checked description → XML of our own; `unexpanded`: what is left of a xacro in it.
- `chain`: base → tip as flat arrays for the kernels.
- `convert`: DH table → URDF; standard ↔ modified.
- `dh_from_chain`: chain → DH table, by the geometry of its axes.
- `appearance`: bodies of a table's links, for display and mass; `skeleton`: of links without any.
- `origins`: transforms as URDF writes them.
- `robot`: description, chains and the Pinocchio model together.
"""
