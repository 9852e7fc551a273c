"""Locations of the package's files."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def catalogue() -> Path:
    """Return the folder of the catalogue's robots: in the installed package, or at the top of a checkout."""
    installed = _PACKAGE / "robots"
    return installed if installed.is_dir() else _PACKAGE.parents[1] / "robots"


def studio() -> Path:
    """Return the folder of the studio's bundle."""
    return _PACKAGE / "studio"


def handbook() -> Path:
    """Return the folder of the built handbook, which need not be there: in the installed package, or in a checkout."""
    installed = _PACKAGE / "handbook"
    return installed if installed.is_dir() else _PACKAGE.parents[1] / "build" / "handbook"


def texts() -> Path:
    """Return the folder of the translations."""
    return _PACKAGE / "texts"
