"""Speed, measured as a ratio in one run against a named peer; `./dev bench [name …]` prints the table.

- `requests`: one `fk` over HTTP against an empty FastAPI endpoint.
- `batch`: pose + Jacobian by the kernels against a Python loop over Pinocchio.
- `volume`: large batches over HTTP, end to end, with the server's peak memory.
- `start`: from `./dev serve` to ready.
- `ik`: inverse kinematics against TRAC-IK and other solvers, arm by arm (`ik-few`: the same with few targets).
"""
