"""The functions of an operation, found by the name of its endpoint."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any

from gelenk.contract.endpoint import Endpoint, RobotEndpoint
from gelenk.contract.endpoints import BY_NAME
from gelenk.operations.outcome import Limits, Outcome, WarmUp
from gelenk.store.records import LoadedRobot


@dataclass(frozen=True, slots=True)
class Operation:
    """An endpoint with the functions of its module; see `gelenk.operations`. `needs_robot`: its path names one."""

    endpoint: Endpoint[Any, Any]
    _run: Callable[..., Outcome]
    is_heavy: Callable[[Any], bool]
    at_once: Callable[[LoadedRobot, Any, Limits], Outcome | None] | None
    _attempt: Callable[[LoadedRobot, Any, Limits], Outcome | None] | None
    warm_up: WarmUp[Any] | None
    _takes_robot: bool
    needs_robot: bool

    def run(self, robot: LoadedRobot | None, request: Any, limits: Limits) -> Outcome:
        """Compute the outcome; the robot is the one that path or request name. Raises what the operation raises."""
        outcome = self._run(robot, request, limits) if self._takes_robot else self._run(request)
        return outcome.spoken(getattr(request, "language", "en"))

    def attempt(self, robot: LoadedRobot, request: Any, limits: Limits) -> Outcome | None:
        """Return the same, or None if the operation has a way to find out that this would take long."""
        if self._attempt is None:
            return self.run(robot, request, limits)
        outcome = self._attempt(robot, request, limits)
        return outcome and outcome.spoken(getattr(request, "language", "en"))


@cache
def operation(name: str) -> Operation:
    """Return the operation of an endpoint; raises KeyError for an unknown name."""
    endpoint = BY_NAME[name]
    module = import_module(f"gelenk.operations.{name}")
    is_heavy = getattr(module, "is_heavy", lambda _: False)
    needs_robot = isinstance(endpoint, RobotEndpoint)
    takes_robot = needs_robot or bool(endpoint.robot_field)
    at_once, attempt, warm_up = (getattr(module, name, None) for name in ("at_once", "attempt", "WARM_UP"))
    return Operation(endpoint, module.run, is_heavy, at_once, attempt, warm_up, takes_robot, needs_robot)
