"""Processes for requests that may take long or crash; each is isolated, and replaced alone.

- `pool`: hands calls to idle processes, within a bounded queue and a deadline; kills and replaces them.
- `worker`: what such a process runs: one call after the other, within limits of memory and processor time.
- `wire`: how an object and large bytes beside it get from one to the other.
"""
