"""What a robot can touch: bodies of its links and around it, contacts between them, and how far they are apart.

Map:
- `bodies`: the convex pieces that everything here is about.
- `meshes` reads files of triangles, Collada's by `collada`; `hulls` makes convex pieces of them, `covers` spheres around
  these.
- `robot_bodies`: the pieces of a robot's links, and `pairs`: which of these links can touch.
- `scene`: objects around the robot.
- `contact`: which of all these touch, and how far apart they are.
"""
