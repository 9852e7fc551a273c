"""Worker processes for requests that may take long or crash, and for parts of jobs; each is replaced alone.

- `pool`: takes calls within a bounded queue and a deadline.
- `workers`: the workers of one priority: handed out in turns, asked, killed and replaced.
- `worker`: what such a process runs: one call after the other, within limits of memory and processor time.
"""
