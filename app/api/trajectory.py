"""Trajectories of a robot: planned, judged, sampled; as JSON, CSV, npy or a picture."""

from typing import Any

from app.api.routes import Computation, Operation, Outcome, PictureFormat
from app.api.trajectory_answer import (
    columns,
    table,
    told_audit,
    told_failure,
    told_limits,
    told_poses,
    told_samples,
    told_segments,
)
from app.api.trajectory_limits import limit_notes
from app.api.trajectory_request import Asked, asked, shortest_duration
from app.api.trajectory_samples import check_samples, sample_times
from app.kinematics.forward import forward_kinematics
from app.model.arrays import Array
from app.model.chain import Chain
from app.model.errors import TooLarge
from app.model.robot import Robot
from app.schemas.trajectory import TrajectoryRequest
from app.schemas.trajectory_answer import TrajectoryAnswer
from app.store.records import LoadedRobot
from app.trajectory.plan import plan
from app.trajectory.problem import Trajectory

_NUMBERS_A_POSE = 16
_MOST_NAME = 16
"""Characters of a robot's name in a title, which has room for 48."""


def trajectory_operation(max_answer_numbers: int) -> Operation:
    """The operation `trajectory`, none of whose answers holds more numbers than given."""

    def trajectory(loaded: LoadedRobot, call: TrajectoryRequest) -> Outcome:
        """A motion from rest to rest through segments: joints, lines, circles and splines of the tip.

        A `joint` segment moves all joints together to a configuration or a pose; `line`, `circle` and `spline` lead
        the tip along a way in space, which the joints follow within `path_tolerance`, also between samples, on one
        branch of the inverse kinematics. A spline through configurations moves the joints. The motion stops between
        two segments, but where a line is blended into the next. Each segment has a law of time and limits of its own,
        or those of the trajectory; what neither the request nor the robot's description has is assumed, and `notes`
        and `limit_sources` say so.

        A way that cannot be followed to its end (out of reach, a joint limit, a singularity, a change of branch) is an
        answer too: the motion as far as it goes, to rest, with `completed_fraction` and `failure`.

        Every motion is a list of polynomials, and is judged before it is sent by code that shares nothing with what
        planned it: exact peaks against the limits, jumps where pieces meet, the tip against its way between samples
        too; and its poses are recomputed through Pinocchio. `audit` holds what was found.

        With `Accept: text/csv` or `application/x-npy` the samples come as a table, with `image/svg+xml` or `image/png`
        as profiles of position, velocity, acceleration and jerk.
        """
        chain = loaded.robot.chain(call.base_frame, call.tip_frame)
        question = asked(loaded.robot, chain, call)
        numbers = 1 + 3 * len(chain) + _NUMBERS_A_POSE * call.tip_poses
        check_samples(shortest_duration(question.problem), call.sample_period, numbers, max_answer_numbers)
        found = plan(loaded.robot, chain, question.problem)

        def times() -> Array:
            check_samples(found.motion.duration, call.sample_period, numbers, max_answer_numbers)
            return sample_times(found.motion.duration, call.sample_period)

        def content() -> dict[str, Any]:
            if call.coefficients and found.motion.coefficients.size > max_answer_numbers:
                raise TooLarge("numbers in the answer", found.motion.coefficients.size, max_answer_numbers)
            return _content(loaded.robot, chain, call, question, found, times())

        def picture(kind: PictureFormat) -> bytes:
            return _picture(loaded, chain, question, found, kind)

        return Outcome(content, lambda: (table(found.motion, times()), _headers(found)), picture, columns(chain))

    return Operation(
        name="trajectory",
        operation_id="trajectory",
        summary="Trajectory",
        computation=Computation(
            run=trajectory,
            request=TrajectoryRequest,
            is_heavy=lambda _: True,
            picture="Position, velocity, acceleration and jerk of each joint over time, with the limits; the segments "
            "are marked.",
            table="A row of names, `time`, `q_…`, `qd_…` and `qdd_…` of each joint, then a row a sample: [s], "
            "[rad or m], [rad/s or m/s], [rad/s² or m/s²]. The headers are those of the npy answer.",
        ),
        answer=TrajectoryAnswer,
        npy_answer="The samples as one array of shape (N, 1 + 3n): time, joint positions, velocities, accelerations. "
        "The headers `Gelenk-Duration` [s], `Gelenk-Completed-Fraction` and `Gelenk-Failure` (`none`, or its reason) "
        "say what came of it.",
        example={
            "start": [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785],
            "segments": [
                {"type": "joint", "target": [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]},
                {
                    "type": "line",
                    "target": {"position": [0.5, 0.2, 0.4], "rpy": [3.141592653589793, 0.0, 0.3]},
                    "blend_radius": 0.05,
                },
                {"type": "line", "target": {"position": [0.5, -0.1, 0.4], "rpy": [3.141592653589793, 0.0, 0.0]}},
            ],
            "law": "trapezoidal",
            "tip_frame": "panda_link8",
            "velocity_scale": 0.5,
            "acceleration_scale": 0.5,
            "sample_period": 0.05,
        },
    )


def _content(
    robot: Robot, chain: Chain, call: TrajectoryRequest, question: Asked, found: Trajectory, times: Array
) -> dict[str, Any]:
    answer: dict[str, Any] = {
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "duration": found.motion.duration,
        "completed_fraction": found.completed_fraction,
        "failure": told_failure(found),
        **told_samples(found.motion, times),
        "tip_poses": None,
        "segments": told_segments(found, question.segment_bounds, coefficients=call.coefficients),
        "audit": told_audit(found.audit),
        "limits": told_limits(question.bounds.limits),
        "limit_sources": question.bounds.sources,
        "notes": limit_notes(chain, question.own, question.segment_bounds),
        "certificate": None,
    }
    if call.compare_timing:
        answer["timing"] = found.timing
    if call.tip_poses:
        forward = forward_kinematics(robot, chain, found.motion.at(times))
        answer["tip_poses"] = told_poses(forward.poses, call.pose_format)
        answer["certificate"] = forward.certificate
    return answer


def _headers(found: Trajectory) -> dict[str, str]:
    return {
        "Gelenk-Duration": repr(found.motion.duration),
        "Gelenk-Completed-Fraction": repr(found.completed_fraction),
        "Gelenk-Failure": "none" if found.failure is None else found.failure.reason,
    }


def _picture(loaded: LoadedRobot, chain: Chain, question: Asked, found: Trajectory, kind: PictureFormat) -> bytes:
    # Matplotlib takes a third of a second to load.
    from app.plots.profiles import Lines, Span, profiles_picture  # noqa: PLC0415

    spans = []
    for report in found.segments:
        limits = question.segment_bounds[report.index].limits
        label = f"{report.index} {report.type}"
        spans.append(
            Span(label, report.start_time, report.end_time, (limits.velocity, limits.acceleration, limits.jerk))
        )
    slides = [loaded.robot.description.joint[name].type == "prismatic" for name in chain.joint_names]
    unit = "m" if slides and all(slides) else "(rad or m)" if any(slides) else "rad"
    units = [unit, *(f"{unit}/{per}" for per in ("s", "s²", "s³"))]
    name = loaded.record.name
    title = f"{name if len(name) <= _MOST_NAME else name[: _MOST_NAME - 1] + '…'}: {found.motion.duration:.4g} s"
    if found.failure is not None:
        title += f", {100.0 * found.completed_fraction:.3g} % done: {found.failure.reason}"
    lines = Lines(chain.joint_names, units, (None, None, None), spans=spans)
    return profiles_picture(title, found.motion, lines, kind)
