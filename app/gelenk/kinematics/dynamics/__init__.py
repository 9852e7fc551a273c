"""Equations of motion, computed twice.

- `dynamics`: M, C, g and torques. `mechanism`: Pinocchio's algorithms, for the variables of a chain.
- `lagrangian`: the check, on `bodies`: sums over bodies from our own Jacobians.
- `torques`: along motions, by `newton_euler` for the planner and by Pinocchio for the audit.
"""
