"""Pictures: figures drawn by matplotlib, as SVG or PNG; nothing here knows how they travel.

- `figure`: one style for all pictures, and figures turned into bytes, the same bytes for the same figure.
- `arm`: an arm as a line through its joints.
- `profiles`: a motion over time, with its velocity, acceleration and jerk, and the limits.
- `ellipsoids`: the arm with the velocity and force ellipse at its tip.
- `workspace`: what an arm reaches, along the axes, coloured by how well.

Loading matplotlib takes a third of a second, so these modules are imported only when a picture is requested.
"""
