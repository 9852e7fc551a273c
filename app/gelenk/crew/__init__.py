"""Processes that answer what may take long or go wrong, each on its own and replaced by itself.

- `crew`: hands calls to idle processes, within a bounded queue and a deadline; kills and replaces them.
- `process`: what such a process runs: one call after the other, within limits of memory and processor time.
- `wire`: how an object and large bytes beside it get from one to the other.
"""
