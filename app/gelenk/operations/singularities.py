"""Singularities of a robot: at configurations and along a path, with their worked solution."""

import re
import time
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from gelenk.contract.singularities import MAX_NEAREST, MAX_PATH, MAX_PLACES, MAX_REPORTS, SingularityRequest
from gelenk.course.steps import Step, step
from gelenk.course.velocity.singularity_steps import SingularityQuestion, singularity_steps
from gelenk.course.writing import number
from gelenk.dh.derive.steps import determinant_steps
from gelenk.dh.tables.from_chain import standard_table
from gelenk.dh.worked import WorkedSolution, worked_solution
from gelenk.errors import TooLarge, counted
from gelenk.ik.search.task import Task
from gelenk.kinematics.judge.judge import MAX_SAMPLES
from gelenk.kinematics.judge.words import JacobianCertificate, SingularityCertificate
from gelenk.kinematics.singularity.distance import NearestSingularity, can_lose, nearest_singularity
from gelenk.kinematics.singularity.path import PathMinimum, places_along
from gelenk.kinematics.singularity.report import SingularityReport, certify_reports, singularity_report
from gelenk.kinematics.velocity.jacobian import jacobians, singular_values
from gelenk.kinematics.velocity.task_space import TaskSpace, random_configurations, structure
from gelenk.language import translated as _
from gelenk.operations.chains import chain_and_positions, check_numbers, check_worked, head, task_of, units_are_mixed
from gelenk.operations.derive_dh import in_time
from gelenk.operations.outcome import Limits, Outcome
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

_SECONDS = 4.0
"""Processor time of the determinant in symbols, [s]."""
_TRIALS = 5
_SAME = 1e-6


def worked_singularities(
    robot: RobotModel, chain: Chain, space: TaskSpace, qs: Array, reports: Sequence[SingularityReport]
) -> list[list[Step]]:
    """Return the steps at each configuration."""
    Js, factored = space.with_rounding(chain, qs)[0], _factored(robot, chain, space)
    return [
        singularity_steps(
            SingularityQuestion(
                space.task.directions,
                J,
                report.rank,
                report.structural_rank,
                report.lost_directions,
                report.internal_motions,
                report.kinds,
                space.characteristic_length if space.turns else None,
            ),
            factored,
        )
        for J, report in zip(Js, reports, strict=True)
    ]


def _factored(robot: RobotModel, chain: Chain, space: TaskSpace) -> list[Step]:
    """Return the determinant of a table's square block, if it is what the rows of the task lose their rank by.

    That is so where its size is the product of the singular values at random configurations.
    """
    if not 0 < len(chain) <= 6:
        return []
    trials = random_configurations(chain, _TRIALS)
    table = standard_table(robot.description, chain)
    if table is None or any(row.mimic is not None for row in table.joints):
        return []
    until = time.process_time() + _SECONDS
    found = worked_solution(table, list(map(tuple, trials.tolist())), run=in_time, deadline=until)
    plain = TaskSpace(space.task, None, space.reference)
    products = np.prod(np.linalg.svd(plain.jacobians(chain, trials), compute_uv=False), axis=1)
    sizes = np.abs(np.array(found.determinants, dtype=float))
    if not np.allclose(products, sizes, rtol=_SAME, atol=_SAME * sizes.max(initial=0.0)):
        return []
    return _with_lengths(found)


def _with_lengths(found: WorkedSolution) -> list[Step]:
    """Return the steps of a determinant, and what the symbols of its lengths are."""
    steps, singular = determinant_steps(found.singularities), found.singularities
    if not steps or singular is None or singular.formula is None or found.formulas is None:
        return []
    names = set(re.findall(r"\w+", singular.formula.plain))
    legend = {entry.latex: entry for entry in (*found.formulas.legend, *singular.legend)}
    values = [
        f"{entry.latex} = {number(entry.value)}"
        for entry in legend.values()
        if entry.value is not None and entry.plain in names
    ]
    first = steps[0]
    lines = (*first.latex, r",\quad ".join(values)) if values else first.latex
    return [step(first.title, first.text, *lines), *steps[1:]]


_QUICK_REPORTS = 1
"""Reports that take the event loop about half a millisecond; more go to a worker."""
_ENTRY = 120
"""Maximum count of numbers in a report besides those of its joints."""


def run(loaded: LoadedRobot, call: SingularityRequest, limits: Limits) -> Outcome:
    """Report the singularities at configurations, the nearest ones, and those along a path."""
    chain, qs = chain_and_positions(loaded.robot, call)
    space = TaskSpace(task_of(call.task), call.characteristic_length, call.reference)
    _check_size(call, len(qs), len(chain), limits)
    check_worked(call, len(qs))
    certificate = jacobians(loaded.robot, chain, qs).certificate
    fits = not (call.nearest or call.path or call.steps)
    return Outcome(
        lambda: _content(loaded.robot, chain, call, qs, space, certificate),
        (lambda: (singular_values(space.jacobians(chain, qs)), {})) if fits else None,
    )


def is_heavy(call: SingularityRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return call.nearest or call.path or call.steps or len(call.joint_positions) > _QUICK_REPORTS


def singularity_info(chain: Chain, report: SingularityReport) -> dict[str, Any]:
    """Return a report in the form of `SingularityInfo`."""
    defect = report.defect
    lost = zip(report.twists.T.tolist(), report.wrenches.T.tolist(), strict=True)
    return {
        "singular": defect > 0,
        "rank": report.rank,
        "structural_rank": report.structural_rank,
        "rank_tolerance": report.tolerance,
        "singular_values": report.sigmas.tolist(),
        "smallest_singular_value": report.smallest,
        "lost_directions": [
            {"twist": twist, "wrench": wrench, "lost_here": k < defect} for k, (twist, wrench) in enumerate(lost)
        ],
        "internal_motions": [
            {"joint_velocities": motion, "only_here": k < defect}
            for k, motion in enumerate(report.internal_motions.T.tolist())
        ],
        "dependent_joints": _names(chain, report.joints),
        "kinds": report.kinds,
        "exit": None
        if report.exit is None
        else {
            "joint": chain.joint_names[int(np.argmax(np.abs(report.exit)))],
            "direction": report.exit.tolist(),
            "rate": report.exit_rate,
        },
    }


def _names(chain: Chain, joints: tuple[int, ...]) -> list[str]:
    return [chain.joint_names[j] for j in joints]


def _check_size(call: SingularityRequest, count: int, joints: int, limits: Limits) -> None:
    if count > MAX_REPORTS:
        raise TooLarge("configurations with singularity reports", count, MAX_REPORTS)
    if call.path and count > MAX_PATH:
        raise TooLarge("configurations of a path", count, MAX_PATH)
    most = max(1, MAX_NEAREST * 49 // max(joints, 7) ** 2)
    if call.nearest and count > most:
        raise TooLarge(f"configurations of {counted(joints, 'joint')} whose nearest singularity is wanted", count, most)
    check_numbers(count * (_ENTRY + joints * (joints + 4)) * (1 + call.path), limits)


def _content(
    robot: RobotModel,
    chain: Chain,
    call: SingularityRequest,
    qs: Array,
    space: TaskSpace,
    certificate: JacobianCertificate,
) -> dict[str, Any]:
    reports = [singularity_report(chain, q, call.rank_tolerance, space) for q in qs]
    products = [certify_reports(robot, chain, space, qs, reports)]
    certified = [certificate]
    entries = [singularity_info(chain, report) for report in reports]
    answer: dict[str, Any] = {
        **head(chain),
        "reference": space.reference,
        "task": space.task.directions,
        "rank_tolerance": call.rank_tolerance,
        "characteristic_length": call.characteristic_length,
        "units_mixed": units_are_mixed(chain, space),
        "singularities": entries,
    }
    if call.steps:
        answer["steps"] = worked_singularities(robot, chain, space, qs, reports)
    if call.nearest:
        radius, tolerance, limited = call.search_radius, call.rank_tolerance, call.respect_limits
        found = [
            nearest_singularity(chain, q, space, radius=radius, tolerance=tolerance, respect_limits=limited) for q in qs
        ]
        certified += _recomputed(robot, chain, [nearest.q for nearest in found if nearest is not None])
        for entry, q, nearest in zip(entries, qs, found, strict=True):
            entry.update(_nearest(chain, space, call, q, nearest))
    if call.path:
        places = places_along(chain, qs, space, call.rank_tolerance, call.path_threshold)
        shown = sorted(sorted(places, key=lambda place: place.share)[:MAX_PLACES], key=lambda place: place.start)
        reports = [singularity_report(chain, place.q, call.rank_tolerance, space) for place in shown]
        sample = [place.q for place in shown[:MAX_SAMPLES]]
        certified += _recomputed(robot, chain, sample)
        products.append(certify_reports(robot, chain, space, np.array(sample), reports))
        answer["path"] = {
            "places": [_place(chain, len(qs), *each) for each in zip(shown, reports, strict=True)],
            "omitted": len(places) - len(shown),
        }
    answer["certificate"] = SingularityCertificate(
        sum(part.samples for part in certified),
        max(part.max_error for part in certified),
        None,
        certificate.seed,
        max(product["max_internal_motion"] for product in products),
        max(product["max_lost_direction"] for product in products),
    )
    return answer


def _recomputed(robot: RobotModel, chain: Chain, rows: list[Array]) -> Iterator[JacobianCertificate]:
    """Yield certificates of further configurations, so few each that all are recomputed."""
    for first in range(0, len(rows), MAX_SAMPLES):
        yield jacobians(robot, chain, np.array(rows[first : first + MAX_SAMPLES])).certificate


def _nearest(
    chain: Chain, space: TaskSpace, call: SingularityRequest, q: Array, nearest: NearestSingularity | None
) -> dict[str, Any]:
    if nearest is None:
        return {"nearest": None, "nearest_reason": _why_none(chain, space, call)}
    report = singularity_report(chain, nearest.q, call.rank_tolerance, space)
    within = bool(((chain.lower <= nearest.q) & (nearest.q <= chain.upper)).all())
    return {
        "nearest": {
            "distance": nearest.distance,
            "joint_positions": nearest.q.tolist(),
            "displacement": (nearest.q - q).tolist(),
            "joints": _names(chain, nearest.joints),
            "within_limits": within,
            "smallest_singular_value": nearest.sigma,
            "kinds": report.kinds,
            "dependent_joints": _names(chain, report.joints),
        }
    }


def _why_none(chain: Chain, space: TaskSpace, call: SingularityRequest) -> str:
    """Return why no singular configuration was found, and perhaps a smaller task that loses something."""
    rank = structure(chain, space.task, space.reference).rank
    if rank == 0:
        return _("nothing can be lost: the tip has none of these directions at any configuration")
    if not can_lose(chain, space):
        return _("nothing can be lost: of these directions the tip has the same at every configuration")
    reason = _(
        "no singular configuration was found within a radius of {radius:.6g} within the joint limits"
        if call.respect_limits
        else "no singular configuration was found within a radius of {radius:.6g}"
    ).format(radius=call.search_radius)
    if rank == len(space):
        return reason
    text = _("{reason}: of {count} directions the tip has {rank} at most, and it keeps as many wherever was looked")
    reason = text.format(reason=reason, count=len(space), rank=rank)
    fewer = _positions_that_move(chain, space)
    text = _("{reason}; what it loses of the position shows with `task` {fewer}")
    return reason if fewer is None else text.format(reason=reason, fewer=fewer)


def _positions_that_move(chain: Chain, space: TaskSpace) -> str | None:
    """Return the linear directions in which the tip moves; None if none, all of the task, or dependent ones do."""
    names = [direction for direction in space.task.directions if direction in {"x", "y", "z"}]
    moving = tuple(name for name in names if structure(chain, Task((name,)), space.reference).rank)
    if not moving or len(moving) == len(space) or structure(chain, Task(moving), space.reference).rank < len(moving):
        return None
    return " ".join(moving)


def _place(chain: Chain, count: int, place: PathMinimum, report: SingularityReport) -> dict[str, Any]:
    segment = min(int(place.start), max(count - 2, 0))
    return {
        "segment": segment,
        "fraction": place.start - segment,
        "end": place.end,
        "joint_positions": place.q.tolist(),
        "report": singularity_info(chain, report),
    }
