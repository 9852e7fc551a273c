"""Robot models: descriptions, DH tables, chains and poses; independent of HTTP and settings.

- `errors`: every error of the core, as a class hierarchy.
- `arrays`: array types; `compilation`: decorators for compiled functions.
- `poses`: SO(3) and SE(3) as matrices; `notations`: conversion to and from other notations.
- `dh`: Denavit-Hartenberg tables and their products of transforms.
- `urdf`: untrusted XML → checked description → XML written by this package; `unexpanded`: detects xacro in it.
- `chain`: the path from base to tip as flat arrays for the kernels.
- `convert`: DH table → URDF; standard ↔ modified.
- `dh_from_chain`: chain → DH table, from the geometry of its axes.
- `appearance`: simple bodies for the links of a DH table; `skeleton`: for URDF links without shapes.
- `origins`: homogeneous transforms as URDF origins.
- `robot`: description, chains and Pinocchio model together.
"""
