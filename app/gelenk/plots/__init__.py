"""Pictures drawn by matplotlib, as SVG, PNG or PDF, independent of how they are delivered.

- `figure`: one style for all pictures, and rendering to bytes, the same bytes for the same figure.
- `arm`: an arm as a line through its joints.
- `profiles`: a motion over time, with its velocity, acceleration, jerk and limits.
- `ellipsoids`: the arm with the velocity and force ellipse at its tip.
- `dh_frames`: a DH table's frames, from the `dh_scene` in space, with `labels` where they cover nothing.
- `fly_over`, `planar_workspace`: a corner passed without a stop; the workspaces of a planar arm.
- `motion`: motions along a line, and postures along any motion.
- `course`: pictures that explain the course.
- `workspace`: the workspace seen along the axes, coloured by how well the arm reaches it.

Loading matplotlib takes a third of a second, so these modules are imported only when a picture is requested.
"""
