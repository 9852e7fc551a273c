"""Where the package's files are."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def catalogue() -> Path:
    """The robots of the catalogue: in the package where it is installed, at the top of a checkout otherwise."""
    installed = _PACKAGE / "robots"
    return installed if installed.is_dir() else _PACKAGE.parents[1] / "robots"


def studio() -> Path:
    """The bundle of the studio."""
    return _PACKAGE / "studio"
