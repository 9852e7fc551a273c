"""A call of the service as data, and how its description becomes a method of both clients."""

import functools
import inspect
from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import dataclass, field
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Generic,
    Literal,
    ParamSpec,
    Protocol,
    Self,
    TypeVar,
    Union,
    get_args,
    get_origin,
    is_typeddict,
    overload,
)

from httpx2 import Response

from gelenk.client.refusals import UnknownKeyword

P = ParamSpec("P")
T = TypeVar("T")
R = TypeVar("R")

JSON = "application/json"
NPY = "application/x-npy"


@dataclass(frozen=True, slots=True)
class Call(Generic[T]):
    """A request to send, and how to read its answer.

    Attributes:
        path: Path below the address of the service, without a leading slash.
        query: Query parameters; a list repeats its name.
        media_type, accept: Media types of the body, and wanted for the answer.
        form: Fields of a form, instead of a body.
        files: Files of the form: for each its field, name and content.
        is_later: Whether a job is to answer it.
        is_repeatable: Whether it may be sent again if it is unknown whether it was executed: it stores nothing, or the
            same as before.
    """

    method: str
    path: str
    read: Callable[[Response], T]
    query: Mapping[str, Any] = field(default_factory=dict)
    body: bytes = b""
    media_type: str = JSON
    form: Mapping[str, str] = field(default_factory=dict)
    files: Sequence[tuple[str, tuple[str, bytes]]] = ()
    accept: str = JSON
    is_later: bool = False
    is_repeatable: bool = True

    @property
    def headers(self) -> dict[str, str]:
        """Headers of the request."""
        content = {"Content-Type": self.media_type} if self.body else {}
        return {"Accept": self.accept, **content, **({"Prefer": "respond-async"} if self.is_later else {})}


class Blocking(Protocol):
    """A client that sends a call and waits for its answer."""

    def send(self, call: Call[T]) -> T:
        """Send a call and return its answer."""
        ...


class Awaited(Protocol):
    """A client that sends a call; its answer is awaited."""

    def send(self, call: Call[T]) -> Coroutine[object, None, T]:
        """Send a call; the answer is awaited."""
        ...


class Sent(Generic[P, T]):
    """A method of both clients that sends the call a function describes."""

    def __init__(self, describe: Callable[P, Call[T]]) -> None:
        self.describe = describe
        self.__doc__ = describe.__doc__

    def __set_name__(self, _: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, client: None, owner: type) -> Self: ...
    @overload
    def __get__(self, client: Blocking, owner: type) -> Callable[P, T]: ...
    @overload
    def __get__(self, client: Awaited, owner: type) -> Callable[P, Coroutine[object, None, T]]: ...

    def __get__(self, client: Any, owner: type) -> Any:
        """Return the descriptor itself for the class, or the method of a client."""
        if client is None:
            return self

        return method_of(self.name, self.describe, client.send)


def method_of(name: str, describe: Callable[P, Call[T]], send: Callable[[Call[T]], R]) -> Callable[P, R]:
    """Return a method that passes the described call to `send`; raises TypeError as a function does."""
    signature = inspect.signature(describe)
    takes_all = any(one.kind == inspect.Parameter.VAR_KEYWORD for one in signature.parameters.values())
    places = [one.name for one in signature.parameters.values() if one.kind != inspect.Parameter.KEYWORD_ONLY]

    def method(*args: P.args, **kwargs: P.kwargs) -> R:
        if len(args) > len(places):
            allowed = f"{', '.join(places)} alone by place" if places else "nothing by place"
            raise TypeError(f"{name} takes {allowed}; give all else by name, as in {signature}".partition(" ->")[0])
        if not takes_all:
            for unknown in kwargs.keys() - signature.parameters.keys():
                raise UnknownKeyword(name, unknown, tuple(signature.parameters))
        return send(describe(*args, **kwargs))

    functools.update_wrapper(method, describe)
    method.__name__ = method.__qualname__ = name
    method.__signature__ = signature  # type: ignore[attr-defined]
    return method


ROBOT = inspect.Parameter("robot", inspect.Parameter.POSITIONAL_ONLY, annotation=str)
EXERCISE = inspect.Parameter("exercise", inspect.Parameter.POSITIONAL_OR_KEYWORD, annotation=str)


def documented(
    describe: Callable[P, Call[T]], model: Callable[..., object], sentences: str, *before: inspect.Parameter
) -> Callable[P, Call[T]]:
    """Give a description the signature of the model whose fields it takes by name, and a docstring about them."""
    parameters = [
        one.replace(annotation=_words(one.annotation)) for one in inspect.signature(model).parameters.values()
    ]
    parameters.sort(key=lambda one: one.default is not inspect.Parameter.empty)
    describe.__signature__ = inspect.Signature([*before, *parameters])  # type: ignore[attr-defined]
    fields = getattr(model, "model_fields", {})
    lines = [f"    {one.name}: {about}" for one in parameters if (about := fields[one.name].description)]
    describe.__doc__ = "\n".join([sentences, "", "Args:", *lines]) if lines else sentences
    return describe


class _Words(str):
    """An annotation in readable form."""

    __slots__ = ()
    __repr__ = str.__str__


def _words(annotation: Any) -> _Words:
    """Return a type without the metadata that only pydantic needs."""
    origin, parts = get_origin(annotation), get_args(annotation)
    if is_typeddict(annotation):
        return _Words("dict")
    if origin is Annotated:
        return _words(parts[0])
    if origin is Literal:
        return _Words(" | ".join(repr(part) for part in parts))
    if origin in {Union, UnionType}:
        return _Words(" | ".join(dict.fromkeys(_words(part) for part in parts)))
    if annotation is NoneType:
        return _Words("None")
    name = getattr(origin or annotation, "__name__", str(annotation))
    if origin is None or name == "ndarray":
        return _Words(name)
    return _Words(f"{name}[{', '.join(_words(part) for part in parts)}]")
