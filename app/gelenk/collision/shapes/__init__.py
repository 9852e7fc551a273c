"""Convex pieces of shapes.

- `meshes` reads files of triangles, Collada's by `collada`.
- `pieces` cuts their `surfaces` by `planes` into nearly convex parts, and takes the `hulls` of these.
- `covers` puts spheres around any piece, `balls` a single one; `cover_excess`: how much these add to it.
- `clouds` makes pieces of points, `height_maps` of terrain.
"""
