"""The OpenAPI document of the service as it is set by default, made once for all tests."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from gelenk.main import create_app
from gelenk.settings import Settings


def example_of(content: Mapping[str, Any]) -> Any:
    """The first example of a body, which suits those of the parameters; None if it has none."""
    given = [one["value"] for one in content.get("examples", {}).values()]
    return content.get("example", given[0] if given else None)


NO_ANSWER = {"get_scene_file"}
"""Operations whose example has no answer: the scene of the examples has no file."""


@cache
def document() -> dict[str, Any]:
    """The document; not to be changed."""
    return create_app(Settings(data_dir=Path("unused"))).openapi()
