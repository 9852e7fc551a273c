"""The course's calculators: functions of numbers that need only NumPy; no robot is stored and no model is built.

Mobility of linkages:

- `pairs`: constraints of each kind of kinematic pair, in the plane and in space.
- `topology`: links and pairs as a graph: loops, bridges, open and closed chains.
- `mechanism`: links and pairs from a description, joints of more than two links split; idle freedoms.
- `mobility`: the formula, a check of it by loops, and its warnings; `mobility_steps`: its worked solution.
- `screws`: the mobility of a linkage at one posture, from the positions of its axes.
- `spaces`: joint space and task spaces, branches and redundancy.

Orientations and frames:

- `rotations`: rotations about an axis or a coordinate axis; distance of a matrix from a rotation.
- `orientation`: an orientation in every notation, with both branches and degenerate cases.
- `composition`: frames composed about moving or fixed axes, inverted, and applied to points.

Actuators, sensors, planar arms:

- `dc_motor`: the brushed motor, steady state and limits; `motor_response`: its exact response to a step.
- `gear`: a reduction seen from either side, and the ratio of greatest acceleration.
- `pwm`: averages and ripple of a switched voltage.
- `encoders`: resolution; `quadrature`: counts and direction from two channels; `gray`: the Gray code.
- `planar`: primary and secondary workspace of planar arms.

- `steps`: a worked solution as titles, sentences and formulas.
"""
