"""Mistakes with rotations, their angles, and transforms."""

from gelenk.language import marked

MISTAKES = {
    "fixed_for_moving": marked("The second axis has turned with the first rotation: it multiplies from the right."),
    "moving_for_fixed": marked("The axes are fixed: each further rotation multiplies from the left, Rz Ry Rx."),
    "turned_clockwise": marked("Positive angles turn counter-clockwise."),
    "minus_of_y": marked("The minus sign is in the wrong place: in the matrix about y it stands below the diagonal."),
    "turned_back": marked("The point was multiplied by the transpose, which leads from frame 0 to frame 2."),
    "second_turn_forgotten": marked("The second rotation is missing."),
    "origin_only_negated": marked("The origin is not only negated: the inverse has -R^T p, and not -p."),
    "origin_not_negated": marked("The minus sign is missing: the inverse has -R^T p."),
    "rotation_not_transposed": marked("The inverse of a rotation is its transpose."),
    "rows_for_columns": marked("Rows and columns are exchanged: these are the angles of the transpose."),
    "rpy_for_zyz": marked("These are roll, pitch and yaw, not ZYZ angles."),
    "zyz_for_rpy": marked("This is the second solution of ZYZ angles; of roll, pitch and yaw the pitch becomes π - ϑ."),
    "flip_incomplete": marked("In the second solution both outer angles differ by half a turn."),
    "roll_and_yaw_exchanged": marked("Roll, about x, and yaw, about z, are exchanged."),
    "sum_and_difference": marked("At ϑ = 0 the sum φ + ψ is determined, at ϑ = π the difference φ - ψ."),
    "psi_added": marked("The sign of ψ is wrong when φ is computed from the sum or the difference."),
    "angle_from_sine": marked("The sine alone does not tell an angle from π minus it: use the trace as well."),
    "trace_without_one": marked("The trace is 1 + 2 cos ϑ: take 1 off before it is halved."),
    "axis_not_normalized": marked("This vector is 2 sin ϑ long: divide it by its length."),
    "axis_from_sums": marked("The axis has the differences of the entries across the diagonal, not their sums."),
    "offset_not_turned": marked("The camera's offset is in the gripper's frame: turn it before adding it."),
    "offset_left_out": marked("The camera's offset from the gripper is missing."),
}
