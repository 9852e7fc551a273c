"""Long work, beside the requests: jobs on disk, the processes that do them, and what they compute.

- `job`: what a job is, from its beginning to its end.
- `shelf`: jobs as folders, which every process of the service reads and writes.
- `workers`: processes that are kept warm, and replaced when they die or hang.
- `runner`: takes jobs in, does them part by part, and cancels them.
- `workspace`: the workspace of a robot as a job.
- `workspace_picture`: its picture.
"""
