"""Inverse kinematics as a job: several targets per part, each solved as if it were the only one."""

from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path
from typing import IO, TypeAlias

import numpy as np
import orjson

from gelenk.contract.ik import MAX_JOB_STEPWISE, MAX_JOB_TARGETS, MAX_TRACE, InverseRequest
from gelenk.errors import InvalidField
from gelenk.http.jobs.long_work import HEADERS, RESULTS, LongWork, as_bytes, headers_file, npy_file
from gelenk.http.messages.payloads import JSON, NPY, read_json
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.solve import solve
from gelenk.jobs.parts import packed, unpacked
from gelenk.jobs.robot_files import RobotText, robot_of, robot_text
from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Work
from gelenk.operations.ik_answer import results_to_json, table, to_json, unsolved_headers
from gelenk.operations.ik_request import NUMBERS_OF_STEPS, TargetLimits, has_table, is_stepwise, options_of, parse
from gelenk.operations.outcome import Limits
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.store.folders import read_plain
from gelenk.store.records import LoadedRobot

_CALL, _TARGETS, _SEEDS = "call.json", "targets.npy", "seeds.npy"
_BOUNDS = TargetLimits(MAX_JOB_TARGETS, MAX_JOB_STEPWISE, None)
_PART, _PART_OF_MANY = 4096, 128
"""Targets per part: of quick calls (one solution each, no objective, not stepwise), and of all others."""

_TRIED, _BYTES_A_NUMBER = 64, 100
"""Targets solved to estimate the size of all results; done only if this many bytes per number are too many."""
_STAGE = "targets"
_SOLVED = 0.95
"""Progress when only the files are left to write."""

_Part: TypeAlias = tuple[RobotText, bytes, Array, Array]
"""The robot, the call, the targets (rows of 12: position, rotation matrix), the seeds."""


def _request(loaded: LoadedRobot, call: InverseRequest, limits: Limits) -> dict[str, bytes]:
    """Check a call and return its files; targets and seeds are arrays from here on."""
    if call.time_limit is not None:
        raise InvalidField(
            "time_limit", "a job looks for each target to the end: leave it out, or ask for the answer now"
        )
    problem = parse(loaded.robot, call, _BOUNDS)
    _check_room(limits.job_bytes, problem, call)
    ends = {"base_frame": problem.chain.base_frame, "tip_frame": problem.chain.tip_frame}
    rest = call.model_copy(update={"targets": [], "seeds": None, **ends})
    rows = np.column_stack((problem.targets.positions, problem.targets.rotations.reshape(-1, 9)))
    return {_CALL: rest.model_dump_json().encode(), _TARGETS: npy_file(rows), _SEEDS: npy_file(problem.seeds)}


def _check_room(most_bytes: int, problem: TargetProblem, call: InverseRequest) -> None:
    """Refuse a call whose results would exceed `most_bytes`, as some targets show; say how many there is room for."""
    count = len(problem)
    rows = call.max_solutions if call.solutions == "all" else MAX_TRACE if call.trace else 1
    numbers = rows * (len(problem.chain) + 4) + NUMBERS_OF_STEPS * call.steps
    if count * numbers * _BYTES_A_NUMBER <= most_bytes:
        return
    whole = _bytes_each(problem, call, count) * count
    if whole <= most_bytes:
        return
    room = int(0.9 * count * most_bytes / whole)
    # Check each smaller number too: the first targets may have more solutions than the others.
    while room > 1 and _bytes_each(problem, call, room) * room > most_bytes:
        room = int(0.9 * room)
    raise InvalidField(
        "targets",
        f"what comes of all {count:,} takes some {whole:.2g} bytes, and the parts of a job may take "
        f"{most_bytes:,}: ask for at most {max(1, room):,} at a time, or for less of each",
    )


def _bytes_each(problem: TargetProblem, call: InverseRequest, count: int) -> float:
    """Return the mean size, in bytes, of the result of one of the first `count` targets, from some of them."""
    some = np.unique(np.linspace(0, count - 1, _TRIED).astype(np.int64))
    return len(_solved(problem.taken(some), call)) / len(some)


def _work(_: Limits, folder: Path) -> Work:
    text, content = robot_text(folder), read_plain(folder / _CALL)
    call = read_json(InverseRequest, content)
    # Read from disk as they are needed: a million targets are a hundred megabytes.
    targets, seeds = (np.load(folder / name, mmap_mode="r") for name in (_TARGETS, _SEEDS))
    quick = call.solutions == "one" and call.objective is None and not is_stepwise(call)
    size = _PART if quick else _PART_OF_MANY
    count = max(1, -(-len(targets) // size))

    def part(k: int) -> _Part:
        rows = slice(k * size, (k + 1) * size)
        return text, content, np.array(targets[rows]), np.array(seeds if len(seeds) == 1 else seeds[rows])

    def work(run: Run) -> Files:
        run.map(_STAGE, solved_part, part, count, (0.0, _SOLVED), size)
        chain = robot_of(text).chain(call.base_frame, call.tip_frame)
        found = _Found(call, chain, lambda: run.parts.of(_STAGE, count))
        files: Files = {RESULTS[JSON]: found.write_json}
        if not has_table(call):
            return files
        return {**files, RESULTS[NPY]: found.write_npy, HEADERS: found.write_headers}

    return work


def solved_part(job: _Part) -> bytes:
    """Solve some targets, in a separate process: results as JSON, rows of a table, and indices of unsolved targets."""
    text, content, rows, seeds = job
    robot, call = robot_of(text), _call(content)
    chain = robot.chain(call.base_frame, call.tip_frame)
    targets = Poses(np.ascontiguousarray(rows[:, :3]), np.ascontiguousarray(rows[:, 3:]).reshape(-1, 3, 3))
    return _solved(TargetProblem(robot, chain, targets, seeds, options_of(chain, call, None)), call)


def _solved(problem: TargetProblem, call: InverseRequest) -> bytes:
    chain, result = problem.chain, solve(problem)
    results = orjson.dumps(results_to_json(problem, call, result), option=orjson.OPT_SERIALIZE_NUMPY)
    return packed(
        count=len(problem),
        form=as_bytes(orjson.dumps(result.closed_form)),
        results=as_bytes(results),
        unsolved=np.array(list(result.failures), dtype=np.int64),
        rows=table(chain, result) if has_table(call) else None,
    )


@lru_cache(maxsize=2)
def _call(content: bytes) -> InverseRequest:
    return read_json(InverseRequest, content)


class _Found:
    """The results of all parts: reading the parts takes longer than all else, so the first file gathers the others."""

    def __init__(self, call: InverseRequest, chain: Chain, parts: Callable[[], Iterator[bytes]]) -> None:
        self._call, self._chain, self._parts = call, chain, parts
        self._rows: list[Array] = []
        self._unsolved: list[int] = []

    def write_json(self, target: IO[bytes]) -> None:
        """Write the answer; the results, part by part, replace the empty list at its end."""
        end, separator, count = b"", b"", 0
        for part in self._parts():
            values = unpacked(part)
            if not end:
                answer = to_json(self._chain, self._call, orjson.loads(values["form"].tobytes()), [])
                frame = orjson.dumps(answer, option=orjson.OPT_SERIALIZE_NUMPY)
                target.write(frame[:-2])
                end = frame[-2:]
            if results := values["results"].data[1:-1]:
                target.write(separator)
                target.write(results)
                separator = b","
            self._unsolved += (count + values["unsolved"]).tolist()
            count += int(values["count"])
            if "rows" in values:
                self._rows.append(values["rows"])
        target.write(end)

    def write_npy(self, target: IO[bytes]) -> None:
        shape = sum(map(len, self._rows)), len(self._chain)
        np.lib.format.write_array_header_1_0(target, {"descr": "<f8", "fortran_order": False, "shape": shape})
        for rows in self._rows:
            target.write(np.ascontiguousarray(rows).data)

    def write_headers(self, target: IO[bytes]) -> None:
        target.write(headers_file({NPY: unsolved_headers(self._unsolved)}))


WORK = LongWork(_request, _work)
