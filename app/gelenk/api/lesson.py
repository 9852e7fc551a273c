"""What is found out once for all, so that the event loop can answer requests of a kind by itself from then on."""

import asyncio
import pickle
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from starlette.responses import Response

from gelenk.api.errand import Desk, Inquiry
from gelenk.contract.common import Payload
from gelenk.store.records import LoadedRobot

_Request = TypeVar("_Request", bound=Payload)


@dataclass(frozen=True, slots=True)
class Lesson(Generic[_Request]):
    """Something to learn about a robot.

    Attributes:
        is_known: Whether this process knows it.
        find: Finds it, in the crew, as it may take long or fail; what it gives must travel between processes.
        learn: Takes that over, in a thread.
    """

    is_known: Callable[[LoadedRobot, _Request], bool]
    find: Callable[[LoadedRobot, _Request], object]
    learn: Callable[[LoadedRobot, _Request, Any], object]

    def taught(self, loaded: LoadedRobot, call: _Request) -> Response:
        """What was found, from a process of the crew."""
        return Response(pickle.dumps(self.find(loaded, call)))

    async def learnt(self, loaded: LoadedRobot, call: _Request, content: bytes) -> None:
        """Take over what the crew has found."""
        found = pickle.loads(content)  # noqa: S301 - from a process of ours
        await asyncio.to_thread(self.learn, loaded, call, found)


@dataclass(frozen=True, slots=True)
class LessonErrand:
    """To find out what makes later requests quick, by the operation's name."""

    name: str

    def __call__(self, desk: Desk, inquiry: Inquiry) -> Response:
        """What there is to learn."""
        return desk.computations[self.name].taught(desk.library, inquiry)
