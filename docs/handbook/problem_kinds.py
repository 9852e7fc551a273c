"""All kinds of problems as Markdown: of the core from its tree of errors, and those that HTTP adds."""

import types
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from http import HTTPStatus
from typing import Any, Union, get_args, get_origin, get_type_hints

from docs.handbook.schema_words import anchor, place
from gelenk.errors import KinematicsError, kinds
from gelenk.http.messages.problems import status_of

_WORDS: Mapping[Any, str] = {
    str: "text",
    bool: "`true` or `false`",
    int: "whole number",
    float: "number",
    tuple[str, ...]: "list of texts",
}
"""What a fact is, by its type."""


@dataclass(frozen=True)
class Kind:
    """A kind of problem.

    Attributes:
        name: The last part of its `type`.
        status: Of HTTP.
        meaning: In a sentence or two.
        facts: What its problems carry beside the members that all have: what each is, by its name.
        exception: What the client raises, if there is a class of its own.
    """

    name: str
    status: HTTPStatus
    meaning: str
    facts: Mapping[str, str] = field(default_factory=dict)
    exception: str | None = None


OF_HTTP = (
    Kind(
        "malformed-request",
        HTTPStatus.BAD_REQUEST,
        "What came is not HTTP. The connection is closed.",
    ),
    Kind("invalid-host", HTTPStatus.BAD_REQUEST, "The request does not name the one host that it is for."),
    Kind(
        "repeated-header", HTTPStatus.BAD_REQUEST, "A header that may appear once only, such as a key, appears twice."
    ),
    Kind("malformed-json", HTTPStatus.BAD_REQUEST, "The body is not JSON: where its reader had to stop."),
    Kind(
        "key-needed",
        HTTPStatus.UNAUTHORIZED,
        "Keys are on, and the request has none, or one that is not or no longer among them.",
    ),
    Kind(
        "missing-scope",
        HTTPStatus.FORBIDDEN,
        "The key is good, but not for this.",
        {"missing_scope": "text", "scopes": "list of texts"},
    ),
    Kind(
        "cross-origin-refused",
        HTTPStatus.FORBIDDEN,
        "A page of another origin may not do this; `GELENK_ALLOWED_ORIGINS` adds origins.",
    ),
    Kind("not-found", HTTPStatus.NOT_FOUND, "There is nothing at this path."),
    Kind(
        "method-not-allowed",
        HTTPStatus.METHOD_NOT_ALLOWED,
        "There is something at this path, but not for this method; `Allow` in the header lists those that there are.",
    ),
    Kind(
        "request-too-slow",
        HTTPStatus.REQUEST_TIMEOUT,
        "The head or the body of the request did not come in time. The connection is closed.",
    ),
    Kind(
        "unsupported-media-type",
        HTTPStatus.UNSUPPORTED_MEDIA_TYPE,
        "The operation does not take a body of this `Content-Type`.",
        {"allowed": "list of texts"},
    ),
    Kind(
        "unknown-host",
        HTTPStatus.MISDIRECTED_REQUEST,
        "The service does not answer for this host; `GELENK_TRUSTED_HOSTS` adds names.",
    ),
    Kind(
        "invalid-payload",
        HTTPStatus.UNPROCESSABLE_ENTITY,
        "Fields of the body or of the query are missing, unknown, of another type, or beyond a limit of the schema.",
        {"errors": "list of objects with `pointer` and `detail`, at most 20"},
    ),
    Kind(
        "head-too-large",
        HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE,
        "The request line and the header fields have too many bytes. The connection is closed.",
    ),
    Kind(
        "internal-error",
        HTTPStatus.INTERNAL_SERVER_ERROR,
        "Something went wrong in the service; its log tells more, under the `request_id`.",
    ),
    Kind(
        "not-ready",
        HTTPStatus.SERVICE_UNAVAILABLE,
        "Of `/readyz`: the service is not ready for work.",
        {"waiting_for": "list of texts", "reasons": "object of texts by name", "failure": "text or `null`"},
    ),
)
"""What is found before or outside the core."""


def all_kinds() -> list[Kind]:
    """Every kind that an answer may have, by status and name."""
    return sorted([*OF_HTTP, *_of_the_core()], key=lambda kind: (kind.status, kind.name))


def problems() -> str:
    """The kinds, each below the heading of its status."""
    return "\n\n".join(_paragraphs(all_kinds()))


def _paragraphs(found: list[Kind]) -> Iterator[str]:
    status: HTTPStatus | None = None
    for kind in found:
        if kind.status != status:
            status = kind.status
            yield f"{place(f'status-{status.value}')}\n\n## {status.value} {status.phrase}"
        yield f"{place(anchor('problem', kind.name))}\n\n### {kind.name}"
        raised = "" if kind.exception is None else f" In Python `{kind.exception}`."
        yield f"{kind.meaning}{raised}"
        if kind.facts:
            yield "Facts: " + "; ".join(f"`{name}`, {what}" for name, what in kind.facts.items()) + "."


def _of_the_core() -> Iterator[Kind]:
    for name, error in kinds().items():
        if error.template:  # others are never raised, only what derives from them
            meaning = " ".join((error.__doc__ or "").split())
            yield Kind(name, status_of(error), meaning, _facts(error), error.__name__)


def _facts(error: type[KinematicsError]) -> dict[str, str]:
    """What the problems of a class carry."""
    hints = get_type_hints(error)
    return {entry.name: _told(hints[entry.name]) for entry in fields(error)}


def _told(hint: Any) -> str:
    """A type in words."""
    if get_origin(hint) in {types.UnionType, Union}:
        (inner,) = (choice for choice in get_args(hint) if choice is not type(None))
        return f"{_WORDS[inner]} or `null`"
    return _WORDS[hint]
