"""Mistakes with Denavit-Hartenberg tables and products of transforms."""

from gelenk.language import marked

MISTAKES = {
    "alpha_sign": marked("The sign of α is wrong: it turns z(i-1) into z(i), counter-clockwise about x(i)."),
    "a_and_d_exchanged": marked("Exchanged are a, along x(i), and d, along z(i-1)."),
    "angles_exchanged": marked("Exchanged are α, about x(i), and ϑ, about z(i-1)."),
    "offset_forgotten": marked("Not all angles ϑ are 0 at the zeros of the joints."),
    "craig_for_standard": marked("This is Craig's table: there a and α are those of the row before."),
    "craig_product": marked("This is Craig's order, first about x and then about z; the standard is the other one."),
    "degrees_in_radians": marked("Sine and cosine were computed of degrees as if they were radians."),
    "inverse_transform": marked("This is the inverse: the transform the other way round."),
    "distance_forgotten": marked("A distance is missing: the last column has a cos ϑ, a sin ϑ and d."),
    "quadrant": marked("The quadrant is wrong: use atan2 of sine and cosine, not the tangent alone."),
    "projection_for_length": marked("This is a cos ϑ, an entry of the matrix; a is the length of (a cos ϑ, a sin ϑ)."),
    "product_reversed": marked("The product has the wrong order: T = A_1 A_2 A_3, from the base to the tip."),
    "absolute_angles": marked("The angles are relative: the last link is inclined by the sum of both."),
    "lengths_exchanged": marked("The lengths of the links are exchanged."),
    "first_joint_still": marked("The first joint turns the whole arm about the vertical; here it does not."),
    "copied_table": marked("This is the table as it was given: the other convention has other rows."),
}
