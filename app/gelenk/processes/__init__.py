"""Processes of the service: forked from a fork server that has loaded everything, so they start within milliseconds.

- `copies`: starts such processes, and ends them without leftovers.
- `fork_server`: runs in the process that the others are copies of.
- `pages`: returns memory to the system that only loading needed.
- `turns`: lets clients that share processes or other places take turns.
"""
