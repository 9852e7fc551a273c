"""Runs requests in worker processes.

- `pool_client`: sends requests to the worker pool; `blocking_pool_client`: the same for code outside coroutines.
- `task`: runs in a worker. `fair_semaphore`: lets costly requests take turns.
"""
