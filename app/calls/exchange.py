"""Requests and answers as JSON."""

import inspect
from collections.abc import Callable, Mapping
from typing import Any, ParamSpec, TypeVar
from urllib.parse import quote

import numpy as np
import orjson
from pydantic import BaseModel

from app.calls.call import Call, Reply, documented
from app.schemas.common import Answer

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)


def posted(path: str, fields: Mapping[str, Any], answer: type[A], **details: Any) -> Call[A]:
    """A call with JSON in both directions."""
    return Call("POST", path, reader(answer), body=encoded(fields), **details)


def encoded(fields: Mapping[str, Any]) -> bytes:
    """The fields of a request as JSON; arrays and models go as what they hold."""
    return orjson.dumps(dict(fields), option=orjson.OPT_SERIALIZE_NUMPY, default=_plain)


def _plain(value: Any) -> Any:
    if isinstance(value, BaseModel):
        return value.model_dump(exclude_unset=True)
    if isinstance(value, np.ndarray):  # one that orjson does not take: not contiguous, or of another type
        return value.tolist()
    raise TypeError(f"a {type(value).__name__} cannot be sent as JSON")


def reader(answer: type[A]) -> Callable[[Reply], A]:
    """How an answer is read; what a newer service tells beside it is left out."""
    return lambda reply: answer.model_validate_json(reply.body, extra="ignore")


def segment(name: str) -> str:
    """A name as a part of a path."""
    return quote(name, safe="")


def described_by(
    describe: Callable[P, Call[A]], request: Callable[..., BaseModel], answer: type[A], *before: inspect.Parameter
) -> Callable[P, Call[A]]:
    """A description that says what its models do."""
    sentences = f"{inspect.getdoc(request)}\n\nReturns:\n    {answer.__name__}: {inspect.getdoc(answer)}"
    return documented(describe, request, sentences, *before)
