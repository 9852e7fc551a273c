"""Trajectories as a job: planned and audited, then sampled in parts."""

import itertools
from collections.abc import Iterator
from functools import lru_cache, partial
from pathlib import Path
from typing import IO, TypeAlias

import numpy as np
import orjson

from gelenk.contract.trajectory_request import MAX_JOB_SAMPLES, TrajectoryRequest
from gelenk.http.jobs.long_work import HEADERS, RESULTS, LongWork, as_bytes, headers_file
from gelenk.http.messages.payloads import CSV, JSON, NPY, PICTURES, read_json
from gelenk.jobs.parts import packed, unpacked
from gelenk.jobs.robot_files import RobotText, robot_of, robot_text
from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Work
from gelenk.operations.cells import IN_BODIES, cell_bodies, read_cell_bodies
from gelenk.operations.outcome import Limits, PictureFormat
from gelenk.operations.rows import csv_head, csv_rows
from gelenk.operations.trajectory_planned import SAMPLED, PlannedTrajectory, TrajectorySizeLimits, checked
from gelenk.operations.trajectory_request import shortest_duration
from gelenk.store.folders import read_plain
from gelenk.store.records import LoadedRobot
from gelenk.trajectory.plan import plan

KIND = "trajectory"

_CALL, _CELL = "call.json", "cell.json"
_PART = 8192
"""Samples per part."""
_PLAN, _STAGE, _DRAWING = "plan", "samples", "picture"
_PLANNED, _SAMPLED, _DRAWN = 0.5, 0.9, 0.95
_KINDS = tuple(PICTURES.values())
_GAP = b"\0"
"""Encloses the name of a field whose entries come from the parts; no JSON contains it."""

_Plan: TypeAlias = tuple[RobotText, bytes, int, bytes | None]
"""The robot, the call, how many numbers its polynomials may hold, and the bodies of its cell."""


def _request(loaded: LoadedRobot, call: TrajectoryRequest, limits: Limits) -> dict[str, bytes]:
    bounds = _bounds(limits.answer_numbers)
    chain, question = checked(loaded.robot, call, bounds)
    if bounds.may_be_exceeded(call, chain, shortest_duration(question.problem)):
        bounds.check(call, chain, plan(loaded.robot, chain, question.problem).motion.duration)
    whole = call.model_copy(update={"base_frame": chain.base_frame, "tip_frame": chain.tip_frame})
    files = {_CALL: whole.model_dump_json(exclude_unset=True, exclude=set(IN_BODIES)).encode()}
    bodies = cell_bodies(loaded, call)
    if bodies is None:
        return files
    bodies.cell(loaded.robot, chain, call.min_clearance)  # Refused here, and not later, if it is none.
    return {**files, _CELL: bodies.to_bytes()}


def _bounds(max_answer_numbers: int) -> TrajectorySizeLimits:
    # The samples are written part by part: only the disk limits them.
    return TrajectorySizeLimits(MAX_JOB_SAMPLES, max_answer_numbers)


def _work(limits: Limits, folder: Path) -> Work:
    cell = read_plain(folder / _CELL) if (folder / _CELL).exists() else None
    job = (robot_text(folder), read_plain(folder / _CALL), limits.answer_numbers, cell)

    def work(run: Run) -> Files:
        run.map(_PLAN, planned_part, lambda _: job, 1, (0.0, _PLANNED))
        (head,) = run.parts.of(_PLAN, 1)
        values = unpacked(head)
        frame, names = (values[name].tobytes() for name in ("frame", "columns"))
        rows, width = values["shape"].tolist()
        count, headers = -(-rows // _PART), orjson.loads(values["headers"].tobytes())
        run.map(_STAGE, sampled_part, lambda k: (job, k), count, (_PLANNED, _SAMPLED), _PART)
        run.map(_DRAWING, drawn_part, lambda k: (job, _KINDS[k]), len(_KINDS), (_SAMPLED, _DRAWN))
        drawn = zip(PICTURES, run.parts.of(_DRAWING, len(_KINDS)), strict=True)
        pictures = {RESULTS[media_type]: partial(_write, picture) for media_type, picture in drawn}

        def column(name: str) -> Iterator[bytes]:
            return (unpacked(part, name)[name].tobytes() for part in run.parts.of(_STAGE, count))

        def write_npy(target: IO[bytes]) -> None:
            np.lib.format.write_array_header_1_0(
                target, {"descr": "<f8", "fortran_order": False, "shape": (rows, width)}
            )
            target.writelines(column("rows"))

        def write_json(target: IO[bytes]) -> None:
            for i, piece in enumerate(frame.split(_GAP)):
                if i % 2 == 0:
                    target.write(piece)
                else:
                    _write_list(target, column(piece.decode()))

        return {
            RESULTS[JSON]: write_json,
            RESULTS[NPY]: write_npy,
            RESULTS[CSV]: lambda target: target.writelines(itertools.chain((names,), column("csv"))),
            **pictures,
            HEADERS: lambda target: target.write(headers_file({NPY: headers, CSV: headers})),
        }

    return work


def _write(content: bytes, target: IO[bytes]) -> None:
    target.write(content)


def _write_list(target: IO[bytes], lists: Iterator[bytes]) -> None:
    """Write several JSON lists as one."""
    target.write(b"[")
    for i, entries in enumerate(lists):
        target.write((b"," if i else b"") + entries[1:-1])
    target.write(b"]")


@lru_cache(maxsize=1)
def _planned(job: _Plan) -> PlannedTrajectory:
    """Plan the motion, once in each process that computes parts of the job; the result is the same in all of them."""
    text, content, numbers, cell = job
    bodies = None if cell is None else read_cell_bodies(cell)
    return PlannedTrajectory.of(robot_of(text), read_json(TrajectoryRequest, content), _bounds(numbers), bodies)


def planned_part(job: _Plan) -> bytes:
    """Compute all but the samples, in a separate process: the answer with gaps for them, and their number."""
    planned = _planned(job)
    certificate = planned.certificate(planned.samples(planned.times()))
    named = (*SAMPLED, *planned.further)
    gaps = {name: orjson.Fragment(_GAP + name.encode() + _GAP) for name in named}
    frame = orjson.dumps(planned.to_json(gaps, certificate), option=orjson.OPT_SERIALIZE_NUMPY)
    return packed(
        frame=as_bytes(frame),
        columns=as_bytes(csv_head(planned.columns)),
        headers=as_bytes(orjson.dumps(planned.headers)),
        shape=(len(planned.times()), len(planned.columns)),
    )


def sampled_part(job: tuple[_Plan, int]) -> bytes:
    """Compute some of the samples, in a separate process, in each format."""
    plan, k = job
    planned = _planned(plan)
    times = planned.times()[k * _PART : (k + 1) * _PART]
    rows, samples = planned.table(times), planned.samples(times).to_json(planned.call.pose_format)
    numbers = orjson.OPT_SERIALIZE_NUMPY
    fields = {name: as_bytes(orjson.dumps(entries, option=numbers)) for name, entries in samples.items()}
    return packed(rows=rows, csv=as_bytes(b"".join(csv_rows(rows))), **fields)


def drawn_part(job: tuple[_Plan, PictureFormat]) -> bytes:
    """Draw the motion, in a separate process."""
    plan, kind = job
    return _planned(plan).picture(plan[0].name, kind)


WORK = LongWork(_request, _work)
