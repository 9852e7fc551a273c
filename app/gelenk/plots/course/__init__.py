"""Pictures that explain the course: mechanisms, pairs, motors, encoders, planar arms.

- `sketch`: a line drawing without axes, whose labels find places clear of the lines and of each other.
- `gallery`: the pictures that depend on nothing; `titles`: their names. `pairs`: a chart of the kinematic pairs.
- `motor`, `pulses`, `encoders`: a motor, its supply, and the sensor on its shaft.
- `mechanism`: links and pairs, in their posture or as a graph.
- `planar_arm`: an arm in the plane with its coordinates, its triangle, its lever arms.
- `triangle`: triangles with their sides and angles.

Each function takes plain numbers and returns a figure; texts are in the current language.
"""
