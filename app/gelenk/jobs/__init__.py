"""Jobs: long computations that run beside the requests and are stored on disk.

Each kind of job is a function of the folder that contains the job's request; it computes parts with `Run.map` and
combines their results. A part depends on its argument alone, so parts may run anywhere, at any time and in any order.
Finished parts are stored on disk, and a job that resumes after a restart does not compute them again.

- `job`: the record of a job; which processes of the service are alive.
- `store`: the jobs of all processes of the service, in a `database` and a folder for each job, within `limits`;
  `parts`: the finished parts of a job.
- `workers`: computes parts in the worker pool.
- `cluster`: computes parts on a Ray cluster; `driver`: the only process that talks to Ray.
- `run`: a job while it runs; `runner`: accepts, runs, resumes and cancels jobs.
- `robot_files`: the robot of a job, stored with its request.
- `workspace_request`: a request for the workspace of a robot, checked and planned. `workspace`: computes it as a job;
  `workspace_picture`: draws it.
"""
