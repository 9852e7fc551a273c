"""Long work as jobs.

- `jobs`: the collection and its results; `info`: a job in JSON; `workspace`: a workspace as a job.
- `long_work`, `long_works`: operations as jobs; `inverse_job`, `trajectory_job`: what each of them computes.
"""
