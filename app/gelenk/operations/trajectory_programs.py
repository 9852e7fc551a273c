"""A planned motion in the shape that a robot's controller reads: a ROS JointTrajectory, or a URScript program.

Formats: `trajectory_msgs/msg/JointTrajectory` of ROS 2, as JSON and as YAML; URScript as Universal Robots' manual of it
says, for arms of six turning joints. Radians, metres, seconds.
"""

import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import orjson

from gelenk.contract.trajectory import JOINT_TRAJECTORY, URSCRIPT, YAML
from gelenk.errors import InvalidField, counted
from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians, chain_poses
from gelenk.operations.trajectory_planned import PlannedTrajectory
from gelenk.robot.arrays import Array
from gelenk.robot.notations import vectors_from_rotations
from gelenk.robot.poses import Poses

_NANOSECONDS = 1_000_000_000
_EXPONENT = re.compile(rb"(?<![\d.])(\d+)(\.\d+)?[eE]([+-]?)(\d+)")
_JOINTS, _MOVES, _LAWS = 6, {"joint", "line"}, {"trapezoidal", "time_optimal"}
_POINTS = 401
"""Instants of a segment at which its peaks are looked for; speeds and accelerations in constant phases are exact."""
_BASE = "base"
"""The link at the controller's base, as the descriptions of these arms call it."""
_TO_START = "a=0.5, v=0.5"
_LOOKAHEAD, _GAIN = 0.1, 300
"""Of `servoj`: the manual's own, [s] and no unit."""


def programs(planned: PlannedTrajectory, name: str) -> dict[str, Callable[[], bytes]]:
    """Return what writes the motion in each further format, by media type; `name` is the robot's."""
    return {
        JOINT_TRAJECTORY: lambda: orjson.dumps(_message(planned), option=orjson.OPT_SERIALIZE_NUMPY),
        YAML: lambda: _yaml(planned, name),
        URSCRIPT: lambda: _urscript(planned, name),
    }


def _message(planned: PlannedTrajectory) -> dict[str, Any]:
    """Return the motion as a JointTrajectory: a point for each sample."""
    times = planned.times()
    rates = planned.found.motion.rates_at(times)
    stamps = np.rint(times * _NANOSECONDS).astype(np.int64)
    points = [
        {
            "positions": q,
            "velocities": qd,
            "accelerations": qdd,
            "effort": [],
            "time_from_start": {"sec": stamp // _NANOSECONDS, "nanosec": stamp % _NANOSECONDS},
        }
        for stamp, q, qd, qdd in zip(stamps.tolist(), *rates, strict=True)
    ]
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": planned.chain.base_frame}
    return {"header": header, "joint_names": planned.chain.joint_names, "points": points}


def _yaml(planned: PlannedTrajectory, name: str) -> bytes:
    """Write the message as YAML, a line for each point, with what it is in comments."""
    message = _message(planned)
    lines = [f"# {line}".encode() for line in _about(planned, name)]
    lines += [b"%b: %b" % (field.encode(), _flow(message[field])) for field in ("header", "joint_names")]
    return b"\n".join([*lines, b"points:", *(b"- " + _flow(point) for point in message["points"]), b""])


def _flow(content: Any) -> bytes:
    """Encode as JSON, which is YAML but for one thing: YAML 1.1 knows 1.0e-7 as a number, and 1e-7 as a word."""
    text = orjson.dumps(content, option=orjson.OPT_SERIALIZE_NUMPY)
    return _EXPONENT.sub(lambda part: b"%b%be%b%b" % (part[1], part[2] or b".0", part[3] or b"+", part[4]), text)


def _about(planned: PlannedTrajectory, name: str) -> Iterator[str]:
    """Yield what a reader of the file must know."""
    chain, found = planned.chain, planned.found
    yield f"Robot {_plain(name)}, from {_plain(chain.base_frame)} to {_plain(chain.tip_frame)}."
    yield "Radians, metres, seconds; joints in the order " + ", ".join(map(_plain, chain.joint_names)) + "."
    yield f"{found.motion.duration:.9g} s, {found.completed_fraction:.0%} of the motion asked for."
    yield "Computed and audited by Gelenk; it was not run on a robot."


def _plain(text: str) -> str:
    """Replace what could end a comment; names are written by those who upload robots."""
    return "".join(character if character.isprintable() else "?" for character in text)


def _urscript(planned: PlannedTrajectory, name: str) -> bytes:
    """Write a program that streams the samples; where the motion is one of `movej` and `movel`, these too."""
    slides = [planned.robot.description.joint[name].type == "prismatic" for name in planned.chain.joint_names]
    if len(slides) != _JOINTS or any(slides):
        raise InvalidField(
            "format", f"urscript is for arms of 6 turning joints; here are {counted(len(slides), 'joint')}"
        )
    times = planned.times()
    qs = planned.found.motion.rates_at(times)[0]
    lines = [f"# {line}" for line in _about(planned, name)]
    lines += [
        "# For an arm of Universal Robots that this description is of; no other arm understands it.",
        "# gelenk() goes to the start, slowly, and streams the audited motion. Angles count from this model's zero.",
    ]
    lines += ["def gelenk():", f"  movej({_row(qs[0])}, {_TO_START})"]
    gaps = np.diff(times)
    rest = f"lookahead_time={_LOOKAHEAD:g}, gain={_GAIN}"
    lines += [f"  servoj({_row(q)}, t={float(t)!r}, {rest})" for q, t in zip(qs[1:], gaps, strict=True)]
    lines += ["  stopj(2.0)", "end"]
    if moves := _moves(planned):
        lines += [
            "# gelenk_moves() is the same way as moves: the controller times them, and rounds corners, as it does.",
            f"# Poses are of {_plain(planned.chain.tip_frame)} in the controller's own base: set the TCP so.",
            "def gelenk_moves():",
            f"  movej({_row(qs[0])}, {_TO_START})",
            *(f"  {move}" for move in moves),
            "end",
        ]
    return "\n".join([*lines, "gelenk()", ""]).encode()


def _moves(planned: PlannedTrajectory) -> list[str]:
    """Return the moves of which the motion consists, one a segment; none if it has other segments, laws or ends."""
    found, call, problem = planned.found, planned.call, planned.question.problem
    is_plain = all(report.type in _MOVES and report.law in _LAWS for report in found.segments)
    is_moving = any(getattr(call, name) is not None for name in ("at", "start_velocities", "end_velocities"))
    T = _in_base(planned)
    if found.failure is not None or is_moving or len(problem.following.task) < _JOINTS or not is_plain or T is None:
        return []
    moves = []
    for report in found.segments:
        inside = np.linspace(report.start_time, report.end_time, _POINTS)[1:-1]
        pose, end = problem.segments[report.index].pose, np.array([report.end_time])
        if report.end_time == report.start_time:
            continue
        if report.type == "line" and pose is not None:
            speed, acceleration = _tip_peaks(planned, *found.motion.rates_at(inside))
            radius, target = 0.0 if report.blend is None else report.blend.radius, T @ pose
            turn = vectors_from_rotations(np.ascontiguousarray(target[None, :3, :3]))[0]
            place = _row(np.concatenate((target[:3, 3], turn)))
            moves.append(f"movel(p{place}, a={acceleration!r}, v={speed!r}, r={radius!r})")
        else:
            speed, acceleration = (float(np.abs(rate).max()) for rate in found.motion.rates_at(inside)[1:])
            moves.append(f"movej({_row(found.motion.rates_at(end)[0][0])}, a={acceleration!r}, v={speed!r})")
    return moves


def _in_base(planned: PlannedTrajectory) -> Array | None:
    """Return T_base_chain, from the chain's base to the controller's, the link `base`; None if the robot has none."""
    robot, chain = planned.robot, planned.chain
    if _BASE not in robot.description.frames:
        return None
    other = robot.chain(_BASE, chain.tip_frame)
    if other.joint_names != chain.joint_names:
        return None
    here, there = (Poses(*chain_poses(one.flat, np.zeros((1, len(one))))).matrices()[0] for one in (chain, other))
    return np.asarray(there @ np.linalg.inv(here))


def _tip_peaks(planned: PlannedTrajectory, q: Array, qd: Array, qdd: Array) -> tuple[float, float]:
    """Return the largest speed [m/s] and acceleration [m/s²] of the tip at configurations of shape (N, n)."""
    J = chain_jacobians(planned.chain.flat, q)[2][:, :3]
    H = chain_hessians(planned.chain.flat, q)[:, :3]
    velocities = np.einsum("nki,ni->nk", J, qd)
    accelerations = np.einsum("nki,ni->nk", J, qdd) + np.einsum("nkij,ni,nj->nk", H, qd, qd)
    speed, acceleration = (np.linalg.norm(each, axis=1).max(initial=0.0) for each in (velocities, accelerations))
    return float(speed), float(acceleration)


def _row(values: Array) -> str:
    return "[" + ", ".join(map(repr, values.tolist())) + "]"
