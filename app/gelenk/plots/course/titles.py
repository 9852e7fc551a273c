"""Names and titles of the course's pictures; loads nothing, so that a list of them costs nothing."""

from typing import Final

from gelenk.language import marked

TITLES: Final = {
    "coincident-joints": marked("Coincident joints: k links at a joint are k − 1 pairs"),
    "dc-motor": marked("The circuit of a DC motor, and its shaft"),
    "gray-disc": marked("The disc of an absolute encoder in Gray code"),
    "joint-pairs": marked("Kinematic pairs with their freedoms and constraints"),
    "kinematic-spaces": marked("Actuator space, joint space and task space"),
    "quadrature": marked("Incremental encoder: A leads B when the shaft turns forward"),
    "spherical-wrist": marked("The spherical wrist: three axes that meet at a point"),
}
"""Pictures that depend on nothing. Titles are to be translated where they are used."""

CALCULATED: Final = {
    "bang-coast-bang": ("line", marked("A line by bang-coast-bang: distance, speed and acceleration over time")),
    "counted-lines": ("encoder", marked("Samples of an incremental encoder")),
    "cubic-spline": ("spline", marked("A spline of cubics through way-points")),
    "fly-over": ("fly_over", marked("A fly-over: the corner, σ(t), speed and acceleration")),
    "four-bar": ("mobility", marked("Links and pairs of a mechanism")),
    "lever-arms": ("statics", marked("Kinetostatics: the lever arms of a force at the tip")),
    "operating-point": ("dc_motor", marked("A DC motor with its numbers, and its operating point")),
    "planar-workspace": ("planar_workspace", marked("Primary and secondary workspace of an arm in the plane")),
    "pulse-width-modulation": ("pulse_width_modulation", marked("Pulse-width modulation: voltage and current")),
    "time-law": ("time_law", marked("A cubic time law: position, velocity, acceleration, jerk")),
    "triangle": ("triangle", marked("A triangle with its sides and angles: the law of cosines")),
    "velocity-ellipse": ("manipulability", marked("Velocity and force ellipse of an arm in the plane")),
    "velocity-ellipses": ("pipeline", marked("A line in four steps, with the velocity ellipses along it")),
}
"""Pictures that calculators draw of their own examples: the name of the endpoint, and a title."""
