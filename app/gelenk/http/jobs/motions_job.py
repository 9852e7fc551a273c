"""Batches of joint motions as a job: several motions per part."""

from functools import lru_cache
from pathlib import Path
from typing import IO, TypeAlias

import numpy as np
import orjson

from gelenk.collision.contact.words import ContactCertificate, together
from gelenk.contract.trajectories import COLUMNS, MAX_JOB_MOTIONS, MotionsRequest
from gelenk.http.jobs.long_work import CALL, RESULTS, LongWork, as_bytes, npy_file
from gelenk.http.messages.payloads import JSON, NPY, read_json
from gelenk.jobs.parts import packed, unpacked
from gelenk.jobs.robot_files import RobotText, robot_of, robot_text
from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Work
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.operations.cells import IN_BODIES, cell_bodies, read_cell_bodies
from gelenk.operations.outcome import Limits
from gelenk.operations.trajectories import parse, results_json, table
from gelenk.robot.arrays import Array
from gelenk.store.folders import read_plain
from gelenk.store.records import LoadedRobot

_ENDS, _CELL = "ends.npy", "cell.json"
_PART, _STAGE, _PLANNED = 8192, "motions", 0.95
"""Motions per part; the stage's name; progress when only the files are left to write."""

_Part: TypeAlias = tuple[RobotText, bytes, bytes | None, Array]
"""The robot, the call, the bodies of its cell, and starts and targets, shape (N, 2, n)."""


def _request(loaded: LoadedRobot, call: MotionsRequest, _: Limits) -> dict[str, bytes]:
    """Check a call and return its files; starts and targets are one array from here on."""
    batch = parse(loaded.robot, call, MAX_JOB_MOTIONS)
    ends = {"base_frame": batch.chain.base_frame, "tip_frame": batch.chain.tip_frame}
    rest = call.model_copy(update={"starts": None, "targets": [], **IN_BODIES, **ends})
    rows = np.stack((np.broadcast_to(batch.starts, batch.targets.shape), batch.targets), axis=1)
    files = {CALL: rest.model_dump_json(exclude_none=True).encode(), _ENDS: npy_file(rows)}
    bodies = cell_bodies(loaded, call)
    if bodies is None:
        return files
    bodies.cell(loaded.robot, batch.chain, call.min_clearance)  # Refused here, and not later, if it is none.
    return {**files, _CELL: bodies.to_bytes()}


def _work(_: Limits, folder: Path) -> Work:
    text, content = robot_text(folder), read_plain(folder / CALL)
    cell = read_plain(folder / _CELL) if (folder / _CELL).exists() else None
    rows = np.load(folder / _ENDS, mmap_mode="r")
    count = max(1, -(-len(rows) // _PART))

    def part(k: int) -> _Part:
        return text, content, cell, np.array(rows[k * _PART : (k + 1) * _PART])

    def work(run: Run) -> Files:
        run.map(_STAGE, planned_part, part, count, (0.0, _PLANNED), _PART)

        def write_npy(target: IO[bytes]) -> None:
            shape = len(rows), len(COLUMNS) + (cell is not None)
            np.lib.format.write_array_header_1_0(target, {"descr": "<f8", "fortran_order": False, "shape": shape})
            target.writelines(unpacked(one, "rows")["rows"].tobytes() for one in run.parts.of(_STAGE, count))

        def write_json(target: IO[bytes]) -> None:
            each = (unpacked(one, "certificate")["certificate"].tobytes() for one in run.parts.of(_STAGE, count))
            certificates = [PoseCertificate(**orjson.loads(one)) for one in each]
            about: tuple[list[str], ContactCertificate] | tuple[()] = ()
            if cell is not None:
                parts = [unpacked(one, "contacts")["contacts"].tobytes() for one in run.parts.of(_STAGE, count)]
                contacts = together([ContactCertificate(**orjson.loads(one)) for one in parts])
                about = read_cell_bodies(cell).warnings, contacts
            batch = parse(robot_of(text), _call(content, np.array(rows[:1])), MAX_JOB_MOTIONS)
            answer = batch.to_json([], PoseCertificate.of_all(certificates), *about)
            before, after = orjson.dumps(answer, option=orjson.OPT_SERIALIZE_NUMPY).split(b'"results":[]', 1)
            target.write(before + b'"results":[')
            for i, one in enumerate(run.parts.of(_STAGE, count)):
                target.write((b"," if i else b"") + unpacked(one, "results")["results"].tobytes()[1:-1])
            target.write(b"]" + after)

        return {RESULTS[JSON]: write_json, RESULTS[NPY]: write_npy}

    return work


def planned_part(job: _Part) -> bytes:
    """Plan some of the motions, in a separate process."""
    text, content, bodies, ends = job
    robot, call = robot_of(text), _call(content, ends)
    batch = parse(robot, call, MAX_JOB_MOTIONS)
    cell = None if bodies is None else read_cell_bodies(bodies).cell(robot, batch.chain, call.min_clearance)
    found = batch.planned(robot, cell)
    return packed(
        rows=table(found),
        contacts=as_bytes(orjson.dumps(found.contact_certificate)),
        results=as_bytes(orjson.dumps(results_json(found))),
        certificate=as_bytes(orjson.dumps(found.certificate)),
    )


def _call(content: bytes, ends: Array) -> MotionsRequest:
    """Return the call with the starts and targets of an npy body."""
    return _options(content).model_copy(update={"targets": ends})


@lru_cache(maxsize=2)
def _options(content: bytes) -> MotionsRequest:
    return read_json(MotionsRequest, content)


WORK = LongWork(_request, _work)
