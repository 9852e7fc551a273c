"""The service's own processes: copies of one that has loaded everything, started within milliseconds.

- `copies`: starts a process, and ends it without leftovers.
- `fork_server`: what runs in the process that is copied.
- `pages`: returns memory that only loading needed.
- `turns`: whose turn it is, where clients share processes or other places.
"""
