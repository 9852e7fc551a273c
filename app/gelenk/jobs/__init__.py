"""Long work, beside the requests: jobs on disk, and what they compute.

A kind of job is a function of the folder that holds the job's request: it computes parts by `Run.map` and combines
their results. A part is a function of its argument alone, so parts may run anywhere, at any time and in any order.
Finished parts are on disk, and a job that resumes after a restart does not compute them again.

- `job`: what a job is, from its beginning to its end.
- `store`: the jobs of all processes of the service: their `database`, and a folder each; `parts`: what is finished of
  them; `owners`: which of these processes live; `earlier`: imports the jobs of earlier versions.
- `workers`: has parts computed by the worker pool.
- `cluster`: the same on a Ray cluster; `driver`: the process that speaks to it, the only place that knows Ray.
- `run`: a job while it is done; `runner`: takes jobs in and up again, has them done, and cancels them.
- `robot_files`: the robot of a job.
- `workspace`: the workspace of a robot as a job; `workspace_picture`: its picture.
"""
