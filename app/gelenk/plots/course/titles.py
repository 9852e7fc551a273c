"""Names and titles of the pictures that depend on nothing; loads nothing, so that a list of them costs nothing."""

from typing import Final

from gelenk.language import marked

TITLES: Final = {
    "coincident-joints": marked("Coincident joints: k links at a joint are k − 1 pairs"),
    "dc-motor": marked("The circuit of a DC motor, and its shaft"),
    "joint-pairs": marked("Kinematic pairs with their freedoms and constraints"),
    "kinematic-spaces": marked("Actuator space, joint space and task space"),
    "quadrature": marked("Incremental encoder: A leads B when the shaft turns forward"),
    "spherical-wrist": marked("The spherical wrist: three axes that meet at a point"),
}
"""To be translated where they are used."""
