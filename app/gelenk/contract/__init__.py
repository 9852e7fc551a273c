"""The operations of the API, each declared once, and their payloads: units in every description, only finite numbers.

- `endpoint`: the declaration of an operation. `endpoints`: the table of all, from which routes, client, command line,
  scopes and reference are built. A module with an operation's name has its request, its answer and its `ENDPOINT`.
  `resources`: operations on stored robots and jobs, and about the service.
- `common`: the strict base of all payloads, names, chains. `kinematics`: configurations, matrices, certificates.
  `options`: fields that requests share, quantities.
- `pose`: poses in every notation. `dh`: Denavit-Hartenberg tables.
- `course_motion`: shared by several calculators of the course.
- `robots`: robots as listed, described and uploaded; shapes drawn for links without visuals. `robot_file`: the
  `robot.json` of a folder. `jobs`: long work. `problem`: an error, and the answer for a monitor.
"""
