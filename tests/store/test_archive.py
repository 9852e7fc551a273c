"""An archive while it is unpacked and kept; what is refused stands in the corpus of hostile ones."""

import re
import stat
import struct
import threading
import time
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile, ZipInfo

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from gelenk.errors import InvalidArchive, KinematicsError, TooLarge
from gelenk.robot.formats.reading import as_urdf
from gelenk.store.archive import MAX_FOLDERS, unpacked
from gelenk.store.folders import FileRange, pieces
from gelenk.store.library import Library, RobotUpload

CATALOGUE = Path("robots")
FIXED_ENTRIES = 5
"""Of a robot beside its meshes: its folder, `robot.json`, the folder of a version, the URDF, that of the meshes."""


def urdf(*meshes: str) -> bytes:
    shapes = "".join(f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>' for mesh in meshes)
    return f'<robot name="r"><link name="base">{shapes}</link></robot>'.encode()


def zipped(entries: list[tuple[str, bytes]]) -> BytesIO:
    file = BytesIO()
    with ZipFile(file, "w") as archive:
        for name, content in entries:
            archive.writestr(name, content)
    return file


def kept(library: Library, name: str, file: BytesIO) -> None:
    with unpacked(file, root=library.uploads) as robot:
        library.add(RobotUpload(name, "urdf", robot.model, meshes=robot.meshes, urdf_folder=robot.folder))


def within(seconds: float, work: Callable[[], object]) -> bool:
    """Whether some work, in a thread of its own, ends in time."""
    worker = threading.Thread(target=work, daemon=True)
    worker.start()
    worker.join(seconds)
    return not worker.is_alive()


def test_what_is_unpacked_has_no_name_that_a_kill_could_leave_behind(tmp_path: Path) -> None:
    meshes = {"meshes/a.stl": b"a" * 2_500_000, "meshes/empty.obj": b"", "b.dae": bytes(range(256))}
    with unpacked(zipped([("arm.urdf", b"<robot/>"), *meshes.items()]), root=tmp_path) as robot:
        assert (robot.model, robot.folder) == (b"<robot/>", "")
        for _ in range(2):
            assert {path: b"".join(pieces(stretch)) for path, stretch in robot.meshes.items()} == meshes
        assert list(tmp_path.iterdir()) == []


def test_what_the_description_does_not_use_is_not_kept_and_told(tmp_path: Path) -> None:
    library = Library(CATALOGUE, tmp_path)
    names = [
        "meshes/a.stl",
        "meshes/visual/b.OBJ",
        "meshes/visual/b.mtl",
        "meshes/textures/b.png",
        "shots/c.png",
        "d.stl",
    ]
    file = zipped(
        [("r.urdf", urdf("meshes/a.stl", "package://r/meshes/visual/b.OBJ")), *((name, b"x") for name in names)]
    )
    kept(library, "arm", file)
    for name in names[:4]:
        assert library.mesh("arm", name).read_bytes() == b"x"
    for name in names[4:]:
        with pytest.raises(KinematicsError):
            library.mesh("arm", name)
    [told] = [text for text in library.get("arm").warnings if "archive" in text]
    assert told.startswith("2 files of the archive")
    assert len([*tmp_path.rglob("*")]) == len([".lock", ".index"]) + FIXED_ENTRIES + 4


NAMES = st.sampled_from(["a", "b", "A", "m", "ü"])
FILES = st.sampled_from(["x.stl", "y.obj", "y.mtl", "z.png", "x.STL", "notes.txt", "more.urdf.xacro"])
TREES = st.lists(st.tuples(st.lists(NAMES, max_size=MAX_FOLDERS + 3), FILES), max_size=40)


@pytest.mark.slow
@given(tree=TREES, used=st.integers(0, 40), data=st.data())
@pytest.mark.filterwarnings("ignore:Duplicate name")
@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
def test_any_archive_is_kept_or_refused_leaving_no_more_than_is_used(
    tmp_path_factory: pytest.TempPathFactory, tree: list[tuple[list[str], str]], used: int, data: st.DataObject
) -> None:
    """Trees of any depth and names, twice the same, links, entries on one another."""
    root = tmp_path_factory.mktemp("robots")
    library = Library(tmp_path_factory.mktemp("catalogue"), root)
    paths = ["/".join([*folders, name]) for folders, name in tree]
    named = [path for path in paths if not path.endswith((".txt", ".xacro"))][:used]
    file = BytesIO()
    with ZipFile(file, "w") as archive:
        archive.writestr("r.urdf", urdf(*named))
        for path in paths:
            entry = ZipInfo(path)
            entry.external_attr = data.draw(st.sampled_from([0, 0, 0, 0, 0, 0, 0, 0, stat.S_IFLNK | 0o777])) << 16
            archive.writestr(entry, b"solid")
    try:
        kept(library, "arm", file)
    except (InvalidArchive, TooLarge):
        assert [path.name for path in root.rglob("*")] in ([], [".lock"])
    else:
        assert all(len(folders) <= MAX_FOLDERS for folders, _ in tree)
        assert None not in library.get("arm").meshes.values()
        companions = [path for path in paths if path.lower().endswith((".mtl", ".png"))]
        assert len([*root.rglob("*")]) <= len([".lock", ".index"]) + FIXED_ENTRIES + len({*named, *companions})


def test_the_worst_archive_takes_no_minutes(tmp_path: Path) -> None:
    """All entries that there may be, as deep as they may be, all folders different, as many used as there may be."""
    library = Library(CATALOGUE, tmp_path)
    paths = [f"{number}/" + "m/" * (MAX_FOLDERS - 1) + "b.stl" for number in range(1990)]
    started = time.monotonic()
    kept(library, "arm", zipped([("r.urdf", urdf(*paths[:500])), *((path, b"") for path in paths)]))
    assert time.monotonic() - started < 20  # 0.7 s on two idle cores; minutes with a folder for each folder
    assert len([*tmp_path.rglob("*")]) == len([".lock", ".index"]) + FIXED_ENTRIES + 500


class Slow(BytesIO):
    """A file in whose middle something else is tried."""

    def __init__(self, meanwhile: Callable[[], bool]) -> None:
        super().__init__(b"solid")
        self.meanwhile, self.went_on = meanwhile, [False]

    def read(self, size: int | None = -1, /) -> bytes:
        self.went_on.append(self.meanwhile())
        return super().read(size)


@pytest.mark.parametrize("replaces", [False, True])
def test_other_uploads_go_on_while_one_is_written(tmp_path: Path, replaces: bool) -> None:
    library, other, names = Library(CATALOGUE, tmp_path), Library(CATALOGUE, tmp_path), iter("abcdefgh")
    slow = Slow(lambda: within(20, lambda: other.add(RobotUpload(next(names), "urdf", urdf()))))
    if replaces:
        library.add(RobotUpload("slow", "urdf", urdf()))
    upload = RobotUpload("slow", "urdf", urdf("m.stl"), meshes={"m.stl": FileRange(slow, 0, 5)})
    (library.replace if replaces else library.add)(upload)
    assert slow.went_on[-1]
    assert library.mesh("slow", "m.stl").read_bytes() == b"solid"
    assert other.get("a")


def test_other_uploads_go_on_while_leftovers_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    library, other = Library(CATALOGUE, tmp_path), Library(CATALOGUE, tmp_path)
    went_on: list[bool] = []
    leftover = tmp_path / ".new-1" / "deep"
    leftover.mkdir(parents=True)

    def slow(*_: object, **__: object) -> None:
        if not went_on:
            went_on.append(True)
            went_on[0] = within(20, lambda: other.add(RobotUpload("arm", "urdf", urdf())))

    monkeypatch.setattr("gelenk.store.folders.shutil.rmtree", slow)
    library.prepare()
    assert went_on == [True]
    monkeypatch.undo()
    library.prepare()
    assert {path.name for path in tmp_path.iterdir()} == {".lock", ".index", "arm"}


def test_a_mesh_of_mujoco_s_own_format_is_kept_and_weighs_its_body(tmp_path: Path) -> None:
    corners = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)]
    mesh = struct.pack("<4i12f", 4, 0, 0, 0, *(number for corner in corners for number in corner))
    model = (
        b'<mujoco><asset><mesh name="m" file="m.msh" inertia="%s"/></asset>'
        b'<worldbody><body name="b"><geom type="mesh" mesh="m" density="2"/></body></worldbody></mujoco>'
    )
    masses = {}
    for inertia in (b"convex", b"shell"):
        with unpacked(zipped([("arm.xml", model % inertia), ("m.msh", mesh)]), root=tmp_path) as robot:
            assert list(robot.meshes) == ["m.msh"]
            read = as_urdf(robot.model, robot.path, robot.sources)
            (masses[inertia],) = re.findall(rb'<mass value="([\d.]+)"', read.urdf)
            assert read.notes == ()
    assert float(masses[b"convex"]) == pytest.approx(2.0)
    assert float(masses[b"shell"]) == pytest.approx(2.0 * (1.0 + 1.5 + 3.0 + 3.5))
