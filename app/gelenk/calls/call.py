"""A call of the service as data, and a description of calls as a method of both clients."""

import functools
import inspect
from collections.abc import Callable, Coroutine, Mapping
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
    overload,
)

P = ParamSpec("P")
T = TypeVar("T")
R = TypeVar("R")

JSON = "application/json"
NPY = "application/x-npy"


@dataclass(frozen=True, slots=True)
class Reply:
    """What the service has answered with.

    Attributes:
        body: As it came.
        headers: By lower-case name.
    """

    body: bytes
    headers: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Call(Generic[T]):
    """What is sent, and how the answer is read.

    Attributes:
        method: Of HTTP.
        path: Below the address of the service, without a leading slash.
        read: Makes the answer of what has come back.
        query: Parameters; a list repeats its name.
        body: As it is sent.
        media_type: Of the body.
        form: Fields of a form, in the place of a body.
        files: The form's files.
        accept: Media type that the answer is wanted in.
        is_later: Whether it is to be answered by a job.
        is_repeatable: Whether it may be sent again when it is not known whether it was done: it stores nothing, or
            the same thing as before.
    """

    method: str
    path: str
    read: Callable[[Reply], T]
    query: Mapping[str, Any] = field(default_factory=dict)
    body: bytes = b""
    media_type: str = JSON
    form: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)
    accept: str = JSON
    is_later: bool = False
    is_repeatable: bool = True

    @property
    def headers(self) -> dict[str, str]:
        """Headers of the request."""
        content = {"Content-Type": self.media_type} if self.body else {}
        return {"Accept": self.accept, **content, **({"Prefer": "respond-async"} if self.is_later else {})}


class Blocking(Protocol):
    """Sends a call and waits for its answer."""

    def send(self, call: Call[T]) -> T:
        """The answer."""
        ...


class Awaited(Protocol):
    """Sends a call; its answer is awaited."""

    def send(self, call: Call[T]) -> Coroutine[object, None, T]:
        """The answer, once awaited."""
        ...


class Sent(Generic[P, T]):
    """A method of both clients: it sends the call that a function describes."""

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
        """The description itself of the class; of a client the method."""
        if client is None:
            return self

        return method_of(self.name, self.describe, client.send)


def method_of(name: str, describe: Callable[P, Call[T]], send: Callable[[Call[T]], R]) -> Callable[P, R]:
    """A method that does something with the call that a function describes; raises TypeError as a function does."""
    signature = inspect.signature(describe)
    places = [one.name for one in signature.parameters.values() if one.kind != inspect.Parameter.KEYWORD_ONLY]

    def method(*args: P.args, **kwargs: P.kwargs) -> R:
        if len(args) > len(places):
            told = f"{', '.join(places)} alone by place" if places else "nothing by place"
            raise TypeError(f"{name} takes {told}; give all else by name, as in {signature}".partition(" ->")[0])
        return send(describe(*args, **kwargs))

    functools.update_wrapper(method, describe)
    method.__name__ = method.__qualname__ = name
    method.__signature__ = signature  # type: ignore[attr-defined]
    return method


ROBOT = inspect.Parameter("robot", inspect.Parameter.POSITIONAL_ONLY, annotation=str)


def documented(
    describe: Callable[P, Call[T]], fields: Callable[..., object], sentences: str, *before: inspect.Parameter
) -> Callable[P, Call[T]]:
    """A description that says what it takes, to people at a prompt too.

    Args:
        describe: Takes the fields of a model by name.
        fields: The model.
        sentences: Its docstring.
        before: Parameters in front of the fields.
    """
    parameters = [
        one.replace(annotation=_words(one.annotation)) for one in inspect.signature(fields).parameters.values()
    ]
    parameters.sort(key=lambda one: one.default is not inspect.Parameter.empty)
    describe.__signature__ = inspect.Signature([*before, *parameters])  # type: ignore[attr-defined]
    told = {name: field.description for name, field in getattr(fields, "model_fields", {}).items()}
    lines = [f"    {one.name}: {told[one.name]}" for one in parameters if told.get(one.name)]
    describe.__doc__ = "\n".join([sentences, "", "Args:", *lines]) if lines else sentences
    return describe


class _Words(str):
    """An annotation as people read it."""

    __slots__ = ()
    __repr__ = str.__str__


def _words(annotation: Any) -> _Words:
    """A type without what only pydantic needs to know of it."""
    origin, parts = get_origin(annotation), get_args(annotation)
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
