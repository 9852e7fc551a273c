"""A planned trajectory and its answer, as a whole or in parts."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
import orjson

from gelenk.contract.pose import PoseFormat
from gelenk.contract.trajectory_request import TrajectoryRequest
from gelenk.errors import InvalidField, TooLarge
from gelenk.kinematics.judge.judge import certify_poses
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.language import language
from gelenk.operations.cells import CellBodies
from gelenk.operations.chains import head
from gelenk.operations.outcome import PictureFormat
from gelenk.operations.pose_arrays import pose_columns
from gelenk.operations.rows import json_objects, json_rows
from gelenk.operations.trajectory_limits import limit_notes
from gelenk.operations.trajectory_request import SourcedProblem, parse, shortest_duration
from gelenk.operations.trajectory_steps import trajectory_steps
from gelenk.operations.trajectory_torques import torque_notes
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import SegmentLimits, Trajectory

_NEARLY = 1e-6
"""Fraction of a period that would be too short a time between the last two samples."""
_NUMBERS_A_POSE = 16
_LONGER, _LONG_SECONDS = 100.0, 60.0
"""Hardly any motion lasts longer than this many times its least duration, plus this many seconds."""
_MOST_NAME = 16
"""Maximum number of characters of a robot's name in a title, which has room for 48."""
SAMPLED = ("times", "joint_positions", "joint_velocities", "joint_accelerations")
"""Fields of the answer that have an entry for each sample."""
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True)
class TrajectorySizeLimits:
    """Most samples of a call's motion, and most numbers in the samples, or in the polynomials."""

    samples: int
    numbers: int

    def check(self, call: TrajectoryRequest, chain: Chain, duration: float) -> None:
        """Refuse a duration, or a lower bound of it, [s], with too many samples; the error gives an allowed period."""
        period, most = call.sample_period, self._most(call, chain)
        if duration / period <= 2.0 * most and sample_count(duration, period) <= most:
            return
        count = duration / period + 1.0
        # Rounded up, so that the period in the message is long enough.
        allowed = math.ceil(duration / (most - 1) * 1e6) / 1e6
        raise InvalidField(
            "sample_period",
            f"{period:g} s makes {count:.0f} samples of {duration:.6g} s; at most {most} are "
            f"allowed, every {allowed:.6f} s",
        )

    def may_be_exceeded(self, call: TrajectoryRequest, chain: Chain, shortest: float) -> bool:
        """Check whether a motion that takes at least `shortest`, [s], may last so long that it has too many samples."""
        return _LONGER * shortest + _LONG_SECONDS > (self._most(call, chain) - 1) * call.sample_period

    def _most(self, call: TrajectoryRequest, chain: Chain) -> int:
        numbers = 1 + (3 + call.torques) * len(chain) + _NUMBERS_A_POSE * call.tip_poses
        return min(self.samples, max(2, self.numbers // numbers))


def sample_times(duration: float, period: float) -> Array:
    """Return every multiple of a period before the end, and the end, [s]; for a duration of zero only 0."""
    times, rate = np.arange(float(sample_count(duration, period))), round(1.0 / period)
    # 3 · 0.05 is not the double that is nearest to 0.15; 3 / 20 is.
    times = times / rate if rate * period == 1.0 else times * period
    times[-1] = duration
    return times


def sample_count(duration: float, period: float) -> int:
    """Return the number of samples."""
    return max(0, math.ceil(duration / period - _NEARLY)) + 1


def checked(robot: RobotModel, call: TrajectoryRequest, bounds: TrajectorySizeLimits) -> tuple[Chain, SourcedProblem]:
    """Return the chain and the core's input, checked as far as possible before planning; raises InvalidInput."""
    chain = robot.chain(call.base_frame, call.tip_frame)
    question = parse(robot, chain, call)
    bounds.check(call, chain, shortest_duration(question.problem))
    return chain, question


@dataclass(frozen=True, slots=True)
class MotionSamples:
    """A motion at times (N,), [s]: positions, velocities, accelerations, shape (N, n) each, and poses and torques.

    Poses and torques are None where they are not requested; torques have the shape (N, n), [N m or N].
    """

    times: Array
    rates: list[Array]
    poses: Poses | None
    torques: Array | None = None

    def to_json(self, pose_format: PoseFormat) -> dict[str, orjson.Fragment | Array]:
        """Return the entries of each requested field that has some."""
        rows = [self.times, *self.rates]
        entries = {name: json_rows(values) for name, values in zip(SAMPLED, rows, strict=True)}
        if self.torques is not None:
            entries["joint_torques"] = json_rows(self.torques)
        if self.poses is not None:
            entries["tip_poses"] = json_objects(pose_columns(self.poses, pose_format))
        return entries


@dataclass(frozen=True, slots=True)
class PlannedTrajectory:
    """A planned trajectory: the request, the problem given to the core and what it found, and the answer's limits."""

    robot: RobotModel
    chain: Chain
    call: TrajectoryRequest
    question: SourcedProblem
    found: Trajectory
    bounds: TrajectorySizeLimits
    bodies: CellBodies | None = None

    @classmethod
    def of(
        cls,
        robot: RobotModel,
        call: TrajectoryRequest,
        bounds: TrajectorySizeLimits,
        bodies: CellBodies | None = None,
    ) -> "PlannedTrajectory":
        """Plan a trajectory, among bodies if contacts count.

        Raises InvalidInput, which names the field; TooLarge; AuditFailed for a motion that fails its audit.
        """
        chain, question = checked(robot, call, bounds)
        problem = question.problem
        if bodies is not None:
            problem = replace(problem, cell=bodies.cell(robot, chain, call.min_clearance))
        return cls(robot, chain, call, question, plan(robot, chain, problem), bounds, bodies)

    @property
    def further(self) -> list[str]:
        """Fields of the answer besides `SAMPLED` that have an entry for each sample, as requested."""
        wanted = {"joint_torques": self.call.torques, "tip_poses": self.call.tip_poses}
        return [name for name, is_wanted in wanted.items() if is_wanted]

    @property
    def columns(self) -> list[str]:
        """Names of the table's columns."""
        quantities = ("q", "qd", "qdd", "tau") if self.call.torques else ("q", "qd", "qdd")
        return ["time", *(f"{quantity}_{name}" for quantity in quantities for name in self.chain.joint_names)]

    @property
    def headers(self) -> dict[str, str]:
        """Headers beside a table: duration, completed fraction and failure of the motion."""
        found = self.found
        return {
            "Gelenk-Duration": repr(found.motion.duration),
            "Gelenk-Completed-Fraction": repr(found.completed_fraction),
            "Gelenk-Failure": "none" if found.failure is None else found.failure.reason,
        }

    def times(self) -> Array:
        """Return the sample times of the motion; shape (N,), [s]; raises InvalidField if there are too many."""
        self.bounds.check(self.call, self.chain, self.found.motion.duration)
        return sample_times(self.found.motion.duration, self.call.sample_period)

    def table(self, times: Array) -> Array:
        """Return time, positions, velocities, accelerations and requested torques side by side; (N, 1 + 3n or 4n)."""
        rates = self.found.motion.rates_at(times)
        return np.column_stack((times, *rates, *([self._torques(rates)] if self.call.torques else ())))

    def samples(self, times: Array) -> "MotionSamples":
        """Return the motion at some times, with poses and torques if they are requested."""
        rates = self.found.motion.rates_at(times)
        poses = Poses(*chain_poses(self.chain.flat, rates[0])) if self.call.tip_poses else None
        return MotionSamples(times, rates, poses, self._torques(rates) if self.call.torques else None)

    def _torques(self, rates: list[Array]) -> Array:
        """Return the torques at N samples; shape (N, n), [N m or N]."""
        torque = self.question.bounds.limits.torque
        return np.zeros_like(rates[0]) if torque is None else np.add(*torque.parts(*rates))

    def certificate(self, samples: "MotionSamples") -> PoseCertificate | None:
        """Compare the poses with Pinocchio's; raises CertificationFailed. None if they are not sent."""
        if samples.poses is None:
            return None
        return certify_poses(self.robot, self.chain, samples.rates[0], {self.chain.tip_frame: samples.poses})

    def to_json(self, sampled: Mapping[str, Any], certificate: PoseCertificate | None) -> dict[str, Any]:
        """Return the whole answer; raises TooLarge if the requested polynomials hold too many numbers."""
        found, bounds = self.found, self.question.bounds
        if self.call.coefficients and found.motion.coefficients.size > self.bounds.numbers:
            raise TooLarge("numbers in the answer", found.motion.coefficients.size, self.bounds.numbers)
        answer: dict[str, Any] = {
            **head(self.chain),
            "duration": found.motion.duration,
            "completed_fraction": found.completed_fraction,
            "failure": found.failure,
            **sampled,
            "tip_poses": sampled.get("tip_poses"),
            "segments": self._segments_json(),
            "audit": found.audit,
            "limits": limits_json(bounds.limits),
            "limit_sources": bounds.sources,
            "notes": self._notes(),
            "certificate": certificate,
        }
        if self.call.steps:
            with language(self.call.language):  # A job answers outside the context of its request.
                answer["steps"] = trajectory_steps(self.chain, self.question.problem.segments, found)
        if found.choice is not None:
            answer["path"] = found.choice
        return answer | ({"timing": found.timing} if self.call.compare_timing else {})

    def _notes(self) -> list[str]:
        notes = limit_notes(self.chain, self.question.own, self.question.segment_bounds)
        if self.question.bounds.limits.torque is not None:
            notes += torque_notes(self.robot, self.chain, self.call)
        if self.bodies is not None:
            notes += self.bodies.warnings
        return notes

    def _segments_json(self) -> list[dict[str, Any]]:
        motion, reports, bounds = self.found.motion, self.found.segments, self.question.segment_bounds
        entries = [{**asdict(report), "limits": limits_json(bounds[report.index].limits)} for report in reports]
        if not self.call.coefficients:
            return entries
        starts = np.array([report.start_time for report in reports])
        ends = np.searchsorted(motion.breaks[:-1], starts - _ROUNDING * max(1.0, motion.duration)).tolist()
        ends.append(len(motion.breaks) - 1)
        for i, entry in enumerate(entries):
            entry["polynomials"] = {
                "breaks": motion.breaks[ends[i] : ends[i + 1] + 1].tolist(),
                "coefficients": json_rows(motion.coefficients[ends[i] : ends[i + 1]]),
            }
        return entries

    def picture(self, name: str, kind: PictureFormat) -> bytes:
        """Draw position, velocity, acceleration and jerk over time, with the robot's name in the title."""
        from gelenk.plots.profiles import ProfileLines, Span, profiles_picture  # noqa: PLC0415

        chain, found = self.chain, self.found
        spans = []
        for report in found.segments:
            limits = self.question.segment_bounds[report.index].limits
            label = f"{report.index} {report.type}"
            spans.append(
                Span(label, report.start_time, report.end_time, (limits.velocity, limits.acceleration, limits.jerk))
            )
        slides = [self.robot.description.joint[name].type == "prismatic" for name in chain.joint_names]
        unit = "m" if slides and all(slides) else "(rad or m)" if any(slides) else "rad"
        units = [unit, *(f"{unit}/{per}" for per in ("s", "s²", "s³"))]
        title = f"{name if len(name) <= _MOST_NAME else name[: _MOST_NAME - 1] + '…'}: {found.motion.duration:.4g} s"
        if found.failure is not None:
            title += f", {100.0 * found.completed_fraction:.3g} % done: {found.failure.reason}"
        lines = ProfileLines(chain.joint_names, units, (None, None, None), spans=spans)
        return profiles_picture(title, found.motion, lines, kind)


def limits_json(limits: SegmentLimits) -> dict[str, Any]:
    """Return limits as JSON content; orjson writes the infinite one of an unlimited tip as null."""
    return {
        "joint_velocity": limits.velocity.tolist(),
        "joint_acceleration": limits.acceleration.tolist(),
        "joint_jerk": limits.jerk.tolist(),
        **({"joint_torque": limits.torque.most.tolist()} if limits.torque and limits.torque.is_limited else {}),
        "tip_velocity": limits.tip.speed,
        "tip_acceleration": limits.tip.acceleration,
        "tip_angular_velocity": limits.tip.angular_speed,
        "tip_angular_acceleration": limits.tip.angular_acceleration,
    }
