"""Speed, measured as a ratio in one run against a named peer; `./dev bench [name …]` prints the table.

- `solvers`: inverse kinematics against TRAC-IK and other solvers, arm by arm (`solvers-few`: with few targets).
- `quality`: whether a solution is near where one is, and whether all of them are found.
- `batch`: pose + Jacobian by the kernels against a Python loop over Pinocchio.
- `requests`: one `fk` over HTTP against an empty endpoint, one `ik` against one `fk`.
- `volume`: large batches over HTTP, end to end, with the server's peak memory.
- `jobs`: the same jobs by the processes of this machine and by a Ray cluster on it, their results compared.
- `collision`: contacts and clearances of the Panda among boxes against Coal through Pinocchio.
- `start`: from `./dev serve` to ready.
- `studio`: the page's first visit in a browser at 10 Mbit/s, and what dragging costs.
- `ik`: the first five.
"""
