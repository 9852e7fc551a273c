"""Long work as jobs.

- `jobs`: the collection and its results; `workspace`: a workspace as a job.
- `long_work`, `long_works`: operations as jobs; `inverse_job`, `trajectory_job`: what each of them computes.
"""
