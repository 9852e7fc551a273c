"""Robots on disk, the read-only catalogue and uploaded ones in a folder each; and scenes, each one file.

- `folders`: durable writing: acknowledged data is on disk, unfinished data is invisible.
- `archive`: unpacks an untrusted zip of one URDF, its meshes and its SRDF; `findings` says what is wrong with these.
- `meshes`: finds the file that a mesh name refers to.
- `records`: reads a robot's folder: its `robot.json` and the paths of its files.
- `derived`: files computed from a robot once.
- `local`: a robot beside the store, of a file of one's own.
- `index`: one file with the data on each uploaded robot that the list of robots and the quotas need.
- `quota`: what one client may store.
- `course_secret`: the secret that decides the numbers of homework.
- `scenes`: all scenes by name.
- `library`: all robots by name, loaded once, and again when their folder has changed.
"""
