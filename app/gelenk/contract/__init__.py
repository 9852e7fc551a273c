"""What travels over the wire: units in every description, finite numbers only, unknown fields refused.

- `common`: the strict base of all payloads, names, chains.
- `pose`: poses in every notation; `pose_arrays`: the same as arrays.
- `dh`: Denavit-Hartenberg tables.
- `compare`: requests and answers of comparisons of such tables with chains.
- `robots`: robots, as listed, described and uploaded; the `robot.json` of a folder; `shapes`: what is
  drawn of links that show nothing.
- `kinematics`: requests and answers of forward kinematics and the Jacobian.
- `ik`: requests and answers of inverse kinematics.
- `velocity`, `singularity`, `manipulability`, `statics`, `dynamics`, `workspace`: the other questions to a robot.
- `trajectory`, `trajectory_answer`: requests and answers of motions.
- `course_…`: the calculators of the course. `jobs`: long work.
- `problem`: an error. `health`: what a monitor gets.
"""
