"""Quick calls of operations on a robot of the catalogue, without the application: it takes seconds to load.

What is loaded is the operation, and for its kernels no compiler. Everything else is left to the application.
"""

import json
import sys
from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gelenk.cli.files.inputs import is_file
from gelenk.package_data import catalogue

if TYPE_CHECKING:
    from gelenk.contract.common import Answer

_MOST = 16
"""Configurations of a quick call."""
_FIELDS = frozenset({"joint_positions", "base_frame", "tip_frame", "pose_format", "reference", "representation"})
"""Fields of a quick call: others may ask for long work, or for what the kernels in Python cannot do."""


def quick_answer(operation: str, robot: str, fields: Mapping[str, Any]) -> "Answer | None":
    """Return the answer of fk, jacobian or manipulability; None if the call is not quick, or invalid.

    A call that the robot cannot answer raises the error of the core.
    """
    rows = fields["joint_positions"]
    is_few = isinstance(rows, Sequence) and len(rows) <= _MOST
    if not (is_few and fields.keys() <= _FIELDS and robot in _names()) or is_file(Path(robot)):
        return None
    from pydantic import ValidationError  # noqa: PLC0415 - as the operation needs it

    endpoint = import_module(f"gelenk.contract.{operation}").ENDPOINT
    try:
        request = endpoint.request.model_validate_json(json.dumps(fields))
    except ValidationError:
        return None  # the application says what is wrong
    content = _computed(operation, robot, request)
    answer: Answer = endpoint.answer.model_validate_json(content)
    return answer


def _names() -> set[str]:
    return {folder.name for folder in catalogue().iterdir()}


def _computed(operation: str, robot: str, request: Any) -> bytes:
    """Return the content of an answer as JSON."""
    from gelenk.kinematics.simd.plain import run_kernels_as_python  # noqa: PLC0415 - before all that has kernels

    run_kernels_as_python()
    import orjson  # noqa: PLC0415

    from gelenk.operations.outcome import Limits  # noqa: PLC0415
    from gelenk.store.records import load, read_record  # noqa: PLC0415

    record = read_record(catalogue() / robot, "catalogue")
    assert record is not None  # it is a folder of the catalogue  # noqa: S101
    run = import_module(f"gelenk.operations.{operation}").run
    outcome = run(load(record), request, Limits(sys.maxsize, float("inf")))
    return orjson.dumps(outcome.content(), option=orjson.OPT_SERIALIZE_NUMPY)
