"""The course's calculators: numbers in, numbers out; no robot is kept and no model is built.

- `mobility`: linkages. `orientation`: rotations and frames. `actuators`: motors, gears and encoders. `motion`: worked
  solutions of time laws, splines and fly-overs. `cartesian`: lines of a point or a tip, and trajectories. `planar`:
  workspaces of planar arms. `inverse`: inverse kinematics. `velocity`: Jacobians, forces, singularities. `dynamics`:
  equations of motion.
- `steps`: a worked solution as titles, sentences and formulas.
"""
