"""Scenes as they are sent: what is read, and what is refused at which field."""

import json
from typing import Any

import pytest
from pydantic import TypeAdapter, ValidationError

from gelenk.contract.scene import Scene, SceneOrName

TABLE: dict[str, Any] = {
    "name": "table",
    "shape": {"type": "box", "size": [1.0, 2.0, 0.1]},
    "pose": {"position": [0.5, 0.0, -0.05]},
}
SHAPES: list[dict[str, Any]] = [
    {"type": "sphere", "radius": 0.1},
    {"type": "cylinder", "radius": 0.1, "length": 0.5},
    {"type": "capsule", "radius": 0.1, "length": 0.5},
    {"type": "half_space", "normal": [0.0, 0.0, 1.0], "offset": -0.1},
    {"type": "mesh", "file": "shelf.stl"},
    {"type": "points", "points": [[0.1, 0.2, 0.3]], "radius": 0.01},
    {"type": "points", "file": "scan.npy", "radius": 0.01},
    {"type": "height_map", "heights": [[0.0, 0.1], [0.2, 0.1]], "size": [1.0, 2.0], "base": -0.1},
]


def test_each_shape_is_read_and_written_again() -> None:
    objects = [TABLE, *({"name": f"{i}", "shape": shape} for i, shape in enumerate(SHAPES))]
    scene = Scene.model_validate_json(json.dumps({"objects": objects}))
    assert [one.shape.model_dump(exclude_unset=True) for one in scene.objects[1:]] == SHAPES
    assert Scene.model_validate_json(scene.model_dump_json()) == scene


def test_a_scene_is_a_name_or_objects() -> None:
    adapter: TypeAdapter[Any] = TypeAdapter(SceneOrName)
    assert adapter.validate_json('"cell-3"') == "cell-3"
    assert adapter.validate_json(json.dumps({"objects": [TABLE]})).objects[0].name == "table"


@pytest.mark.parametrize(
    ("shape", "field"),
    [
        ({"type": "box", "size": [1.0, 0.0, 1.0]}, ("size", 1)),
        ({"type": "box", "size": [1.0, 1.0]}, ("size",)),
        ({"type": "sphere", "radius": -0.1}, ("radius",)),
        ({"type": "capsule", "radius": 0.1, "length": 2e3}, ("length",)),
        ({"type": "points", "points": [], "radius": 0.1}, ("points",)),
        ({"type": "points", "file": "scan.npz", "radius": 0.1}, ("file",)),
        ({"type": "mesh", "file": "../shelf.stl"}, ("file",)),
        ({"type": "height_map", "heights": [[0.0, 0.1]], "size": [1.0, 1.0]}, ("heights",)),
        ({"type": "height_map", "heights": [[0.0, 1e4], [0.0, 0.0]], "size": [1.0, 1.0]}, ("heights", 0, 1)),
        ({"type": "height_map", "heights": [[0.0, 0.0], [0.0]], "size": [1.0, 1.0]}, ("heights", 1)),
        ({"type": "height_map", "heights": [[0.0, 0.0], [0.0, 0.0]], "size": [1.0, 0.0]}, ("size", 1)),
        ({"type": "cone", "radius": 0.1}, ()),
    ],
)
def test_a_bad_shape_is_refused_at_its_field(shape: dict[str, Any], field: tuple[object, ...]) -> None:
    with pytest.raises(ValidationError) as caught:
        Scene.model_validate({"objects": [TABLE, {"name": "bad", "shape": shape}]})
    (error,) = caught.value.errors()
    at = ("objects", 1, "shape", *((shape["type"],) if field else ()), *field)
    assert error["loc"] == at


def test_points_come_from_one_place() -> None:
    both = {"type": "points", "points": [[0.0, 0.0, 0.0]], "file": "scan.npy", "radius": 0.1}
    for shape in (both, {"type": "points", "radius": 0.1}):
        with pytest.raises(ValidationError, match="exactly one of `points` and `file`"):
            Scene.model_validate({"objects": [{"name": "bad", "shape": shape}]})


def test_two_objects_of_one_name_are_refused() -> None:
    with pytest.raises(ValidationError, match="entries 0 and 1 are both named 'table'"):
        Scene.model_validate({"objects": [TABLE, TABLE]})
