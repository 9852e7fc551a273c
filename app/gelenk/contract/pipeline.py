"""From points to a joint trajectory in four steps: request, answer, operation."""

from typing import Annotated, Literal

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.course_motion import Duration, MotionLimits, PeaksInfo, PlanarLinePayload, SegmentInfo
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import InLanguage, Steps, Warnings
from gelenk.course.cartesian.pipeline import Deviation, PipelineCertificate
from gelenk.trajectory.audit.words import PolynomialLaw

SampleStatus = Literal["reached", "singular", "out_of_reach"]


class PipelineRequest(PlanarLinePayload, InLanguage):
    """A planar arm, a line of its tip, and how to sample it."""

    samples: Annotated[int, Field(ge=2, le=1000)] = Field(
        default=9, description="N, both ends included, evenly spaced in time; no unit."
    )
    duration: Duration = Field(description="T, [s].")
    law: Literal["uniform", PolynomialLaw] = Field(
        default="uniform",
        description="Of s at the samples: `uniform`, at equal distances; or a polynomial from rest to rest.",
    )
    curve_samples: Annotated[int, Field(ge=2, le=10_000)] = Field(
        default=101, description="Number of samples of the joint trajectory in the answer, evenly spaced; no unit."
    )
    limits: MotionLimits | None = optional("Limits of each joint, to compare the peaks with.")


class PathKnot(Answer):
    """An end of the line."""

    position: list[float] = Field(description="x and y, [m].")
    joint_positions: list[float] | None = Field(description="q₁ and q₂, [rad]; null out of reach.")


class PathSample(Answer):
    """A point of the line and its configuration."""

    time: float = Field(description="When the tip is to be there, [s].")
    s: float = Field(description="Place on the line, 0 to 1; no unit.")
    position: list[float] = Field(description="p(s), [m].")
    joint_positions: list[float] | None = Field(description="On the branch of the start, [rad]; null out of reach.")
    determinant: float | None = Field(description="det J = l₁ l₂ sin q₂, [m²]; null out of reach.")
    status: SampleStatus = Field(description="`singular`: stretched or folded, with |sin q₂| below 1e-6.")


class JointSplineInfo(Answer):
    """The clamped cubic spline through the samples."""

    segments: list[SegmentInfo]
    velocities: list[list[float]] = Field(description="At the samples, one row each, [rad/s].")
    peaks: PeaksInfo


class PipelineCurve(Answer):
    """The joint trajectory and where it takes the tip."""

    times: list[float] = Field(description="Evenly spaced, [s].")
    joint_positions: list[list[float]] = Field(description="Values of the spline, [rad].")
    joint_velocities: list[list[float]] = Field(description="Its first derivatives, [rad/s].")
    joint_accelerations: list[list[float]] = Field(description="Its second derivatives, [rad/s²].")
    positions: list[list[float]] = Field(description="Of the tip, [m].")
    deviations: list[float] = Field(description="Of the tip from the line, to its left positive, [m].")


class PipelineAnswer(Answer):
    """Knots, path, samples, joint trajectory."""

    knots: list[PathKnot] = Field(description="The two ends of the line.")
    length: float = Field(description="L, [m].")
    direction: list[float] = Field(description="Unit vector along the line, no unit.")
    elbow: Literal["left", "right"] = Field(
        description="The side of the ray from base to tip on which the elbow lies: `right` where sin q₂ > 0."
    )
    samples: list[PathSample]
    leaves_workspace: float | None = Field(
        description="The first s at which the line leaves what the arm reaches, also between samples; null if it does "
        "not. No unit."
    )
    spline: JointSplineInfo | None = Field(description="Null if a sample is out of reach.")
    curve: PipelineCurve | None = Field(description="Likewise.")
    max_deviation: Deviation | None = Field(description="Exact, not of the samples; null likewise.")
    steps: Steps
    warnings: Warnings
    certificate: PipelineCertificate | None = Field(description="Null likewise.")


ENDPOINT = Endpoint(
    name="pipeline",
    path="v1/course/pipeline",
    tag="Course",
    request=PipelineRequest,
    answer=PipelineAnswer,
    summary="From points to a joint trajectory in four steps",
    description="""
    The four steps of planning in Cartesian space, for a planar arm with two joints: knots → path → N samples with their
    inverse kinematics → interpolation of the joints.

    The tip begins at the configuration `start` and goes straight to `target`. Every sample is solved on the branch of
    the start, its angles continued without jumps by 2π. A clamped cubic spline through the samples moves the joints;
    between samples the tip leaves the line, by at most `max_deviation`, which falls as N grows.

    Samples that the arm does not reach, or where it is stretched or folded, are marked; if one is out of reach there is
    no spline, and the answer says where the line leaves the workspace.

    As a picture with `Accept: image/svg+xml`, `image/png` or `application/pdf`: the arm at the samples with the
    ellipses of its velocity manipulability, the path of the tip, the joints over time, and the deviation.
    """,
    picture="The arm at its samples with their velocity ellipses, the joints and the deviation over time.",
    example={
        "lengths": [1.0, 1.0],
        "start": [1.9198621771937625, 2.443460952792061],
        "target": [0.816, 1.4],
        "samples": 5,
        "duration": 2.0,
        "curve_samples": 5,
    },
)
