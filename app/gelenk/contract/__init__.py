"""The operations of the API, each declared once, and what travels: units in every description, finite numbers only.

- `endpoint`: what an operation is. `endpoints`: the table of all, from which routes, client, command line, scopes and
  reference are made. A module of an operation's name has its request, its answer and its `ENDPOINT`.
- `common`: the strict base of all payloads, names, chains. `kinematics`: configurations, matrices, certificates.
- `pose`: poses in every notation. `dh`: Denavit-Hartenberg tables.
- `quantities`, `course_motion`, `formulas`: what several calculators of the course share.
- `robots`: robots, as listed, described and uploaded; the `robot.json` of a folder; `shapes`: what is drawn of links
  without visuals. `jobs`: long work. `problem`: an error. `health`: what a monitor gets.
"""
