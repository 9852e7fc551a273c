"""Runs requests in worker processes.

- `pool_client`: sends requests to the worker pool. `task`: runs in a worker.
"""
