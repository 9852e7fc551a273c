"""HTTP only: parse, call the core, shape the answer.

- `problems`: every error as RFC 9457; the one table from error class to status.
- `payloads`, `npy`: bodies in and answers out: JSON and NumPy's npy, strictly.
- `bodies`: how many bytes of large bodies are held at a time.
- `routes`: a route that FastAPI documents and that runs without its overhead.
- `access`: checks of every request (hosts, origins, keys), headers of every answer, the log of requests.
- `dispatch`: routes and answers of all operations, made of the table of endpoints.
- `pool_client`: sends requests to the worker pool; `blocking_pool_client`: the same for code that is no coroutine.
  `task`: what a worker does; `context`: what it needs for that.
- `long_work`, `long_works`: operations as jobs; `inverse_job`, `trajectory_job`, `workspace`: what each computes.
- `robots`, `robot_table`, `derive`, `jobs`, `service`, `documentation`: the other resources; `skeleton`: shapes for a
  robot without visuals.
"""
