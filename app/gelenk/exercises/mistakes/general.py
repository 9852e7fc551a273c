"""Mistakes that follow from the right answer alone, and answers of the wrong form."""

from gelenk.language import marked

OF_FORM = {
    "solutions_too_many": marked("All solutions are here, but also some that are none."),
    "solutions_missing": marked("What is here is right, but {missing} of {count} solutions are missing."),
    "missing": marked("There is no answer here."),
    "not_a_number": marked("This is not a number."),
    "not_a_choice": marked("The answer is one of: {choices}."),
    "wrong_shape": marked("The answer has this shape: {shape}."),
}
"""What can be wrong about the form of an answer; not all are mistakes of thinking."""
MISTAKES = {
    **OF_FORM,
    "sign": marked("The sign is wrong."),
    "degrees_for_radians": marked("This is in degrees; the answer is in radians."),
    "radians_for_degrees": marked("This is in radians; the answer is in degrees."),
    "turns_for_radians": marked("This counts turns; the answer is in radians: one turn is 2π."),
    "turns_per_minute": marked("This is in revolutions per minute; the answer is in rad/s."),
    "twice": marked("This is twice the right answer: a factor 1/2 is missing."),
    "half": marked("This is half the right answer: a factor 2 is missing."),
    "thousand_too_large": marked("This is a thousand times too large: check the prefix of the unit."),
    "thousand_too_small": marked("This is a thousand times too small: check the prefix of the unit."),
    "percent": marked("This is in per cent; the answer is a fraction."),
    "square": marked("This is the square of the right answer: a root is missing."),
    "reversed": marked("The numbers are right, but in the opposite order."),
    "transposed": marked("This is the transposed matrix: rows and columns are exchanged."),
    "calculator_mode": marked("The angles are in degrees, but sine and cosine were taken as of radians."),
}
