"""Worker processes for requests that may take long or crash; each is isolated and replaced on its own.

- `pool`: sends calls to idle processes, with a bounded queue and deadlines; kills and replaces processes.
- `worker`: runs in such a process: one call after another, within limits on memory and processor time.
- `wire`: sends objects and large buffers between the service and the processes.
"""
