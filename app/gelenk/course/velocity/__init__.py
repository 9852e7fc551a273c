"""Worked solutions of velocity kinematics, from numbers alone.

- `writing`: vectors and matrices in LaTeX. `geometry`: axes and lever arms of a chain, and the columns they give.
- `jacobian_steps`, `tip_motion_steps`: J, its rank and its derivatives; what the tip does when the joints move.
- `inverses`, `inverse_steps`, `null_space_steps`: J#, damping and what a redundant arm does besides.
- `statics_steps`, `ellipsoid_steps`, `iteration_steps`: torques and subspaces, manipulability, a method's iterations.
- `singularity_steps`: the determinant, and what is lost and gained where the rank drops.
"""
