"""The service's own processes: forked from one that has loaded everything, started within milliseconds.

- `worker_process`: a child process: started, asked, killed.
- `fork_server`: the process that forks them.
- `wire`: messages between processes, with large bytes beside them.
- `pages`: returns memory that only loading needed.
- `turns`: whose turn it is, where clients share processes or other places.
"""
