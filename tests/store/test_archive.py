"""An archive while it is unpacked; what is refused stands in the corpus of hostile ones."""

from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

from app.store.archive import unpacked
from app.store.folders import pieces


def test_what_is_unpacked_has_no_name_that_a_kill_could_leave_behind(tmp_path: Path) -> None:
    meshes = {"meshes/a.stl": b"a" * 2_500_000, "meshes/empty.obj": b"", "b.dae": bytes(range(256))}
    file = BytesIO()
    with ZipFile(file, "w") as archive:
        archive.writestr("arm.urdf", "<robot/>")
        for path, content in meshes.items():
            archive.writestr(path, content)
    with unpacked(file, root=tmp_path) as robot:
        assert robot.urdf == b"<robot/>"
        for _ in range(2):
            assert {path: b"".join(pieces(stretch)) for path, stretch in robot.meshes.items()} == meshes
        assert list(tmp_path.iterdir()) == []
