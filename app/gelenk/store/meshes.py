"""Finds the file that a mesh name in a description refers to, and names an archive's files on disk.

The folder from which a package was packed is unknown, so a file matches if its path ends like the mesh name.
"""

import os.path
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import takewhile
from operator import eq
from pathlib import PurePosixPath

from gelenk.errors import listed, meshes_are

MESH_SUFFIXES = frozenset({".stl", ".obj", ".dae", ".msh"})
COMPANION_SUFFIXES = frozenset({".mtl", ".png", ".jpg", ".jpeg"})
"""Materials and images, which OBJ and DAE files refer to."""
KEPT_SUFFIXES = MESH_SUFFIXES | COMPANION_SUFFIXES
_MOST_FOLDERS = 100
"""Largest number of a name's parts that are compared: an archive's path of 200 bytes has no more."""


def flat(path: str) -> str:
    """Return an archive's path as a single file name, since its folders are not kept; such paths contain no colon."""
    return path.replace("/", ":")


def ends(name: str) -> list[str]:
    """Return all ends of a name, the longest first: `a/b/c`, `b/c`, `c`."""
    parts = name.split("/")[-_MOST_FOLDERS:]
    return ["/".join(parts[start:]) for start in range(len(parts))]


class MeshFiles:
    """Mesh files, found by the ends of their relative paths; `urdf_folder` is "" for a description at the top."""

    def __init__(self, paths: Collection[str], urdf_folder: str) -> None:
        self._paths, self._urdf_folder = frozenset(paths), urdf_folder
        self._nearest: dict[str, tuple[int, list[str]]] = {}
        urdf_parts = urdf_folder.split("/")
        for path in sorted(self._paths):
            parts = path.split("/")
            shared = list(takewhile(bool, map(eq, parts[:-1], urdf_parts)))
            steps = len(parts) - 2 * len(shared)
            for end in ends(path):
                nearest = self._nearest.get(end)
                if nearest is None or steps < nearest[0]:
                    self._nearest[end] = steps, [path]
                elif steps == nearest[0]:
                    nearest[1].append(path)

    def find(self, reference: str) -> list[str]:
        """Return the file that a mesh name refers to; none if it is missing, several if they match equally well.

        A relative name starts at the URDF's folder. Failing that, and for `package://name/folder/file`, the whole name,
        or all but the package's name, must be the end of a path; of several such files, those nearest to the URDF
        count. A package may also have been packed from a folder inside it: then a whole path is an end of the name. And
        a name may pass through more folders than the archive has, of an installation or another repository: then its
        end from a folder on that the URDF is in too, such as the package's, counts.
        """
        scheme, is_address, name = reference.partition("://")
        if not is_address:
            name = os.path.normpath(PurePosixPath(self._urdf_folder) / reference)
            if name in self._paths:
                return [name]
            return self._nearest.get(re.sub(r"^(\.\./)+", "", os.path.normpath(reference)), (0, []))[1]
        if scheme not in {"package", "model", "file"}:
            return []
        most, around = -1 if scheme == "file" else 1, self._urdf_folder.split("/")
        for skipped, end in enumerate(ends(name)):
            if (skipped <= most or end.split("/")[0] in around) and end in self._nearest:
                return self._nearest[end][1]
            if end in self._paths and scheme != "file":
                return [end]
        return []

    def used(self, references: Iterable[str]) -> set[str]:
        """Return the files that these names may refer to, with materials and images that OBJ and DAE files may need.

        Those are all below the parent of the mesh's folder, because meshes are not parsed.
        """
        meshes = {path for reference in references for path in self.find(reference)}
        around = tuple({_around(path) for path in meshes if not path.lower().endswith((".stl", ".msh"))})
        companions = (path for path in self._paths if PurePosixPath(path).suffix.lower() in COMPANION_SUFFIXES)
        return meshes | {path for path in companions if path.startswith(around)}


def mesh_warnings(found: Mapping[str, Sequence[str]]) -> tuple[str, ...]:
    """Return warnings of mesh names, given what `MeshFiles.find` has found for each; one for each kind of fault."""
    kinds = {name: PurePosixPath(name).suffix[1:] for name in found}
    unread = {name: kind or "no ending" for name, kind in kinds.items() if f".{kind.lower()}" not in MESH_SUFFIXES}
    missing = [name for name, paths in found.items() if not paths and name not in unread]
    unclear = [name for name, paths in found.items() if len(paths) > 1 and name not in unread]
    warnings = []
    if unread:
        formats = sorted(set(unread.values()))
        sentence = f"{', '.join(formats[:12])} {'is' if len(formats) == 1 else 'are'} not read: STL, OBJ, DAE, MSH"
        warnings.append(f"{meshes_are(tuple(unread))} not shown: {sentence}")
    if missing:
        warnings.append(f"{meshes_are(tuple(missing))} missing")
    if unclear:
        candidates = tuple(dict.fromkeys(path for name in unclear for path in found[name]))
        warnings.append(f"{meshes_are(tuple(unclear))} not shown: several files match: {listed(candidates)}")
    return tuple(warnings)


def _around(path: str) -> str:
    """Return the parent of a file's folder, with a slash at its end; "" at the top."""
    return "".join(f"{part}/" for part in path.split("/")[:-2])
