"""The HTTP layer: parse requests, call the core, build responses.

- `problems`: every error as RFC 9457 problem details, with the one table from error class to status.
- `payloads`, `npy`: read request bodies strictly and write responses, as JSON and as NumPy's npy.
- `bodies`: limits how many bytes of large request bodies are held at a time.
- `routes`: a route that FastAPI documents but that runs without FastAPI's overhead.
- `access`: checks of every request (hosts, origins, keys), headers of every response, the request log.
- `dispatch`: routes and responses of all operations, built from the table of endpoints.
- `pool_client`: sends requests to the worker pool; `blocking_pool_client`: the same for code outside coroutines.
  `task`: what a worker runs; `context`: the robots and limits it uses.
- `long_work`, `long_works`: operations as jobs; `inverse_job`, `trajectory_job`, `workspace`: what each job computes.
- `robots`, `robot_table`, `derive`, `jobs`, `service`, `documentation`: the other resources; `skeleton`: shapes for a
  robot without visuals.
"""
