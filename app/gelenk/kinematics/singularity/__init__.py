"""Configurations in which the tip loses a direction.

- `report`: lost directions, and the joints that cause the loss, checked with Pinocchio; `kinds` names the singularity.
- `distance` finds the nearest one, `path` those along a path of configurations.
"""
