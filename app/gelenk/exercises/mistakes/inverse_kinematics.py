"""Mistakes of solving an arm by hand."""

from gelenk.language import marked

MISTAKES = {
    "inner_for_outer": marked("The joint's angle is π minus the angle between the links: 0 where they are stretched."),
    "two_of_cosines_forgotten": marked("The law of cosines has 2 times the product of both sides."),
    "cosine_sign": marked("The law of cosines has a minus sign: c² = a² + b² - 2 a b cos γ."),
    "angle_at_tip": marked("This is the angle at the tip, opposite to the first link."),
    "other_elbow": marked("Each first angle stands with the second angle of the other elbow."),
    "y_before_x": marked("The coordinates of the point are exchanged: it is atan2(y, x)."),
    "third_link_left_out": marked("The law of cosines was used for the tip; it is for the third axis, a link back."),
    "third_axis_beyond": marked("The third axis is back from the tip: w = p - l3 (cos φ, sin φ)."),
    "direction_for_angle": marked("φ is the sum of all three angles, not the last one."),
    "first_angle_not_taken_off": marked("The last angle is φ minus both others."),
    "tool_left_out": marked("What stands below the slide is missing in the height."),
    "base_height_left_out": marked("The height of the base, in the first row, is missing."),
    "counted_upwards": marked("z of the last joint points down, so that its angle counts the other way round."),
    "shoulder_not_mirrored": marked("Turned by half a turn the arm has to reach back: other ϑ2 and ϑ3 follow."),
    "projection_for_distance": marked("The distance from the first axis is √(x² + y²), not x."),
    "arm_not_transposed": marked("The arm's rotation has to be taken off: R^3_6 has the transpose of R^0_3."),
    "arm_from_the_right": marked("The transpose multiplies from the left: R^3_6 = (R^0_3)^T R."),
    "relative_inverted": marked("This is R^6_3, the transpose."),
    "arm_left_out": marked("This is of R itself; but the arm has turned frame 3 already."),
    "hand_left_out": marked("The centre of the wrist is a hand's length d6 back from p."),
    "centre_beyond": marked("The sign is wrong: the centre of the wrist is back from p, along z6."),
    "row_for_approach": marked("The direction of z6 is the third column of R, not its third row."),
    "lower_elbow": marked("This belongs to the lower elbow."),
}
