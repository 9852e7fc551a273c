"""Robot models: descriptions, DH tables, chains and poses; independent of HTTP and settings.

- `arrays`: array types, and vectors as the matrices of their cross products.
- `compilation`: decorators for compiled functions.
- `poses`: SO(3) and SE(3) as matrices; `notations`: conversion to and from other notations, URDF's among them.
- `description`: links, joints and frames; `tree`: checks that they form one.
- `dh`: Denavit-Hartenberg tables and their products of transforms.
- `urdf`: untrusted XML → checked description → XML written by this package; `xml` parses it, and detects xacro in it.
- `formats`: other formats → URDF.
- `chain`: the path from base to tip as flat arrays for the kernels.
- `configuration`: configurations as callers give them → one array in the chain's order.
- `appearance`: simple bodies for links without shapes. `result`: results that are part of an answer.
- `robot`: description, chains and Pinocchio model together.
"""
