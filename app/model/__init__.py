"""What a robot is: descriptions, tables, chains, poses; no HTTP, no settings.

- `errors`: every error of the core, as a tree.
- `arrays`: array types and the decorators for compiled functions.
- `poses`: SO(3) and SE(3) in every notation.
- `dh`: Denavit-Hartenberg tables and their product of transforms.
- `urdf`: untrusted XML → checked description → XML of our own.
- `convert`: DH table → URDF.
- `chain`: base → tip as flat arrays for the kernels.
- `robot`: description, chains and the Pinocchio model together.
"""
