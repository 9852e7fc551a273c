"""Facts found once about a robot, so that the event loop itself can answer requests of a kind afterwards."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from gelenk.contract.common import Payload
from gelenk.store.records import LoadedRobot

_Request = TypeVar("_Request", bound=Payload)


@dataclass(frozen=True, slots=True)
class WarmUp(Generic[_Request]):
    """A fact to find out about a robot.

    Attributes:
        is_known: Checks whether this process knows it.
        find: Finds it, in another process, because that may take long or fail; the result must be picklable.
        keep: Stores it in this process; runs in a thread.
    """

    is_known: Callable[[LoadedRobot, _Request], bool]
    find: Callable[[LoadedRobot, _Request], object]
    keep: Callable[[LoadedRobot, _Request, Any], object]
