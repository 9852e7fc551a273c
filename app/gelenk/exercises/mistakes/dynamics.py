"""Mistakes about masses, gravity and equations of motion."""

from gelenk.language import marked

MISTAKES = {
    "steiner_forgotten": marked("The centre of mass moves as well: m l_c² is missing."),
    "own_inertia_forgotten": marked("The links also turn: their inertias about their centres are missing."),
    "sine_for_cosine": marked("Above the horizontal the lever arm of the weight is the cosine."),
    "gravity_forgotten": marked("The torque against gravity is missing."),
    "gravity_helps": marked("Upwards the joint works against gravity: both torques add up."),
    "angle_of_last_link": marked("The second link is inclined by q1 + q2 to the horizontal."),
    "second_link_forgotten": marked("The first joint also carries the second link."),
    "center_for_length": marked("The second joint is at the end of the first link, not at its centre of mass."),
    "coupling_forgotten": marked("The joints are coupled: M is not diagonal."),
    "sine_in_mass": marked("In the mass matrix stands the cosine of q2."),
    "second_inertia_once": marked("The second link turns with both joints: I2 is in every entry of M."),
    "two_of_coriolis": marked("The Coriolis term has the factor 2."),
    "centrifugal_forgotten": marked("The squares of the velocities, centrifugal torques, are missing."),
    "coriolis_forgotten": marked("The product of both velocities, the Coriolis term, is missing."),
    "speeds_forgotten": marked("The torques C q̇ are missing."),
}
