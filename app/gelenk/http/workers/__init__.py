"""Requests that a worker process answers.

- `pool_client`: sends requests to the worker pool; `blocking_pool_client`: the same for code outside coroutines.
- `task`: what a worker runs; `context`: the robots and limits it uses. `places`: turns among costly requests.
"""
