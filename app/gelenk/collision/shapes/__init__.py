"""Convex pieces of shapes.

- `meshes` reads files of triangles, Collada's by `collada`.
- `hulls` makes convex pieces of them.
- `covers` puts spheres around any piece.
"""
