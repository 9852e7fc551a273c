"""Scenes on disk: what is acknowledged is there after a kill at any moment; every process sees it at once."""

import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gelenk.contract.scene import EXAMPLE_SCENE, Scene
from gelenk.errors import (
    InvalidField,
    InvalidName,
    InvalidPose,
    InvalidSceneFile,
    QuotaExceeded,
    SceneExists,
    StorageFull,
    UnknownScene,
)
from gelenk.store import folders
from gelenk.store.quota import Quota
from gelenk.store.scenes import Scenes, SceneUpload

KILLS = 4


def ball(radius: float) -> dict[str, Any]:
    return {"name": "ball", "shape": {"type": "sphere", "radius": radius}}


def mesh(file: str) -> dict[str, Any]:
    return {"name": file, "shape": {"type": "mesh", "file": file}}


def upload(name: str, *objects: dict[str, Any], owner: str | None = None, **files: bytes) -> SceneUpload:
    """Names of files have an underscore in the place of the dot."""
    contents = {name.replace("_", "."): content for name, content in files.items()}
    return SceneUpload(name, Scene.model_validate({"objects": list(objects)}), contents, owner)


def radius_of(scenes: Scenes, name: str) -> float:
    shape: Any = scenes.get(name).objects[0].shape
    return float(shape.radius)


@pytest.fixture
def scenes(tmp_path: Path) -> Scenes:
    return Scenes(tmp_path / "scenes")


def test_add_replace_remove(scenes: Scenes) -> None:
    assert scenes.summaries() == []
    assert scenes.add(upload("cell", ball(1)))
    assert not scenes.add(upload("cell", ball(1), owner="another"))
    with pytest.raises(SceneExists, match="'cell' is already used"):
        scenes.add(upload("cell", ball(2)))
    scenes.replace(upload("cell", ball(2), ball(3) | {"name": "other"}))
    assert radius_of(scenes, "cell") == 2
    assert [(one.name, one.objects) for one in scenes.summaries()] == [("cell", 2)]
    with pytest.raises(UnknownScene, match="did you mean 'cell'"):
        scenes.get("cel")
    scenes.remove("cell")
    for call in (scenes.get, scenes.remove, scenes.document):
        with pytest.raises(UnknownScene):
            call("cell")
    with pytest.raises(UnknownScene):
        scenes.replace(upload("cell", ball(2)))


@pytest.mark.parametrize("name", ["", ".", "..", ".lock", "a/b", "a\0", "-a", "ä", "a" * 65, "a\n"])
def test_names_fit_for_paths_only(scenes: Scenes, name: str) -> None:
    with pytest.raises(InvalidName, match="not a scene's name"):
        scenes.add(upload(name, ball(1)))
    for call in (scenes.get, scenes.remove):
        with pytest.raises(UnknownScene):
            call(name)


def test_files_stay_with_the_scene_that_was_opened(scenes: Scenes) -> None:
    scenes.add(upload("cell", mesh("a.stl"), mesh("b.obj"), a_stl=b"first", b_obj=b"second"))
    opened = scenes.get("cell")
    scenes.replace(upload("cell", mesh("a.stl"), mesh("c.dae"), c_dae=b"third"))
    now = scenes.get("cell")
    assert [now.read(file) for file in now.files] == [b"first", b"third"]
    assert [opened.read(file) for file in opened.files] == [b"first", b"second"]
    scenes.remove("cell")
    assert now.read("c.dae") == b"third"


def test_files_and_objects_fit_together(scenes: Scenes) -> None:
    with pytest.raises(InvalidField, match=r"name 'b\.stl', but no such file"):
        scenes.add(upload("cell", mesh("a.stl"), mesh("b.stl"), a_stl=b"solid"))
    with pytest.raises(InvalidField, match=r"no object of the scene names 'b\.stl'"):
        scenes.add(upload("cell", mesh("a.stl"), a_stl=b"solid", b_stl=b"solid"))
    assert scenes.add(upload("cell", mesh("a.stl"), a_stl=b"solid"))
    assert not scenes.add(upload("cell", mesh("a.stl"), a_stl=b"solid"))
    with pytest.raises(SceneExists):
        scenes.add(upload("cell", mesh("a.stl"), a_stl=b"solix"))


def test_a_scene_of_a_call_has_no_files(scenes: Scenes) -> None:
    scenes.add(upload("cell", mesh("a.stl"), a_stl=b"solid"))
    inline = Scene.model_validate({"objects": [mesh("a.stl")]})
    assert scenes.get("cell").read("a.stl") == b"solid"
    with pytest.raises(InvalidField, match="store the scene with its files"):
        inline.read("a.stl")


def test_another_process_sees_it_at_once(scenes: Scenes) -> None:
    """A second store has the part of another process."""
    other = Scenes(scenes.root)
    scenes.add(upload("cell", ball(1)))
    for radius in (2.0, 3.0):
        scenes.replace(upload("cell", ball(radius)))
        assert radius_of(other, "cell") == radius
    scenes.remove("cell")
    assert other.summaries() == []
    with pytest.raises(UnknownScene):
        other.get("cell")


def test_each_owner_has_a_quota(scenes: Scenes) -> None:
    scenes = Scenes(scenes.root, Quota("scene", 2, 2000))
    scenes.add(upload("a", ball(1), owner="anna"))
    scenes.add(upload("b", ball(1), owner="anna"))
    with pytest.raises(QuotaExceeded, match=r"2 scenes .*DELETE /v1/scenes/\{scene\}.*GELENK_CLIENT_SCENES or"):
        scenes.add(upload("c", ball(1), owner="anna"))
    scenes.add(upload("c", ball(1), owner="ben"))
    scenes.replace(upload("a", ball(2), owner="anna"))
    with pytest.raises(QuotaExceeded):
        scenes.replace(upload("c", ball(2), owner="anna"))
    with pytest.raises(QuotaExceeded, match="bytes of scenes"):
        scenes.replace(upload("a", mesh("a.stl"), a_stl=bytes(2000), owner="anna"))
    scenes.remove("b")
    assert scenes.add(upload("d", ball(1), owner="anna"))


@pytest.mark.parametrize("content", [b"", b"PK\5\6" + bytes(18), b"PK\5\6" + bytes(16) + b"\2\0{}", b"words"])
def test_a_file_that_somebody_else_wrote_harms_nobody(scenes: Scenes, content: bytes) -> None:
    scenes.add(upload("cell", ball(1)))
    (scenes.root / "odd.zip").write_bytes(content)
    (scenes.root / "folder.zip").mkdir()
    assert [one.name for one in scenes.summaries()] == ["cell"]
    with pytest.raises(InvalidSceneFile, match=r"odd\.zip"):
        scenes.get("odd")
    with pytest.raises(SceneExists):
        scenes.add(upload("odd", ball(1)))
    scenes.remove("odd")
    with pytest.raises(UnknownScene):
        scenes.get("folder")


def test_a_full_disk_leaves_the_old_scene_and_nothing_else(scenes: Scenes, monkeypatch: pytest.MonkeyPatch) -> None:
    scenes.add(upload("cell", ball(1)))

    def full(*_: object) -> None:
        raise StorageFull("No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(folders, "write_tree", full)
        with pytest.raises(StorageFull):
            scenes.replace(upload("cell", ball(2)))
    assert radius_of(scenes, "cell") == 1
    assert {path.name for path in scenes.root.iterdir()} == {".lock", "cell.zip"}


def test_what_interrupted_writers_left_is_removed(scenes: Scenes) -> None:
    scenes.prepare()
    assert not scenes.root.exists()
    scenes.add(upload("cell", ball(1)))
    (scenes.root / ".new-1").mkdir()
    scenes.prepare()
    assert {path.name for path in scenes.root.iterdir()} == {".lock", "cell.zip"}


def test_where_each_object_is() -> None:
    scene = Scene.model_validate({"objects": EXAMPLE_SCENE["objects"]})
    assert np.array_equal(scene.transforms()[0][:3, 3], [0.5, 0.0, -0.02])
    assert np.array_equal(scene.transforms()[1], np.eye(4))
    bad = ball(1) | {"pose": {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 2]}}
    with pytest.raises(InvalidPose) as refused:
        upload("cell", ball(1) | {"name": "first"}, bad).scene.transforms()
    assert refused.value.field == "objects.1.pose"


STEP = 1e-4
"""Difference of the radii of two scenes in turn, [m]: a fast machine writes thousands, and none exceeds a kilometre."""
WRITER = f"""
import sys
from pathlib import Path
from gelenk.store.scenes import Scenes
from tests.store.test_scenes import ball, mesh, upload
scenes = Scenes(Path(sys.argv[1]))
scenes.prepare()
for number in range(int(sys.argv[2]), 10**6):
    if number % 5 == 0:
        scenes.add(upload("new%d" % number, ball(number * {STEP}), mesh("a.stl"), a_stl=b"%d" % number))
        print("new", number, flush=True)
    else:
        scenes.replace(upload("cell", ball(number * {STEP}), mesh("a.stl"), a_stl=b"%d" % number))
        print("cell", number, flush=True)
"""


@pytest.mark.slow
def test_a_kill_at_any_moment_leaves_the_old_scene_or_the_new(scenes: Scenes) -> None:
    """A writer is killed again and again; after each kill all that it has acknowledged is there, nothing is half."""
    scenes.add(upload("cell", ball(STEP), mesh("a.stl"), a_stl=b"1"))
    chance, last, added = random.Random(1), 1, set()
    for _ in range(KILLS):
        command = [sys.executable, "-c", WRITER, str(scenes.root), str(last + 1)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as writer:
            assert writer.stdout is not None
            said = [writer.stdout.readline() for _ in range(chance.randint(10, 40))]
            time.sleep(chance.uniform(0.0, 0.05))
            writer.send_signal(signal.SIGKILL)
            said += writer.stdout.readlines()
        lines = [line.split() for line in said if line.endswith("\n")]
        scenes.prepare()
        told = [int(number) for what, number in lines if what == "cell"]
        now = scenes.get("cell")
        number = round(radius_of(scenes, "cell") / STEP)
        assert number >= max(told, default=last)
        assert now.read("a.stl") == b"%d" % number
        added |= {f"new{number}" for what, number in lines if what == "new"}
        listed = {one.name for one in scenes.summaries()}
        assert added <= listed
        for name in listed - {"cell"}:
            assert scenes.get(name).read("a.stl") == name.removeprefix("new").encode()
        assert not [path for path in scenes.root.iterdir() if path.name.startswith((".new-", ".old-"))]
        last = max(number, *(int(name.removeprefix("new")) for name in listed - {"cell"}), last)
    assert len(added) > KILLS


def test_what_tells_scenes_apart_and_a_file_that_got_damaged(scenes: Scenes) -> None:
    assert scenes.add(upload("cell", mesh("shelf.stl"), shelf_stl=b"solid shelf"))
    assert scenes.add(upload("same", mesh("shelf.stl"), shelf_stl=b"solid shelf"))
    assert scenes.add(upload("other", mesh("shelf.stl"), shelf_stl=b"solid other"))
    assert scenes.get("cell").identity == scenes.get("same").identity != scenes.get("other").identity
    path = scenes.root / "cell.zip"
    path.write_bytes(path.read_bytes().replace(b"solid shelf", b"solid shelg"))
    with pytest.raises(InvalidSceneFile, match=r"cell\.zip.*'shelf\.stl' in it is damaged"):
        scenes.get("cell").read("shelf.stl")
