"""Mistakes about forces and torques."""

from gelenk.language import marked

MISTAKES = {
    "jacobian_for_transpose": marked("Torques follow from a force by the transpose of J; J itself is for velocities."),
    "components_exchanged": marked("The components of the force are exchanged."),
    "vertical_lever": marked("The lever arm of a weight is the horizontal distance, not the height."),
    "mass_for_weight": marked("The weight is the mass times g."),
    "inverse_without_transpose": marked("A force follows from torques by the inverse of the transpose of J."),
    "transpose_for_its_inverse": marked("The transpose leads from a force to torques; this way needs its inverse."),
    "sum_for_norm": marked("The size of a vector is the root of the sum of squares, not the sum of the components."),
    "lever_for_thrust": marked("A prismatic joint bears the force along its axis; there is no lever arm."),
    "lever_forgotten": marked("A torque is a force times its lever arm."),
    "along_and_across": marked("The thrust bears the force along the arm, the torque what is across it."),
    "complement": marked("This is the orthogonal complement of the space."),
    "joints_for_tip": marked("The space of the joints and that of the tip are exchanged."),
    "moment_forgotten": marked("The moment at the tip acts on every revolute joint too."),
    "signs_of_power": marked("Torque and velocity of a joint can have opposite signs: then its motor takes power in."),
    "smallest_torque": marked("The joint with the largest torque reaches its limit first."),
}
