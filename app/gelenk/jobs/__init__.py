"""Long work, beside the requests: jobs on disk, the processes that do them, and what they compute.

A kind of job is a function of the folder that its request is kept in: it hands out parts by `Run.map`, and puts their
results together. A part is a function of its argument alone, so that it may be computed anywhere, at any time and in
any order; those that are finished are on disk, and a job that is taken up after a restart does not do them again.

- `job`: what a job is, from its beginning to its end.
- `store`: the jobs of all processes of the service: their `database`, and a folder each; `parts`: what is finished of
  them; `owners`: which of these processes live; `earlier`: imports the jobs of earlier versions.
- `workers`: processes that are kept warm, and replaced when they die or hang.
- `cluster`: the same on a Ray cluster; `driver`: the process that speaks to it, the only place that knows Ray.
- `run`: a job while it is done; `runner`: takes jobs in and up again, has them done, and cancels them.
- `robot_files`: the robot of a job.
- `workspace`: the workspace of a robot as a job.
- `workspace_picture`: its picture.
"""
