"""Worker processes that run requests and parts of jobs, so that a slow or crashing call affects only its own process.

- `pool`: the pool of processes, with a bounded queue and a deadline for each call.
- `workers`: starts the workers of one priority, assigns them to clients in turn, and replaces them.
- `worker`: main loop of a worker process, with limits on memory and processor time.
"""
