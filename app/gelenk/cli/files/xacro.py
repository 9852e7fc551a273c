"""Expands xacro on the user's machine: xacro can read any file, so no server expands it."""

import re
import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

from gelenk.errors import InvalidUrdf
from gelenk.robot.xml import read_xml, without_links

_FINDER = "ament_index_python.packages"


def expanded(file: Path, arguments: Mapping[str, str], packages: Mapping[str, Path]) -> str:
    """Return the URDF that a xacro file expands to, with values of its `xacro:arg`s; raises InvalidUrdf.

    `packages` are folders for `$(find NAME)`; other packages are searched for above the file, and in ROS if it is
    installed.
    """
    # Loading it takes a tenth of a second, which few calls need.
    import xacro  # noqa: PLC0415

    _stand_in(file.resolve(), packages)
    try:
        document = xacro.process_file(str(file), mappings=dict(arguments))
    except Exception as error:  # xacro evaluates expressions: they raise what they like
        raise InvalidUrdf(f"xacro cannot expand it: {_sentence(error)}", element=file.name) from error
    if not any(child.nodeName == "link" for child in document.documentElement.childNodes):
        raise InvalidUrdf(without_links(read_xml(file.read_text("utf-8", "replace"))), element=file.name)
    return str(document.toxml())


def _sentence(error: Exception) -> str:
    """Return the error once, on one line: xacro repeats the class and the text of the cause."""
    if isinstance(error, RecursionError):
        return "it includes itself, or a macro calls itself"
    words = re.sub(r"<class '[^']*'>: | \[Errno.*", "", " ".join(str(error).split()))
    half = len(words) // 2
    return words[:half] if words[:half] == words[half + 1 :] else words


def _stand_in(file: Path, packages: Mapping[str, Path]) -> None:
    """Replace ROS's index of packages, and fall back on it."""
    index = sys.modules.get(_FINDER)
    real = getattr(index, "_real", index)
    if real is None:
        try:
            from ament_index_python import packages as real  # type: ignore[import-not-found, no-redef]  # noqa: PLC0415
        except ImportError:
            real = None

    def find(name: str) -> str:
        folder = packages.get(name) or _above(file, name)
        if folder is not None:
            return str(folder)
        if real is not None:
            return str(real.get_package_share_directory(name))
        raise LookupError(f"package {name!r} is not found: name its folder with --package {name}=FOLDER")

    module = ModuleType(_FINDER)
    module.get_package_share_directory = find  # type: ignore[attr-defined]
    module._real = real  # type: ignore[attr-defined]
    sys.modules.setdefault("ament_index_python", ModuleType("ament_index_python"))
    sys.modules[_FINDER] = module


def _above(file: Path, name: str) -> Path | None:
    """Return the package of that name which contains the file or lies beside it, if any."""
    for folder in file.parents:
        for candidate in (folder, folder / name):
            manifest = candidate / "package.xml"
            if manifest.is_file() and _name_of(manifest) == name:
                return candidate
    return None


def _name_of(manifest: Path) -> str | None:
    try:
        return ElementTree.parse(manifest).findtext("name")  # noqa: S314 - the user's own file
    except ElementTree.ParseError:
        return None
