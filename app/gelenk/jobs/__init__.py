"""Long computations outside requests: jobs on disk, the processes that run them, and what they compute.

A kind of job is a function of the folder that holds the job's request: it computes parts by `Run.map` and combines
their results. A part is a function of its argument alone, so parts may run anywhere, at any time and in any order.
Finished parts are on disk, and a job that resumes after a restart does not compute them again.

- `job`: the record of a job, from submission to its final state.
- `store`: the jobs of all processes of the service, in a `database` and one folder each; `parts`: the finished parts of
  a job; `owners`: which processes of the service are alive; `earlier`: import of jobs from earlier versions.
- `workers`: local processes that stay warm, and are replaced when they die or hang.
- `cluster`: the same on a Ray cluster; `driver`: the process that talks to Ray, the only module that knows it.
- `run`: a job while it runs; `runner`: accepts, runs, resumes and cancels jobs.
- `robot_files`: the robot of a job.
- `workspace`: the workspace of a robot as a job; `workspace_picture`: its picture.
"""
