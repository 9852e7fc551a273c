"""A call of the service as data, and a description of calls as a method of both clients."""

import functools
import inspect
from collections.abc import Callable, Coroutine, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, ParamSpec, Protocol, Self, TypeVar, overload

P = ParamSpec("P")
T = TypeVar("T")

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
        is_repeatable: Whether it may be sent again when nobody knows whether it was done: it leaves nothing behind, or
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
        """Those of the request."""
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

        def method(*args: P.args, **kwargs: P.kwargs) -> Any:
            return client.send(self.describe(*args, **kwargs))

        functools.update_wrapper(method, self.describe)
        method.__signature__ = inspect.signature(self.describe)  # type: ignore[attr-defined]
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
    parameters = [*before, *inspect.signature(fields).parameters.values()]
    describe.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    describe.__doc__ = sentences
    return describe
