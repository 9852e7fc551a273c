"""Robots on disk: the catalogue, read-only, and the uploaded ones, one folder each.

- `folders`: durable writing: what is acknowledged is on disk, what is not is invisible.
- `archive`: a zip of one URDF and its meshes, unpacked with suspicion.
- `meshes`: which file a mesh's name means.
- `records`: a robot's folder, read: what it is, where its files are.
- `index`: what the list of robots and the quotas need of each uploaded one, in one file.
- `library`: all robots by name; loaded once, and again when their folder has changed.
"""
