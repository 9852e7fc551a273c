"""Actuators and sensors.

- `dc_motor`: the brushed motor, steady state and limits; `motor_response`: its exact response to a step.
- `gear`: a reduction seen from either side, and the ratio of best acceleration.
- `pwm`: averages and ripple of a switched voltage.
- `encoders`: resolution, and the Gray code; `quadrature`: counts and direction from two channels.
"""
