"""The worked solution of a DH table as an answer.

- `derive`: the operation. `lagrangian`: its equations of motion.
"""
