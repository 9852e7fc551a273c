"""Remove from an environment what the service never opens: `python -m gelenk.prune PREFIX`, for the container image.

Wheels carry headers, static libraries, three copies of one library, tests, and all of example-robot-data. To find out
what is needed, this process loads all robots of the catalogue and everything for pictures and formulas; the libraries
that it has mapped by then stay. Meshes are compressed, as the service sends them.
"""

import gzip
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

from gelenk.errors import counted
from gelenk.package_data import catalogue
from gelenk.processes.fork_server import SELDOM_NEEDED
from gelenk.store.library import Library
from gelenk.store.meshes import MESH_SUFFIXES
from gelenk.store.records import package_data

_FOR_DEVELOPERS = frozenset({".a", ".cmake", ".h", ".hh", ".hpp", ".hxx", ".pc", ".pxd", ".pyi", ".pyx"})
_UNOPENED = frozenset({"benchmarks", "distutils", "f2py", "tests"}) | {
    *("cffLib", "cu2qu", "designspaceLib", "feaLib", "otlLib", "pens", "qu2cu", "subset", "ttLib", "ufoLib", "varLib"),
}
"""Folders for developers, and the parts of fontTools that only PDF and PostScript need."""
_SHAPES = frozenset({".dae", ".obj", ".sdf", ".srdf", ".stl", ".urdf"})
_LICENCES = ("LICENSE", "LICENCE", "COPYING", "NOTICE")


def main() -> None:
    """Prune the environment of this interpreter; it must be named, to prevent mistakes."""
    if len(sys.argv) != 2 or Path(sys.argv[1]).resolve() != Path(sys.prefix).resolve():
        sys.exit(f"usage: python -m gelenk.prune {sys.prefix}")
    robots = set(catalogue_files())
    for module in SELDOM_NEEDED:
        import_module(module)
    files = list(unneeded({*robots, *mapped_files()}))
    size = sum(file.stat().st_size for file in files)
    for file in files:
        file.unlink()
    for file in robots:
        if file.suffix.lower() in MESH_SUFFIXES:
            compress(file)
    print(f"{counted(len(files), 'file')} of {size / 1e6:.0f} MB removed")


def catalogue_files() -> Iterator[Path]:
    """Yield the description of each robot of the catalogue, and the meshes that it names."""
    library = Library(catalogue(), catalogue() / "none")
    for robot in map(library.get, library.catalogue_names):
        record, meshes = robot.record, robot.meshes.values()
        yield record.model_path.resolve()
        if record.mesh_root is not None:
            yield from ((record.mesh_root / path).resolve() for path in meshes if path is not None)


def mapped_files() -> set[Path]:
    """Return the files that this process has mapped into its memory: its libraries."""
    lines = Path("/proc/self/maps").read_text().splitlines()
    return {Path(columns[5]) for columns in (line.split(maxsplit=5) for line in lines) if len(columns) == 6}


def compress(mesh: Path) -> None:
    """Replace a mesh by a compressed file, with `.gz` added to its name."""
    mesh.with_name(f"{mesh.name}.gz").write_bytes(gzip.compress(mesh.read_bytes(), mtime=0))
    mesh.unlink()


def unneeded(needed: set[Path]) -> Iterator[Path]:
    """Yield the files that neither the service nor a licence needs; pictures beside a needed mesh stay too."""
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
            parts = file.relative_to(site_packages).parts
            is_library = parts[0].endswith(".libs")  # a wheel's own libraries; those that are needed are mapped
            is_unneeded = is_library or file.suffix in _FOR_DEVELOPERS or not _UNOPENED.isdisjoint(parts)
        if is_unneeded:
            yield file


if __name__ == "__main__":
    main()
