"""MuJoCo's format: read as a description of links and joints, and written.

- `reader`: the tree of bodies and joints. `model`: includes and meshes; `scope`: defaults and units where an element
  stands; `copies`: what is replicated or attached; `equalities`: joints that follow others; `masses`: of geoms;
  `values`: numbers.
- `writer`: to MuJoCo.
"""
