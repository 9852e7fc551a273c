"""Meshes for pictures: small GLB files of what a mesh file looks like, never for contacts or export.

- `stored`: the small file of a robot's mesh, made once in a worker and then read from disk.
- `colours`: what a Collada file says about colours, where a picture needs no more.
- `simplify`: fewer triangles for the same shape. `normals`: how light falls on it. `glb`: the file format.
"""
