"""HTTP only: parse, call the core, shape the answer.

- `problems`: every error as RFC 9457; the one table from error class to status.
- `payloads`, `npy`: bodies in and answers out: JSON and NumPy's npy, strictly.
- `bodies`: how many bytes of large bodies are held at a time.
- `routes`: a route that FastAPI documents and that runs without its overhead.
- `access`: checks of every request (hosts, origins, keys), headers of every answer, the log of requests.
- `remote`: sends requests to the crew; `errand`: what its processes do; `operations`: the table of operations.
- `tally`: what an answer adds to the metrics.
- `elsewhere`: the crew for code that is no coroutine.
- `robots`, `dh`, `compare`, `derive`, `service`, `documentation`: the resources; `skeleton`: shapes for a robot without
  visuals.
- `kinematics`, `inverse`, `velocity`, `singularity`, `manipulability`, `statics`, `dynamics`, `workspace`: operations
  on a robot; `loads` and `velocity_call` read what several of their fields share.
- `trajectory`: motions; `trajectory_request` and `trajectory_limits` read the request, `trajectory_samples` and
  `trajectory_answer` shape the answer.
- `course_…`: the calculators of the course, on `course`; `jobs`: long work.
"""
