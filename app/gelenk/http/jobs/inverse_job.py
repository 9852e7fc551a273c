"""Inverse kinematics as a job: several targets per part, each solved as if it were the only one."""

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from io import BytesIO
from pathlib import Path
from typing import IO, Any, NamedTuple, TypeAlias

import numpy as np
import orjson
from numpy.typing import NDArray

from gelenk.collision.cell import Cell
from gelenk.collision.contact.words import ContactCertificate, together
from gelenk.contract.ik import MAX_JOB_STEPWISE, MAX_JOB_TARGETS, MAX_TRACE, InverseRequest
from gelenk.errors import InvalidField, UnknownJob
from gelenk.http.jobs.long_work import AS_SENT, HEADERS, LongWork, as_bytes, headers_file, npy_file
from gelenk.http.messages.payloads import NPY, read_json
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.search import in_one_thread
from gelenk.ik.solve import solve
from gelenk.jobs.parts import packed, unpacked
from gelenk.jobs.robot_files import RobotText, robot_of, robot_text
from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Work
from gelenk.operations.cells import IN_BODIES, cell_bodies, read_cell_bodies
from gelenk.operations.ik_answer import PlainResults, plain_results, results_to_json, table, to_json, unsolved_headers
from gelenk.operations.ik_contacts import contacts_of
from gelenk.operations.ik_request import (
    NUMBERS_OF_CONTACT,
    NUMBERS_OF_STEPS,
    TargetLimits,
    has_table,
    is_stepwise,
    options_of,
    parse,
)
from gelenk.operations.outcome import Limits
from gelenk.operations.pose_arrays import poses_from
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.store.folders import open_plain, read_plain
from gelenk.store.records import LoadedRobot

_CALL, _TARGETS, _SEEDS, _CELL = "call.json", "targets.npy", "seeds.npy", "cell.json"
_PARTS, _ABOUT = "result.parts", "result.about"
"""Files of a result: the parts one after another; and all else that the answer consists of, with their sizes."""
_BOUNDS = TargetLimits(MAX_JOB_TARGETS, MAX_JOB_STEPWISE, None)
_PART, _PART_OF_MANY = 4096, 128
"""Targets per part: of quick calls (one solution each, no objective, not stepwise), and of all others."""

_TRIED, _BYTES_A_NUMBER = 64, 100
"""Targets solved to estimate the size of all results; done only if this many bytes per number are too many."""
_STAGE = "targets"
_SOLVED = 0.95
"""Progress when only the files are left to write."""


class _Rows(NamedTuple):
    """Rows of the targets (as sent, or 12 numbers: position, rotation matrix) and the seeds, in the job's folder."""

    folder: Path
    first: int
    last: int

    def read(self) -> tuple[Array, Array]:
        """Read both from disk as they are needed: a million targets are a hundred megabytes.

        Raises UnknownJob if the job has been removed.
        """
        try:
            targets, seeds = (np.load(self.folder / name, mmap_mode="r") for name in (_TARGETS, _SEEDS))
        except FileNotFoundError:
            raise UnknownJob(self.folder.parent.name) from None
        rows = slice(self.first, self.last)
        found = np.array(targets[rows], dtype=np.float64, order="C")
        return found, np.array(seeds if len(seeds) == 1 else seeds[rows])


_Part: TypeAlias = tuple[RobotText, bytes, bytes | None, _Rows | tuple[Array, Array]]
"""The robot, the call, its cell, and targets and seeds, or where processes of this machine find them."""


def _request(loaded: LoadedRobot, call: InverseRequest, limits: Limits) -> dict[str, bytes | None]:
    """Check a call and return its files; targets and seeds are arrays from here on."""
    if call.time_limit is not None:
        raise InvalidField(
            "time_limit", "a job looks for each target to the end: leave it out, or ask for the answer now"
        )
    problem = parse(loaded.robot, call, _BOUNDS)
    bodies = cell_bodies(loaded, call)
    cell = None if bodies is None else bodies.cell(loaded.robot, problem.chain, call.min_clearance)
    _check_room(limits.job_bytes, problem, call, cell)
    fixed = {"base_frame": problem.chain.base_frame, "tip_frame": problem.chain.tip_frame}
    rest = call.model_copy(update={"targets": [], "seeds": None, **IN_BODIES, **fixed})
    files = {_CALL: rest.model_dump_json().encode(), _SEEDS: npy_file(problem.seeds)}
    if bodies:
        files[_CELL] = bodies.to_bytes()
    if isinstance(call.targets, np.ndarray):
        return {**files, _TARGETS: AS_SENT}
    rows = np.column_stack((problem.targets.positions, problem.targets.rotations.reshape(-1, 9)))
    return {**files, _TARGETS: npy_file(rows)}


def _check_room(most_bytes: int, problem: TargetProblem, call: InverseRequest, cell: Cell | None) -> None:
    """Refuse a call whose results would exceed `most_bytes`, as some targets show; say how many there is room for."""
    count = len(problem)
    rows = call.max_solutions if call.solutions == "all" else MAX_TRACE if call.trace else 1
    numbers = rows * (len(problem.chain) + 4 + NUMBERS_OF_CONTACT * bool(cell)) + NUMBERS_OF_STEPS * call.steps
    if count * numbers * _BYTES_A_NUMBER <= most_bytes:
        return
    whole = _bytes_each(problem, call, cell, count) * count
    if whole <= most_bytes:
        return
    room = int(0.9 * count * most_bytes / whole)
    # Check each smaller number too: the first targets may have more solutions than the others.
    while room > 1 and _bytes_each(problem, call, cell, room) * room > most_bytes:
        room = int(0.9 * room)
    raise InvalidField(
        "targets",
        f"what comes of all {count:,} takes some {whole:.2g} bytes, and the parts of a job may take "
        f"{most_bytes:,}: ask for at most {max(1, room):,} at a time, or for less of each",
    )


def _bytes_each(problem: TargetProblem, call: InverseRequest, cell: Cell | None, count: int) -> float:
    """Return the mean size, in bytes, of the result of one of the first `count` targets, from some of them."""
    some = np.unique(np.linspace(0, count - 1, _TRIED).astype(np.int64))
    return len(_solved(problem.taken(some), call, cell)) / len(some)


def _work(_: Limits, folder: Path) -> Work:
    text, content = robot_text(folder), read_plain(folder / _CALL)
    call = read_json(InverseRequest, content)
    cell = read_plain(folder / _CELL) if (folder / _CELL).exists() else None
    number = len(np.load(folder / _TARGETS, mmap_mode="r"))
    quick = call.solutions == "one" and call.objective is None and not is_stepwise(call) and cell is None
    size = _PART if quick else _PART_OF_MANY
    count = max(1, -(-number // size))

    def work(run: Run) -> Files:
        def part(k: int) -> _Part:
            rows = _Rows(folder, k * size, (k + 1) * size)
            return text, content, cell, rows if run.is_here else rows.read()

        run.map(_STAGE, solved_part, part, count, (0.0, _SOLVED), size)
        chain = robot_of(text).chain(call.base_frame, call.tip_frame)
        warnings = None if cell is None else read_cell_bodies(cell).warnings
        found = _Found(call, chain, warnings, lambda: run.parts.of(_STAGE, count))
        return {_PARTS: found.write_parts, _ABOUT: found.write_about, HEADERS: found.write_headers}

    return work


def solved_part(job: _Part) -> bytes:
    """Solve some targets, in a separate process: results as arrays or as JSON, and indices of unsolved targets."""
    text, content, bodies, given = job
    rows, seeds = given.read() if isinstance(given, _Rows) else given
    robot, call = robot_of(text), _call(content)
    chain = robot.chain(call.base_frame, call.tip_frame)
    cell = None if bodies is None else read_cell_bodies(bodies).cell(robot, chain, call.min_clearance)
    targets = Poses(rows[:, :3].copy(), rows[:, 3:].reshape(-1, 3, 3)) if rows.shape[1] == 12 else poses_from(rows, "")
    with in_one_thread():
        return _solved(TargetProblem(robot, chain, targets, seeds, options_of(chain, call, None)), call, cell)


def _solved(problem: TargetProblem, call: InverseRequest, cell: Cell | None) -> bytes:
    result = solve(problem, cell)
    head = {"count": len(problem), "form": as_bytes(orjson.dumps(result.closed_form))}
    contacts = contacts_of(cell, result)
    if contacts is None and (plain := plain_results(problem, call, result)) is not None:
        return packed(**head, **plain._asdict())
    results = orjson.dumps(results_to_json(problem, call, result, contacts), option=orjson.OPT_SERIALIZE_NUMPY)
    return packed(
        **head,
        certificate=contacts and as_bytes(orjson.dumps(contacts.certificate)),
        rows=table(problem.chain, result) if has_table(call) else None,
        unsolved=np.array(list(result.failures), dtype=np.int64),
        results=as_bytes(results),
    )


@lru_cache(maxsize=2)
def _call(content: bytes) -> InverseRequest:
    return read_json(InverseRequest, content)


class _Found:
    """The results of all parts: reading the parts takes longer than all else, so the first file gathers the others."""

    def __init__(
        self, call: InverseRequest, chain: Chain, warnings: list[str] | None, parts: Callable[[], Iterator[bytes]]
    ) -> None:
        self._call, self._chain, self._warnings, self._parts = call, chain, warnings, parts
        self._certificates: list[ContactCertificate] = []
        self._form, self._sizes, self._count = b"", list[int](), 0
        self._unsolved: list[int] = []

    def write_parts(self, target: IO[bytes]) -> None:
        for part in self._parts():
            values = unpacked(part, "form", "count", "unsolved", "certificate")
            self._form = values["form"].tobytes()
            self._unsolved += (self._count + values["unsolved"]).tolist()
            self._count += int(values["count"])
            self._sizes.append(len(part))
            if "certificate" in values:
                self._certificates.append(ContactCertificate(**orjson.loads(values["certificate"].tobytes())))
            target.write(part)

    def write_about(self, target: IO[bytes]) -> None:
        about = (self._warnings, together(self._certificates)) if self._certificates else None
        answer = to_json(self._chain, self._call, orjson.loads(self._form), [], about)
        frame = orjson.dumps(answer, option=orjson.OPT_SERIALIZE_NUMPY)
        shape = (self._count, len(self._chain)) if has_table(self._call) else None
        target.write(orjson.dumps({"frame": frame.decode(), "sizes": self._sizes, "shape": shape}))

    def write_headers(self, target: IO[bytes]) -> None:
        target.write(headers_file({NPY: unsolved_headers(self._unsolved)}))


def _streamed(folder: Path, media_type: str) -> Iterator[bytes] | None:
    """Return the pieces of a result; None if its kind of answer has no such form, or an earlier version made a file."""
    try:
        about = orjson.loads(read_plain(folder / _ABOUT))
        if media_type == NPY and about["shape"] is None:
            return None
        source = open_plain(folder / _PARTS)
    except FileNotFoundError:
        return None
    if media_type == NPY:
        return _npy(about["shape"], _parts(source, about["sizes"], "rows"))
    return _json(about["frame"].encode(), _parts(source, about["sizes"]))


def _parts(source: IO[bytes], sizes: Sequence[int], *wanted: str) -> Iterator[dict[str, NDArray[Any]]]:
    with source:
        for size in sizes:
            yield unpacked(source.read(size), *wanted)


def _json(frame: bytes, parts: Iterator[dict[str, NDArray[Any]]]) -> Iterator[bytes]:
    """Yield the answer; the results, part by part, replace the empty list at the end of its frame."""
    yield frame[:-2]
    separator = b""
    for values in parts:
        if results := _results(values)[1:-1]:
            yield separator + results
            separator = b","
    yield frame[-2:]


def _results(values: dict[str, NDArray[Any]]) -> bytes:
    if "results" in values:
        return values["results"].tobytes()
    return orjson.dumps(PlainResults(*(values[name] for name in PlainResults._fields)).to_json())


def _npy(shape: Sequence[int], parts: Iterator[dict[str, NDArray[Any]]]) -> Iterator[bytes]:
    head = BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": "<f8", "fortran_order": False, "shape": tuple(shape)})
    yield head.getvalue()
    for values in parts:
        yield values["rows"].tobytes()


WORK = LongWork(_request, _work, _streamed)
