"""The OpenAPI document of the service as it is set by default, made once for all tests."""

from functools import cache
from pathlib import Path
from typing import Any

from gelenk.main import create_app
from gelenk.settings import Settings


@cache
def document() -> dict[str, Any]:
    """The document; not to be changed."""
    return create_app(Settings(data_dir=Path("unused"))).openapi()
