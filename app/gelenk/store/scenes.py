"""All scenes by name: each is one file, a zip of the scene as JSON with its meshes and point clouds.

So one rename puts a scene in place with all that belongs to it, and who has opened it reads it to its end, whatever
happens to the name. Nothing in it is compressed. Its comment says what the list of scenes and the quotas need.
"""

import difflib
import hashlib
import os
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from functools import lru_cache
from io import BytesIO
from pathlib import Path

import orjson
from pydantic import PrivateAttr, ValidationError

from gelenk.contract.scene import Scene, SceneFile, SceneSummary
from gelenk.errors import InvalidField, InvalidName, InvalidSceneFile, SceneExists, UnknownScene, listed, quoted
from gelenk.store import folders
from gelenk.store.index import NAME
from gelenk.store.quota import SCENES, Quota
from gelenk.store.records import Stamp, stamp_of

_DOCUMENT = "scene.json"
_SUFFIX = ".zip"
_BROKEN = (zipfile.BadZipFile, ValueError, TypeError, KeyError, NotImplementedError)
_KEPT_BYTES = 64 * 1024
"""Largest file that stays open and parsed until it changes."""


@dataclass(frozen=True, slots=True)
class SceneUpload:
    """A scene to be stored: the contents of its files by name, and the client against whose quota it counts."""

    name: str
    scene: Scene
    files: Mapping[str, bytes] = field(default_factory=dict)
    owner: str | None = None


@dataclass(frozen=True, slots=True)
class _About:
    """The comment of a scene's file; `digest` is that of the scene and its files."""

    owner: str | None
    objects: int
    digest: str


class StoredScene(Scene):
    """A scene with its files, as it was when it was opened."""

    _archive: zipfile.ZipFile = PrivateAttr()
    _digest: str = PrivateAttr()

    @property
    def identity(self) -> str:
        """The digest of its objects and files."""
        return self._digest

    def read(self, file: str) -> bytes:
        """Return the content of one of `files`; raises InvalidSceneFile if it is damaged."""
        try:
            return self._archive.read(file)
        except _BROKEN as error:
            raise InvalidSceneFile(
                f"{quoted(file)} in it is damaged", Path(str(self._archive.filename)).name
            ) from error


@dataclass(frozen=True, slots=True)
class Scenes:
    """Scenes by name, in a folder created when it is first written to; safe in many threads and processes."""

    root: Path
    quota: Quota = SCENES

    def prepare(self) -> None:
        """Remove what interrupted writers left; raises StorageFailed."""
        if self.root.is_dir():
            with folders.staging(self.root):
                pass

    def summaries(self) -> list[SceneSummary]:
        """Return the entries of the list of scenes, by name; files that are no scenes are left out."""
        return [SceneSummary(name=name, objects=about.objects, size=size) for name, size, about in self._entries()]

    def get(self, name: str) -> StoredScene:
        """Return a scene; raises UnknownScene, or InvalidSceneFile if somebody else has written its file."""
        path, stamp = self._found(name)
        return _cached(path, stamp) if stamp[2] <= _KEPT_BYTES else _opened(path)

    def document(self, name: str) -> tuple[bytes, list[SceneFile]]:
        """Return a scene as JSON, the object that has its `objects`, and its files; raises as `get`."""
        path, _ = self._found(name)
        with _archive(path) as archive:
            files = [SceneFile(name=one.filename, size=one.file_size) for one in archive.infolist()]
            return archive.read(_DOCUMENT), [one for one in files if one.name != _DOCUMENT]

    def add(self, upload: SceneUpload) -> bool:
        """Store a new scene, on disk and visible to all processes when this returns; False if it was there before.

        Raises InvalidName, SceneExists if another scene uses the name, QuotaExceeded, and StorageFailed.
        """
        if not NAME.fullmatch(upload.name):
            raise InvalidName(upload.name, "scene")
        about, content = _packed(upload)
        return not self._stands(upload.name, about) and self._put(upload, about, content, is_new=True)

    def replace(self, upload: SceneUpload) -> None:
        """Replace a scene; at any moment, either the old one or the new one exists.

        Files that the upload names and does not bring are those of the old one. Raises UnknownScene, or as `add`.
        """
        old = self.get(upload.name)
        kept = {file: old.read(file) for file in old.files if file in upload.scene.files}
        upload = SceneUpload(upload.name, upload.scene, kept | dict(upload.files), upload.owner)
        self._put(upload, *_packed(upload), is_new=False)

    def remove(self, name: str) -> None:
        """Remove a scene; raises UnknownScene and StorageFailed."""
        self._found(name)
        with folders.exclusive(self.root):
            path, _ = self._found(name)
            path.unlink()
            folders.sync(self.root)

    def _put(self, upload: SceneUpload, about: _About, content: bytes, is_new: bool) -> bool:
        path = self._path(upload.name)
        with folders.staging(self.root) as staging:
            folders.write_tree(staging, {path.name: content})
            with folders.exclusive(self.root):
                if is_new and self._stands(upload.name, about):
                    return False
                if not is_new:
                    self._found(upload.name)
                self._check_quota(upload, len(content))
                folders.move(staging / path.name, path)
        return True

    def _check_quota(self, upload: SceneUpload, size: int) -> None:
        if upload.owner is not None:
            sizes = {name: size for name, size, about in self._entries() if about.owner == upload.owner}
            self.quota.check(upload.owner, list(sizes.values()), size, sizes.get(upload.name))

    def _stands(self, name: str, wanted: _About) -> bool:
        """Return whether an identical scene is stored, whoever stored it; SceneExists for another one."""
        path = self._path(name)
        if (stamp := stamp_of(path)) is None:
            return False
        about = _about(path, stamp)
        if about is None or about.digest != wanted.digest:
            raise SceneExists(name)
        return True

    def _entries(self) -> Iterator[tuple[str, int, _About]]:
        """Yield name, size of the file [bytes] and comment of each scene, by name."""
        for name in self._names():
            path = self._path(name)
            if (stamp := stamp_of(path)) is not None and (about := _about(path, stamp)) is not None:
                yield name, stamp[2], about

    def _names(self) -> list[str]:
        try:
            files = os.listdir(self.root)  # noqa: PTH208 - there may be thousands
        except (FileNotFoundError, NotADirectoryError):
            return []
        names = (file.removesuffix(_SUFFIX) for file in files if file.endswith(_SUFFIX))
        return sorted(name for name in names if NAME.fullmatch(name))

    def _path(self, name: str) -> Path:
        return self.root / f"{name}{_SUFFIX}"

    def _found(self, name: str) -> tuple[Path, Stamp]:
        path = self._path(name)
        stamp = stamp_of(path) if NAME.fullmatch(name) else None
        if stamp is None:
            raise UnknownScene(name, tuple(difflib.get_close_matches(name[:64], self._names(), n=3)))
        return path, stamp


@lru_cache(maxsize=64)
def _cached(path: Path, _: Stamp) -> StoredScene:
    return _opened(path)


def _opened(path: Path) -> StoredScene:
    archive = _archive(path)
    try:
        scene = StoredScene.model_validate_json(archive.read(_DOCUMENT))
        scene._archive, scene._digest = archive, _About(**orjson.loads(archive.comment)).digest
    except (*_BROKEN, ValidationError) as error:
        raise InvalidSceneFile(f"it holds no scene: {str(error)[:200]}", path.name) from error
    return scene


def _archive(path: Path) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(path)
    except FileNotFoundError:
        raise UnknownScene(path.name.removesuffix(_SUFFIX)) from None
    except _BROKEN as error:
        raise InvalidSceneFile("it is not a zip archive", path.name) from error


@lru_cache(maxsize=20_000)
def _about(path: Path, _: Stamp) -> _About | None:
    """Return the comment of a file; None if it is no scene, or has just been removed."""
    try:
        with zipfile.ZipFile(path) as archive:
            return _About(**orjson.loads(archive.comment))
    except (*_BROKEN, OSError):
        return None


def _packed(upload: SceneUpload) -> tuple[_About, bytes]:
    """Return the comment and the content of a scene's file; raises InvalidField if a file is missing or not named."""
    named = upload.scene.files
    if missing := tuple(file for file in named if file not in upload.files):
        raise InvalidField("files", f"objects of the scene name {listed(missing)}, but no such file came with it")
    if unused := tuple(file for file in upload.files if file not in named):
        raise InvalidField("files", f"no object of the scene names {listed(unused)}")
    document = upload.scene.model_dump_json(exclude_unset=True, include={"objects"}).encode()
    contents = {_DOCUMENT: document} | {file: upload.files[file] for file in named}
    digest = hashlib.sha256()
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, content in contents.items():
            digest.update(f"{name}\0{len(content)}\0".encode())
            digest.update(content)
            archive.writestr(name, content)
        about = _About(upload.owner, len(upload.scene.objects), digest.hexdigest())
        archive.comment = orjson.dumps(asdict(about))
    return about, buffer.getvalue()
