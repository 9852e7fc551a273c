"""Audit of a whole motion, combined from the audits of its parts against their own limits and of how the parts meet."""

from collections.abc import Iterable, Sequence
from dataclasses import astuple, replace
from typing import TypeVar

from gelenk.kinematics.judge.judge import PoseCertificate
from gelenk.robot.chain import Chain
from gelenk.trajectory.audit.audit import Audit, continuity_of
from gelenk.trajectory.audit.result import LimitMargin, PathError, Peak, Reason, SmallestSingularValue, TipPeaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_Timed = TypeVar("_Timed", Peak, LimitMargin, SmallestSingularValue, Reason)


def whole(chain: Chain, motion: PiecewisePolynomial, audits: Sequence[Audit], starts: Sequence[float]) -> Audit:
    """Combine the audits of the parts into one of the whole motion.

    Args:
        chain: Chain that moves.
        motion: The whole motion.
        audits: Audits of its parts, at least one.
        starts: Start time of each part, [s].
    """
    if len(audits) == 1:
        return audits[0]
    timed = list(zip(audits, starts, strict=True))
    continuity, meeting = continuity_of(chain, motion)
    reasons = (*(_moved(reason, at) for one, at in timed for reason in one.reasons), *meeting)
    margins = (_moved(one.limit_margin, at) for one, at in timed if one.limit_margin)
    sigmas = (_moved(one.min_singular_value, at) for one, at in timed if one.min_singular_value)
    return Audit(
        not reasons,
        _worst((one.velocity, at) for one, at in timed),
        _worst((one.acceleration, at) for one, at in timed),
        _worst((one.jerk, at) for one, at in timed),
        _worst((one.path_deviation, at) for one, at in timed),
        _worst((one.orientation_deviation, at) for one, at in timed),
        continuity,
        min(sigmas, key=lambda one: one.value, default=None),
        min(margins, key=lambda one: one.value, default=None),
        {**_of(audits[0], "start"), **_of(audits[-1], "end")},
        TipPeaks(*(_of_tip([_moved(getattr(one.tip, name), at) for one, at in timed]) for name in TipPeaks.__slots__)),
        _certificate(audits),
        _path_error([one.way_error for one in audits if one.way_error is not None]),
        reasons,
    )


def _path_error(errors: Sequence[PathError]) -> PathError | None:
    if not errors:
        return None
    columns = zip(*(astuple(error) for error in errors), strict=True)
    return PathError(*(None if None in column else max(column) for column in columns))


def _worst(peaks: Iterable[tuple[Peak | None, float]]) -> Peak | None:
    """Return the peak nearest to its limit or furthest beyond it; the largest peak if none has a limit."""
    found = [_moved(peak, start) for peak, start in peaks if peak is not None]
    limited = [peak for peak in found if peak.ratio is not None]
    if limited:
        return max(limited, key=lambda peak: peak.ratio or 0.0)
    return max(found, key=lambda peak: abs(peak.value), default=None)


def _of_tip(peaks: Sequence[Peak]) -> Peak:
    """Return the largest value of all parts, with the largest ratio to the limit of a part."""
    largest = max(peaks, key=lambda peak: peak.value)
    return replace(largest, ratio=max((peak.ratio for peak in peaks if peak.ratio is not None), default=None))


def _moved(one: _Timed, start: float) -> _Timed:
    return replace(one, time=one.time + start)


def _of(audit: Audit, end: str) -> dict[str, float]:
    return {name: error for name, error in audit.ends.items() if name.startswith(end)}


def _certificate(audits: Sequence[Audit]) -> PoseCertificate:
    all_ = [audit.certificate for audit in audits]
    return PoseCertificate(
        sum(one.samples for one in all_),
        max(one.max_position_error for one in all_),
        max(one.max_orientation_error for one in all_),
        all_[0].seed,
    )
