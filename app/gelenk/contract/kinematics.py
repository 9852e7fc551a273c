"""Payloads that many operations on a robot share: configurations, matrices, certificates."""

from collections.abc import Sequence
from typing import Annotated, Any, TypeAlias

from pydantic import Discriminator, Field, Tag

from gelenk.contract.common import Answer, OnTheWire
from gelenk.robot.arrays import Array, Configuration as GivenConfiguration


def _kind(value: Any) -> str | None:
    return "<object>" if isinstance(value, dict) else "<list>" if isinstance(value, list) else None


MAX_CONFIGURATIONS = 1_000_000

ByOrder: TypeAlias = Annotated[list[float], Field(max_length=128, fail_fast=True)]
ByName: TypeAlias = Annotated[dict[str, float], Field(max_length=128)]
_Configuration = Annotated[
    Annotated[ByOrder, Tag("<list>")] | Annotated[ByName, Tag("<object>")],
    Discriminator(
        _kind,
        custom_error_type="configuration",
        custom_error_message="a configuration is a list of one number per joint, or an object of values by joint name",
    ),
]
"""Tags in angle brackets never show in a pointer."""

Configuration = Annotated[GivenConfiguration, OnTheWire(_Configuration)]
"""One number per joint, base to tip, or values by joint name."""

Configurations = Annotated[
    Sequence[GivenConfiguration] | Array,
    OnTheWire(Annotated[list[_Configuration], Field(max_length=MAX_CONFIGURATIONS, fail_fast=True)]),
    Field(
        description="Configurations: each one number per joint of the chain, base to tip, or an object of values by "
        "joint name; [rad] for revolute and continuous joints, [m] for prismatic ones.",
        examples=[[[0.0, -0.5, 0.0, -2.0, 0.0, 1.5, 0.8]]],
    ),
]


Matrix = list[list[float]]


class AboutChain(Answer):
    """The head of an answer about a chain."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Where the chain begins.")
    tip_frame: str = Field(description="Where the chain ends.")
