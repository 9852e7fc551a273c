"""What a robot can touch: bodies of its links and around it, contacts between them, and how far they are apart.

Map:
- `bodies`: the convex pieces that everything here is about; `shapes` makes them of meshes, and covers them by spheres.
- `robot_bodies`: the pieces of a robot's links.
- `pairs` of these links that are looked at; `link_pairs` finds which need no look, and reads an SRDF.
- `scene`: objects around the robot. `cell`: both together, with the clearance that is asked for.
- `contact`: which of all these touch, which links always do, and how far apart they are.
"""
