"""Child processes of the service, forked within milliseconds from a process that has loaded everything.

- `worker_process`: handle of a child process, and client of the fork server.
- `fork_server`: the process that forks the child processes; it gives memory that only loading needed back.
- `wire`: messages between processes, without copies of large buffers.
- `memory`: freed memory that a process keeps for its next request.
- `turns`: a fair queue for clients that share processes or other places.
"""
