"""Mistakes about what planar arms reach."""

from gelenk.language import marked

MISTAKES = {
    "hole_forgotten": marked("Links of different lengths cannot fold onto the base: there is a hole."),
    "disc_without_pi": marked("The area of a disc is π r²."),
    "width_squared": marked("The area is π (r_max² - r_min²), not π times the width squared."),
    "first_link_alone": marked("Folded the arm comes nearer to the base than its first link is long."),
    "right_angle_as_limit": marked("Stretched the links add up; this is the distance at a right angle."),
    "always_a_hole": marked("There is a hole only if one link is longer than all the others."),
    "last_link_forgotten": marked("The last link is missing: these are the circles of the wrist."),
    "inner_disc_forgotten": marked("A last link longer than |l₁ - l₂| can be turned freely around the base, too."),
    "primary_for_secondary": marked("This is WS₁: these points are not reached with all orientations."),
    "ring_of_wrist": marked("These are the points that the wrist reaches."),
    "hole_of_wrist_forgotten": marked("The wrist has a hole about the base, which its circle must not enter."),
    "last_link_only_outside": marked("The wrist's circle has to stay clear of the hole as well: r ≥ l₃ + |l₁ - l₂|."),
    "supplement": marked("This is 180° less the angle: the wrist is behind the tip, and the cosine has a minus."),
    "reach_of_first_link": marked("The wrist can be as far as l₁ + l₂ from the base."),
    "hypotenuse_for_reach": marked("The wrist is farthest if both links are stretched: l₁ + l₂."),
    "one_side_alone": marked("φ can have both signs."),
    "two_of_cosine": marked("The law of cosines has the factor 2."),
    "radii_as_links": marked("These are the radii; the links are half of their sum and of their difference."),
    "outside_by_last_link": marked("With a third link the arm also comes nearer to the base."),
}
