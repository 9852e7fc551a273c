"""POST /v1/course/pipeline: a line of a planar arm's tip, sampled, solved and interpolated in joint space."""

from typing import Any

import numpy as np

from gelenk.contract.pipeline import PipelineRequest
from gelenk.course.cartesian.pipeline import Pipeline, pipeline, pipeline_steps
from gelenk.course.cartesian.planar_line import tips
from gelenk.language import translated as _
from gelenk.operations.course_motion import joint_limits, line_of, peaks_info, segments_info
from gelenk.operations.outcome import Outcome, PictureFormat, always
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.laws import POLYNOMIALS
from gelenk.trajectory.motion.extremes import peaks_by_order
from gelenk.trajectory.motion.time_laws import rest_to_rest


def run(call: PipelineRequest) -> Outcome:
    """Plan the joint trajectory in four steps, with a worked solution."""
    return Outcome(lambda: _content(call), picture=lambda kind: _picture(call, kind))


is_heavy = always  # the certificate takes milliseconds


def _planned(call: PipelineRequest) -> Pipeline:
    shares = np.linspace(0.0, 1.0, call.samples)
    if call.law != "uniform":
        shares = rest_to_rest(0.0, 1.0, POLYNOMIALS[call.law]).at(shares)[:, 0]
    return pipeline(line_of(call), shares, call.duration)


def _content(call: PipelineRequest) -> dict[str, Any]:
    found = _planned(call)
    line, limits = found.line, joint_limits(call.limits, 2)
    deviation = None if found.spline is None else found.largest_deviation()
    spline = None
    if found.spline is not None:
        spline = {
            "segments": segments_info(found.spline.motion),
            "velocities": found.spline.velocities,
            "peaks": peaks_info(peaks_by_order(found.spline.motion), limits),
        }
    way = line.target - line.start
    return {
        "knots": [
            {"position": [p.real, p.imag], "joint_positions": _angles(q)}
            for p, q in ((line.start, line.angles), (line.target, line.configurations(np.array([1.0]))[0]))
        ],
        "length": line.length,
        "direction": [way.real / abs(way), way.imag / abs(way)],
        "elbow": "right" if line.elbow > 0.0 else "left",
        "samples": _samples(found),
        "leaves_workspace": line.beyond,
        "spline": spline,
        "curve": None if found.spline is None else _curve(found, call.curve_samples),
        "max_deviation": deviation,
        "steps": pipeline_steps(found, deviation),
        "warnings": _warnings(found),
        "certificate": found.certificate(deviation),
    }


def _angles(q: Array) -> list[float] | None:
    return None if np.isnan(q).any() else q.tolist()


def _samples(found: Pipeline) -> list[dict[str, Any]]:
    line, entries = found.line, []
    determinants, singular = line.determinants(found.configurations), line.is_singular(found.configurations)
    points = line.points(found.shares)
    for k, (time, s) in enumerate(zip(found.times.tolist(), found.shares.tolist(), strict=True)):
        q = _angles(found.configurations[k])
        entries.append(
            {
                "time": time,
                "s": s,
                "position": [points[k].real, points[k].imag],
                "joint_positions": q,
                "determinant": None if q is None else float(determinants[k]),
                "status": "out_of_reach" if q is None else "singular" if singular[k] else "reached",
            }
        )
    return entries


def _curve(found: Pipeline, count: int) -> dict[str, Any]:
    times = np.linspace(0.0, found.times[-1], count)
    q, rates, changes = found.motion.rates_at(times)
    p = tips(found.line.lengths, q)
    return {
        "times": times,
        "joint_positions": q,
        "joint_velocities": rates,
        "joint_accelerations": changes,
        "positions": np.column_stack((p.real, p.imag)),
        "deviations": found.deviations(q),
    }


def _warnings(found: Pipeline) -> list[str]:
    texts, missing = [], np.flatnonzero(np.isnan(found.configurations[:, 0]))
    if len(missing):
        text = _("Sample {first} is out of reach, {count} of {samples} in all: there is no joint trajectory.")
        texts.append(text.format(first=int(missing[0]) + 1, count=len(missing), samples=len(found.times)))
    if found.line.beyond is not None:
        text = _("The line leaves the workspace at s = {s:.6g}.")
        if not len(missing):
            text = _("The line leaves the workspace at s = {s:.6g}, between two samples, which do not show it.")
        texts.append(text.format(s=found.line.beyond))
    if found.line.is_singular(found.configurations).any():
        texts.append(_("The arm is stretched or folded at a sample: velocities grow without bound near it."))
    return texts


def _picture(call: PipelineRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.motion.pipeline import pipeline_picture  # noqa: PLC0415

    found = _planned(call)
    found.certificate(None if found.spline is None else found.largest_deviation())
    return pipeline_picture(found, kind)
