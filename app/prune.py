"""Take from an environment what the service never opens: `python -m app.prune PREFIX`, for the container image.

Wheels carry headers, static libraries, three copies of one library, tests, and all of example-robot-data. What is
needed is found by use: all robots of the catalogue are loaded, then the libraries that this process has mapped stay.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from app.model.errors import counted
from app.store.library import Library
from app.store.records import package_data

_CATALOGUE = Path(__file__).resolve().parents[1] / "robots"
_FOR_DEVELOPERS = frozenset({".a", ".cmake", ".h", ".hh", ".hpp", ".hxx", ".pc", ".pxd", ".pyi", ".pyx"})
_SHAPES = frozenset({".dae", ".obj", ".sdf", ".srdf", ".stl", ".urdf"})
_LICENCES = ("LICENSE", "LICENCE", "COPYING", "NOTICE")


def main() -> None:
    """Prune the environment that runs this; it must be named, so that nobody does it to their own by mistake."""
    if len(sys.argv) != 2 or Path(sys.argv[1]).resolve() != Path(sys.prefix).resolve():
        sys.exit(f"usage: python -m app.prune {sys.prefix}")
    files = list(unneeded({*catalogue_files(), *mapped_files()}))
    size = sum(file.stat().st_size for file in files)
    for file in files:
        file.unlink()
    print(f"{counted(len(files), 'file')} of {size / 1e6:.0f} MB removed")


def catalogue_files() -> Iterator[Path]:
    """The description of each robot of the catalogue, and the meshes that it names."""
    library = Library(_CATALOGUE, _CATALOGUE / "none")
    for robot in map(library.get, library.catalogue_names):
        record, meshes = robot.record, robot.meshes.values()
        yield record.model_path.resolve()
        if record.mesh_root is not None:
            yield from ((record.mesh_root / path).resolve() for path in meshes if path is not None)


def mapped_files() -> set[Path]:
    """The files that this process has mapped into its memory: its libraries."""
    lines = Path("/proc/self/maps").read_text().splitlines()
    return {Path(columns[5]) for columns in (line.split(maxsplit=5) for line in lines) if len(columns) == 6}


def unneeded(needed: set[Path]) -> Iterator[Path]:
    """The files of this environment that neither the service nor a licence needs.

    Args:
        needed: Libraries and robots; materials and pictures of the same folder stay with a robot's meshes.
    """
    data = package_data().resolve()
    prefix = data.parents[1]
    site_packages = prefix.parent
    folders = {data / Path(*file.relative_to(data).parts[:2]) for file in needed if file.is_relative_to(data)}
    for file in [path for path in site_packages.rglob("*") if path.is_file()]:
        if file in needed or file.name.upper().startswith(_LICENCES):
            continue
        if file.is_relative_to(data):
            is_unneeded = file.suffix.lower() in _SHAPES or folders.isdisjoint(file.parents)
        elif file.is_relative_to(prefix) and "site-packages" not in file.relative_to(prefix).parts:
            is_unneeded = True
        else:
            is_unneeded = file.suffix in _FOR_DEVELOPERS or "tests" in file.relative_to(site_packages).parts
        if is_unneeded:
            yield file


if __name__ == "__main__":
    main()
