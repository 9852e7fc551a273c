"""A large batch as several calls in turn, so that a bar shows progress and no answer is too large."""

import re
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, TypeVar

from gelenk.client.refusals import Refused, refusal

if TYPE_CHECKING:
    from gelenk.contract.common import Answer

A = TypeVar("A", bound="Answer")

FIRST = 1_000
"""Rows of the first call: a batch of this size is answered exactly as by the API, certificate included."""
_MOST = 10_000
_SECONDS = 0.3
"""Intended duration of a call, [s]."""
_GROWTH = 8
_EACH = frozenset(
    {"poses", "frames", "results", "jacobians", "ranks", "singular_values", "condition_numbers"}
    | {"time_variations", "hessians"}
)
"""Fields of an answer with one entry per row; all others except the certificate are the same in each call."""
_INDEX = re.compile(r"\b(configuration|entry) (\d+)\b|(?<=#/)(joint_positions|targets|seeds)/(\d+)")


def in_calls(
    ask: Callable[..., A], body: Mapping[str, Any], rows: str, progress: Callable[[float], None], first: int = FIRST
) -> A:
    """Send a batch in several calls, and return one answer.

    Numbers are those of one call with all rows, because no row depends on another. The certificate counts the samples
    of all calls, and has the largest of their errors. A refusal gives the place of the row in the whole batch.

    Args:
        rows: Name of the field with the rows.
        progress: Called with the finished share of the batch, 0 to 1.
        first: Rows of the first call; the others have as many as are answered in a third of a second.
    """
    given = body.get(rows)
    if not isinstance(given, list) or len(given) <= first or "time_limit" in body:  # that limit is for all rows
        return ask(**body)
    each = {name: value for name, value in body.items() if isinstance(value, list) and len(value) == len(given)}
    answers: list[A] = []
    done, size = 0, first
    while done < len(given):
        start = time.monotonic()
        try:
            answers.append(ask(**{**body, **{name: value[done : done + size] for name, value in each.items()}}))
        except Refused as refused:
            raise _of_the_whole(refused, done) from None
        done += size
        progress(min(1.0, done / len(given)))
        fitting = size * _SECONDS / max(time.monotonic() - start, 1e-3)
        size = int(min(max(fitting, 1.0), _GROWTH * size, _MOST))
    return _joined(answers)


def _joined(answers: Sequence[A]) -> A:
    first = answers[0]
    joined: dict[str, Any] = {}
    for name in first.model_fields_set:
        values = [getattr(answer, name) for answer in answers]
        if name == "certificate":
            joined[name] = _certificate(values)
        elif name in _EACH and values[0] is not None:
            joined[name] = [entry for value in values for entry in value]
    return first.model_copy(update=joined)


def _certificate(certificates: Sequence[Any]) -> Any:
    """Join certificates, dataclasses of the core: the sum of their samples, the largest of each error."""
    columns = {field.name: [getattr(one, field.name) for one in certificates] for field in fields(certificates[0])}
    largest = {name: max(values) for name, values in columns.items() if None not in values}
    return replace(certificates[0], **{**largest, "samples": sum(columns["samples"])})


def _of_the_whole(refused: Refused, first: int) -> Refused:
    """Return the refusal with places of rows in the whole batch, whose first rows were answered before."""

    def moved(found: re.Match[str]) -> str:
        return f"{found[1]} {int(found[2]) + first}" if found[1] else f"{found[3]}/{int(found[4]) + first}"

    problem: dict[str, Any] = dict(refused.problem)
    for name in ("detail", "pointer"):
        if isinstance(problem.get(name), str):
            problem[name] = _INDEX.sub(moved, problem[name])
    if isinstance(problem.get("index"), int):
        problem["index"] += first
    return refusal(problem)
