"""Steps that many operations on a robot share: the chain, the configurations, the size of the answer."""

from typing import Any, Protocol

from gelenk.errors import TooLarge
from gelenk.operations.outcome import Limits
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import check_limits, configurations
from gelenk.robot.robot import RobotModel


class AtConfigurations(Protocol):
    """A request about a chain at configurations."""

    @property
    def base_frame(self) -> str | None:
        """Base of the chain; that of the default chain if None."""
        ...

    @property
    def tip_frame(self) -> str | None:
        """Tip of the chain; that of the default chain if None."""
        ...

    @property
    def joint_positions(self) -> Any:
        """Configurations, in any form that `configurations` accepts."""
        ...

    @property
    def respect_limits(self) -> bool:
        """Whether a configuration beyond the joint limits is an error."""
        ...


def chain_and_positions(robot: RobotModel, call: AtConfigurations) -> tuple[Chain, Array]:
    """Return the chain of a request and its configurations, shape (N, n), [rad or m].

    Raises:
        UnknownFrame: The robot has no such frame.
        InvalidField: A configuration does not have one number per joint.
        OutsideLimits: A configuration is beyond the limits, and the request respects them.
    """
    chain = robot.chain(call.base_frame, call.tip_frame)
    return chain, positions(chain, call)


def positions(chain: Chain, call: AtConfigurations) -> Array:
    """Return the configurations of a request, shape (N, n), [rad or m]; raises as `chain_and_positions` does."""
    qs = configurations(chain, call.joint_positions)
    if call.respect_limits:
        check_limits(chain, qs)
    return qs


def check_numbers(numbers: int, limits: Limits) -> None:
    """Refuse an answer with more numbers than the operator allows; raises TooLarge."""
    if numbers > limits.answer_numbers:
        raise TooLarge("numbers in the answer", numbers, limits.answer_numbers)


def head(chain: Chain) -> dict[str, Any]:
    """Return the first fields of every answer about a chain."""
    return {"joint_names": chain.joint_names, "base_frame": chain.base_frame, "tip_frame": chain.tip_frame}
