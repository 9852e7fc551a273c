"""HTTP only: parse, call the core, shape the answer.

- `problems`: every error as RFC 9457; the one table from error class to status.
- `payloads`, `npy`: bodies in and answers out: JSON and NumPy's npy, strictly.
- `bodies`: how many bytes of large bodies are held at a time.
- `routes`: a route that FastAPI documents and that runs without its overhead.
- `access`: the door: hosts, origins, keys, headers of every answer, the log of requests.
- `remote`: has requests answered by the crew; `errand`: what its processes are sent to do; `operations`: with what.
- `tally`: what an answer says of itself to the metrics.
- `elsewhere`: the crew for code that is no coroutine.
- `robots`, `dh`, `compare`, `derive`, `service`, `documentation`: the resources; `skeleton`: what is drawn of a robot
  that shows nothing.
- `kinematics`, `inverse`, `velocity`, `singularity`, `manipulability`, `statics`, `dynamics`, `workspace`: questions to
  a robot; `loads` and `velocity_call` read what several of their fields share.
- `trajectory`: motions; `trajectory_request` and `trajectory_limits` read what is asked, `trajectory_samples` and
  `trajectory_answer` tell what came of it.
- `course_…`: the calculators of the course, on `course`; `jobs`: long work.
"""
