"""Mistakes about ellipsoids and measures of manipulability."""

from gelenk.language import marked

MISTAKES = {
    "cosine_for_sine": marked("The measure has the sine of ϑ₂, not the cosine: it vanishes when the arm is stretched."),
    "angle_of_both": marked("The measure depends on ϑ₂ alone: turning the whole arm does not change it."),
    "pi_forgotten": marked("The area of an ellipse is π times the product of its semi-axes."),
    "area_of_square": marked("w is the product of the semi-axes already; it is not squared."),
    "stretched_for_best": marked("Stretched, the arm has the measure 0; it is largest at a right angle, l₁ l₂."),
    "force_for_velocity": marked("These are the semi-axes of the force ellipse, the reciprocals."),
    "velocity_for_force": marked("This belongs to the velocity ellipse; the tip is strong where it is slow."),
    "columns_for_axes": marked("The norms of the columns are no semi-axes: the columns are not orthogonal."),
    "axis_of_joints": marked("This is a direction of joint velocities; the axes are eigenvectors of J Jᵀ."),
    "joint_direction": marked("This is a direction of torques; the axes are eigenvectors of J Jᵀ, not of Jᵀ J."),
    "minor_for_major": marked("This is the direction of the minor axis."),
    "isotropy_for_condition": marked("The condition number is the larger singular value divided by the smaller one."),
    "shadow_for_reach": marked("So far the shadow of the ellipse reaches; along the direction alone it is less."),
    "ratios_exchanged": marked("The ratios of velocity and force are exchanged."),
    "equal_links": marked("With equal links the columns of J cannot be orthogonal and of equal norm at once."),
    "root_inverted": marked("The second link is the shorter one: l₁ is √2 times as long."),
    "half_link": marked("The links are in the ratio of √2, not of 2."),
    "best_for_isotropic": marked("At a right angle the measure is largest, but the ellipse is no circle."),
    "acute_for_obtuse": marked("cos ϑ₂ = -l₂/l₁ is negative: the angle is obtuse."),
    "last_joint_forgotten": marked("The last joint moves the tip too: its column is missing."),
    "axes_exchanged": marked("The directions are exchanged: the tip is strong where it is slow."),
    "condition_for_isotropy": marked("This is the condition number, the reciprocal."),
    "sine_for_isotropy": marked("The sine of ϑ₂ is in the measure; the isotropy is the ratio of the semi-axes."),
    "eigenvalues_for_axes": marked("The semi-axes are the roots of the eigenvalues of J Jᵀ."),
}
