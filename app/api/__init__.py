"""HTTP only: parse, call the core, shape the answer.

- `problems`: every error as RFC 9457; the one table from error class to status.
- `payloads`: bodies in: JSON and NumPy's npy, strictly.
- `routes`: a route that FastAPI documents and that runs without its overhead.
- `isolated`: a process of its own, with a deadline, for work that holds the GIL.
- `robots`, `dh`, `compare`, `derive`, `kinematics`, `inverse`, `service`, `documentation`: the resources.
"""
