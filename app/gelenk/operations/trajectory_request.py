"""Converts a trajectory request for the core, checking every number against the chain."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import cast

import numpy as np

from gelenk.contract.pose import Pose, PoseLike, pose_of
from gelenk.contract.trajectory_request import MAX_WAYPOINTS, MotionOptions, Segment, SplineSegment, TrajectoryRequest
from gelenk.errors import InvalidField, InvalidPose, OutsideLimits, counted
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import DIRECTIONS
from gelenk.operations.pose_arrays import poses_from
from gelenk.operations.trajectory_ends import state_of, with_rates
from gelenk.operations.trajectory_limits import OwnVelocities, SourcedLimits, bounds_of, has_own_limits, own_velocities
from gelenk.operations.trajectory_path import free_tool, refuse_beside, tool_segments
from gelenk.operations.trajectory_torques import with_torques
from gelenk.robot.arrays import Array, Configuration
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import check_limits, configurations, one_configuration
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.problem.problem import BLENDABLE, OPEN, Following, Segment as Part, TrajectoryProblem

_FLY_OVER = ("blend_acceleration", "blend_time")
_SHORTEST = 1e-6
"""Shortest time between waypoints, [s]."""


@dataclass(frozen=True, slots=True)
class SourcedProblem:
    """The problem for the core, the robot's own velocity limits, and all limits with their sources."""

    problem: TrajectoryProblem
    own: OwnVelocities
    bounds: SourcedLimits
    segment_bounds: tuple[SourcedLimits, ...]


def parse(robot: RobotModel, chain: Chain, call: TrajectoryRequest) -> SourcedProblem:
    """Convert a request into the problem for the core; raises InvalidInput, which names the field."""
    refuse_beside(call)
    requested = call.moves()
    waypoints = sum(len(segment.waypoints) for segment in requested if segment.type == "spline")
    if waypoints > MAX_WAYPOINTS:
        raise InvalidField("segments", f"all together have {waypoints} waypoints; at most {MAX_WAYPOINTS} are allowed")
    own = own_velocities(robot, chain)
    overall = bounds_of(chain, own, {"": call})
    bounds = tuple(
        bounds_of(chain, own, {"": call, f"segments.{i}.": one}) if has_own_limits(one) else overall
        for i, one in enumerate(requested)
    )
    overall, *segment_bounds = with_torques(robot, chain, call, (overall, *bounds))
    state = None if call.at is None else state_of(robot, chain, call.at, lambda *former: parse(*former).problem)
    if call.path is None:
        segments = tuple(_segment(chain, call, i, segment_bounds[i], own) for i in range(len(requested)))
    else:
        part = Part("spline", _tip_law(call, None, "law"), overall.limits, stated_jerk=_stated(overall))
        segments = tool_segments(call, call.path, part)
        segment_bounds = [overall] * len(segments)
    problem = TrajectoryProblem(
        _start(chain, call, state),
        with_rates(chain, call, segments, state),
        Following(
            _task(call),
            call.path_tolerance,
            call.orientation_tolerance,
            call.min_singular_value,
            call.near_singularity,
        ),
        call.duration,
        call.compare_timing,
        None if call.path is None else free_tool(call.path),
    )
    return SourcedProblem(problem, own, overall, tuple(segment_bounds))


def _start(chain: Chain, call: TrajectoryRequest, state: Array | None) -> Array:
    """Return where the motion begins, by the request or in the state of a running motion; shape (n,), [rad or m]."""
    if state is None:
        if call.start is None and call.path is not None:
            return mid_range(chain)
        if call.start is None:
            raise InvalidField("start", "is missing: give a list of one number per joint, or a running motion as `at`")
        return _within(chain, call.start, "start")
    for name in ("start", "start_velocities", "start_accelerations"):
        if getattr(call, name) is not None:
            raise InvalidField(name, "is not allowed beside `at`, which determines it")
    return cast(Array, state[0])


def shortest_duration(problem: TrajectoryProblem) -> float:
    """Return the least duration of a trajectory that its request implies, [s]."""
    if problem.duration is not None:
        return problem.duration
    known = (part.duration if part.times is None else float(part.times[-1]) for part in problem.segments)
    return sum(duration for duration in known if duration is not None)


def _task(call: TrajectoryRequest) -> Task:
    if call.task is None:
        return FULL_POSE
    if len(set(call.task)) < len(call.task):
        raise InvalidField("task", "each direction may appear only once")
    return Task(tuple(direction for direction in DIRECTIONS if direction in call.task))


def _segment(chain: Chain, call: TrajectoryRequest, index: int, bounds: SourcedLimits, own: OwnVelocities) -> Part:
    segments = call.moves()
    segment, place = segments[index], f"segments.{index}"
    left_open = None if _task(call).has_rotations else OPEN
    law = segment.law or call.law
    if _is_tip_path(segment):
        law = _tip_law(call, segment.law, f"{place}.law")
    part = partial(Part, segment.type, law, bounds.limits, segment.duration, stated_jerk=_stated(bounds))
    # By the word: to ask for the class of a model takes long.
    if segment.type == "spline":
        _check_blends(segment, segment.law or call.law, place)
        spline = partial(part, boundary=segment.boundary, blends=segment.blends)
        if segment.waypoint_options is not None:
            layers: dict[str, MotionOptions] = {"": call, f"{place}.": segment}
            options = cast(Sequence[MotionOptions | None], segment.waypoint_options)
            spline = partial(spline, ways=_ways(chain, own, layers, segment, options, spline()))
        return _spline(chain, segment, spline, place, left_open)
    if segment.type == "joint":
        if isinstance(segment.target, Pose):
            anyhow = None if left_open is None else np.eye(3)
            return part(pose=_matrix(segment.target, f"{place}.target", anyhow))
        return part(configuration=_within(chain, cast(Configuration, segment.target), f"{place}.target"))
    _check_blend(segments, index)
    return part(
        via=None if segment.type == "line" else _matrix(segment.via, f"{place}.via", left_open),
        pose=_matrix(segment.target, f"{place}.target", left_open),
        blend_radius=segment.blend_radius or 0.0,
        blend_acceleration=segment.blend_acceleration if segment.type == "line" else None,
        blend_time=segment.blend_time if segment.type == "line" else None,
        orientation=segment.orientation,
    )


def _stated(bounds: SourcedLimits) -> Array | None:
    """Return the limits of jerk that the request gives, ∞ for the others; None if it gives none; shape (n,)."""
    sources = bounds.sources["joint_jerk"]
    if "request" not in sources:
        return None
    return np.where([source == "request" for source in sources], bounds.limits.jerk, np.inf)


def _tip_law(call: TrajectoryRequest, own: Law | None, field: str) -> Law:
    """Return the law along a path of the tip, its own or the trajectory's; with `slow_down` only `time_optimal`."""
    law = own or call.law
    if law == "time_optimal" or call.near_singularity != "slow_down":
        return law
    if (own or "law" in call.model_fields_set) and not call.law_fallback:
        raise InvalidField(
            field if own else "law",
            f"`{law}` has one shape along the whole path, and `near_singularity` `slow_down` is slow only where the "
            "joints must be: ask for `time_optimal`, or allow another law with `law_fallback`",
        )
    return "time_optimal"


def _is_tip_path(segment: Segment) -> bool:
    """Check whether the tip follows a path without given times."""
    if segment.type == "spline":
        return segment.times is None and isinstance(segment.waypoints[0], Pose)
    return segment.type != "joint"


def _check_blends(segment: SplineSegment, law: Law, place: str) -> None:
    """Refuse parabolic blends of poses, and with any law but `trapezoidal`."""
    if not segment.blends:
        return
    if any(isinstance(one, Pose) for one in segment.waypoints):
        raise InvalidField(f"{place}.blends", "are of configurations; for poses take lines with a `blend_radius`")
    if law != "trapezoidal":
        raise InvalidField(f"{place}.blends", f"are only allowed with the law `trapezoidal`; this one is `{law}`")
    if "boundary" in segment.model_fields_set:
        raise InvalidField(f"{place}.boundary", "is of a spline, and with `blends` there is none")


def _spline(
    chain: Chain, segment: SplineSegment, part: Callable[..., Part], place: str, left_open: Array | None
) -> Part:
    waypoints, field = segment.waypoints, f"{place}.waypoints"
    times = None if segment.times is None else _times(segment, place)
    poses = [one for one in waypoints if type(one) is Pose]  # quicker than to ask a model's class
    if not poses:
        if "orientation" in segment.model_fields_set:
            raise InvalidField(f"{place}.orientation", "is of poses, and these waypoints are configurations")
        rows = configurations(chain, cast(Sequence[Configuration], waypoints), field)
        try:
            check_limits(chain, rows)
        except OutsideLimits as error:
            raise replace(error, field=field) from None
        return part(configurations=rows, times=times)
    if len(poses) < len(waypoints):
        is_pose = [isinstance(one, Pose) for one in waypoints]
        raise InvalidField(
            field,
            f"entry {is_pose.index(True)} is a pose and entry {is_pose.index(False)} a configuration: all are of one "
            "kind, so divide them among two segments",
        )
    return part(poses=poses_from(poses, field, left_open), times=times, orientation=segment.orientation)


def _ways(
    chain: Chain,
    own: OwnVelocities,
    layers: dict[str, MotionOptions],
    segment: SplineSegment,
    of_each: Sequence[MotionOptions | None],
    part: Part,
) -> tuple[Part, ...]:
    """Return the limits on the way to each waypoint as parts, with options of each beside the segment's."""
    field = f"{list(layers)[-1]}waypoint_options"
    count, number = len(of_each), len(segment.waypoints)
    if not isinstance(segment.waypoints[0], Pose):
        reason = "are of poses; for configurations give `limits` to segments that end at them"
        raise InvalidField(field, reason)
    if count != number:
        raise InvalidField(field, f"has {counted(count, 'entry')} for {counted(number, 'waypoint')}")
    ways = []
    for k, options in enumerate(of_each):
        place = f"{field}.{k}."
        given = None if options is None else options.own_limits()
        if given is not None and given.joint_torque is not None:
            raise InvalidField(f"{place}limits.joint_torque", "holds along a whole segment: give it there")
        bounds = bounds_of(chain, own, layers if options is None else {**layers, place: options})
        limits = replace(bounds.limits, torque=part.limits.torque)
        ways.append(replace(part, limits=limits, stated_jerk=_stated(bounds)))
    return tuple(ways)


def _times(segment: SplineSegment, place: str) -> Array:
    times, field = np.array(segment.times), f"{place}.times"
    if len(times) != len(segment.waypoints):
        raise InvalidField(
            field, f"has {counted(len(times), 'entry')} for {counted(len(segment.waypoints), 'waypoint')}"
        )
    if segment.duration is not None:
        raise InvalidField(f"{place}.duration", "is not allowed beside `times`, which determine it")
    late = np.diff(times) >= _SHORTEST
    if not late.all():
        i = int(np.argmin(late))
        raise InvalidField(
            field,
            f"entry {i + 1}, {times[i + 1]:.10g} s, is not after entry {i}, {times[i]:.10g} s: each is later than the "
            f"one before by at least {_SHORTEST:g} s",
        )
    return times


def _check_blend(segments: Sequence[Segment], index: int) -> None:
    """Refuse a blend before anything but a line or a circle, and one that is given in two ways."""
    place = f"segments.{index}"
    names = [name for name in ("blend_radius", *_FLY_OVER) if getattr(segments[index], name, None)]
    if not names:
        return
    if len(names) > 1:
        raise InvalidField(f"{place}.{names[1]}", f"is not allowed beside `{names[0]}`: give a blend in one way")
    if index + 1 == len(segments):
        raise InvalidField(f"{place}.{names[0]}", "the last segment ends at rest: there is nothing to blend into")
    kind = segments[index + 1].type
    if kind not in BLENDABLE:
        reason = f"the next segment is of type {kind}: a blend leads into a line or a circle"
        raise InvalidField(f"{place}.{names[0]}", reason)
    if kind == "circle" and names[0] in _FLY_OVER:
        raise InvalidField(f"{place}.{names[0]}", "is the fly-over between two lines: here give a `blend_radius`")


def _within(chain: Chain, value: Configuration, field: str) -> Array:
    """Return a configuration that is within the limits, else raise; shape (n,), [rad or m]."""
    rows = one_configuration(chain, value, field)
    try:
        check_limits(chain, rows)
    except OutsideLimits as error:
        raise replace(error, index=None, field=field) from None
    configuration: Array = rows[0]
    return configuration


def _matrix(pose: PoseLike, field: str, left_open: Array | None) -> Array:
    """Return T_base_tip; shape (4, 4)."""
    try:
        return pose_of(pose).transform(left_open)
    except InvalidPose as error:
        raise replace(error, field=field) from None
