"""Results of the audit that are part of an answer as they are, without the code that computes them."""

from dataclasses import dataclass
from typing import Literal

from gelenk.collision.contact.words import ContactCertificate
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.robot.result import Result
from gelenk.trajectory.audit.words import Check


@dataclass(frozen=True, slots=True)
class Peak(Result):
    """The largest value of a quantity, with its place and limit.

    Attributes:
        ratio: To its limit or tolerance, no unit; null without one.
        value: With its sign: of a joint [rad or m per sᵏ] or its torque [N m or N]; of the tip [m or rad], [m/s or
            rad/s], [m/s² or rad/s²].
        joint: Which joint; null for the tip.
        time: Time of the peak, [s].
    """

    ratio: float | None
    value: float
    joint: str | None
    time: float


@dataclass(frozen=True, slots=True)
class TipPeaks(Result):
    """Peaks of the tip; each `ratio` is the largest relative to the limit in force there."""

    speed: Peak
    angular_speed: Peak
    acceleration: Peak
    angular_acceleration: Peak


@dataclass(frozen=True, slots=True)
class Jump(Result):
    """The largest jump of a quantity where pieces meet.

    Attributes:
        value: Size of the jump, [rad or m per sᵏ].
        joint: The joint that jumps furthest; null if none does.
        time: Time of the peak, [s].
    """

    value: float
    joint: str | None
    time: float


@dataclass(frozen=True, slots=True)
class Continuity(Result):
    """Jumps where pieces meet; without joints null."""

    position: Jump | None
    velocity: Jump | None
    acceleration: Jump | None
    jerk: Jump | None


@dataclass(frozen=True, slots=True)
class LimitMargin(Result):
    """Distance of the joints from their limits.

    Attributes:
        value: Smallest distance to a limit, negative beyond, [rad or m].
        joint: The joint that comes nearest to a limit.
        bound: Which of its limits.
        time: Time of the peak, [s].
    """

    value: float
    joint: str
    bound: Literal["lower", "upper"]
    time: float


@dataclass(frozen=True, slots=True)
class SmallestSingularValue(Result):
    """The smallest singular value of the Jacobian along the path.

    Attributes:
        value: Its own, [m or rad] per [rad or m]: units are mixed.
        time: Time of the peak, [s].
    """

    value: float
    time: float


@dataclass(frozen=True, slots=True)
class ClosestPair(Result):
    """Two links, or a link or attached object and an object, of which no two others are nearer to each other.

    Attributes:
        a: Name of the one.
        b: Name of the other.
        distance: Between the two, [m]; where they overlap negative, by how far.
        point_a: Of `a`, in contact its deepest point, in the root frame, [m].
        point_b: Of `b`, likewise.
    """

    a: str
    b: str
    distance: float
    point_a: tuple[float, ...]
    point_b: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Moment(Result):
    """A moment of a motion, and what is nearest to each other then.

    Attributes:
        value: Distance of the pair less the clearance that an object of the scene demands, [m]; null if nothing can
            touch anything.
        time: When it is, [s].
        joint_positions: The configuration, [rad or m].
        pair: The two; null if nothing can touch anything.
    """

    value: float | None
    time: float
    joint_positions: tuple[float, ...]
    pair: ClosestPair | None


@dataclass(frozen=True, slots=True)
class MotionClearance(Moment):
    """The clearance of the whole motion: its nearest moment, and a bound that holds at all times.

    Attributes:
        lower_bound: Proved to be exceeded, or reached, at all times, also between samples, [m]: from one place to the
            next no body moves further than the distances there allow. Not less than `min_clearance`, unless the start
            itself is too near. Null if nothing can touch anything.
        resolution: Largest difference of the two, [m].
        certificate: Of that moment, and of even samples of the motion, through Pinocchio and Coal.
        continuous: That the bound holds between samples.
    """

    lower_bound: float | None
    resolution: float
    certificate: ContactCertificate
    continuous: Literal[True] = True


@dataclass(frozen=True, slots=True)
class Reason(Result):
    """Why a motion fails.

    Attributes:
        check: The limit or tolerance that is violated.
        detail: By how much, in one sentence.
        joint: The joint responsible; null if no single joint is.
        time: Time of the peak, [s].
    """

    check: Check
    detail: str
    joint: str | None
    time: float


@dataclass(frozen=True, slots=True)
class PathError(Result):
    """Difference of the joints' peak ratios from those of the exact tip path with the same time law.

    Each may be larger or smaller by at most this; null where it is unknown: where joints are damped and leave the path,
    and in singularities. The k of `timing` has the same accuracy.

    Attributes:
        velocity: Of `velocity`'s ratio, no unit.
        acceleration: Of `acceleration`'s ratio.
        jerk: Of `jerk`'s ratio.
    """

    velocity: float | None
    acceleration: float | None
    jerk: float | None


@dataclass(frozen=True, slots=True)
class Audit(Result):
    """The check of the motion, also between samples, by code independent of the planner.

    A ratio is relative to the limit in force at the time.

    Attributes:
        passed: Whether the motion keeps every limit and tolerance. One that does not is not sent, unless all that is
            wrong is that its start is too near to something: then that start is all of the motion.
        velocity: Of the joint nearest to its limit; null without joints.
        jerk: Of the pieces: where the acceleration jumps it is infinite, as `continuity` reports. Its limits are kept
            by `quintic`, `septic` and `jerk_limited`; another law is only compared with them, and `notes` of its
            segment say where it goes beyond.
        path_deviation: Distance from the tip's path, [m]; null without one.
        orientation_deviation: Angle from the tip's path, [rad]; null without one.
        min_singular_value: Null without joints.
        limit_margin: Null where no joint has limits.
        ends: By name, how far a position, velocity or acceleration at the start or the end is from its required value,
            [rad or m per sᵏ].
        joint_torque: Torque of the joint nearest to its limit, or without limits the largest, recomputed through
            Pinocchio; null unless the request has `limits.joint_torque`, `payload` or `torques`.
        certificate: Of poses along the motion, recomputed through Pinocchio.
        way_error: Difference of these three from those of the exact tip path; null without one.
        reasons: Why the motion fails the audit.
        clearance: Of all links, and of what is around and attached; null unless the request has `scene` or
            `min_clearance`.
    """

    passed: bool
    velocity: Peak | None
    acceleration: Peak | None
    jerk: Peak | None
    path_deviation: Peak | None
    orientation_deviation: Peak | None
    continuity: Continuity
    min_singular_value: SmallestSingularValue | None
    limit_margin: LimitMargin | None
    ends: dict[str, float]
    tip: TipPeaks
    joint_torque: Peak | None
    certificate: PoseCertificate
    way_error: PathError | None
    reasons: tuple[Reason, ...]
    clearance: MotionClearance | None = None
