"""The course's calculators: numbers in, numbers out, NumPy alone; no robot is kept and no model is built.

Mobility of linkages:

- `pairs`: what each kind of kinematic pair takes, in the plane and in space.
- `topology`: links and pairs as a graph: loops, bridges, open and closed chains.
- `mechanism`: links and pairs from a description, joints of more than two links split; idle freedoms.
- `mobility`: the formula, a second way to it by loops, and its warnings; `mobility_steps`: the count on the board.
- `screws`: the mobility of a linkage as it stands, from where its axes lie.
- `spaces`: joint space against task spaces, branches against redundancy.

Orientations and frames:

- `rotations`: about an axis or a coordinate; how far a matrix is from one.
- `orientation`: an orientation in every notation, both branches, and what degenerates.
- `composition`: frames composed about moving or fixed axes, inverted, and applied to points.

Actuators, sensors, planar arms:

- `dc_motor`: the brushed motor, steady state and limits; `motor_response`: its exact response to a step.
- `gear`: a reduction seen from either side, and the ratio of best acceleration.
- `pwm`: averages and ripple of a switched voltage.
- `encoders`: resolution; `quadrature`: counts and direction from two channels; `gray`: the Gray code.
- `planar`: primary and secondary workspace of planar arms.

- `steps`: a worked solution as titles, sentences and formulas.
"""
