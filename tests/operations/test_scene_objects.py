"""Objects of a scene: what they are made of, and what is said where that is larger."""

from gelenk.contract.scene import Scene
from gelenk.operations.scene_objects import obstacles_of


def test_terrain_is_solid_down_to_its_base_and_says_how_much_higher_it_counts() -> None:
    shape = {"type": "height_map", "heights": [[0.0, 0.1], [0.2, 0.1]], "size": [1.0, 2.0]}
    rough, flat = ({"name": name, "shape": shape | more} for name, more in (("rough", {}), ("flat", FLAT)))
    first, second = obstacles_of(Scene.model_validate({"objects": [rough, flat]}), "root")
    assert first.note == "'rough' counts as boxes that reach at most 0.2 m above its surface"
    assert [body.size for body in first.bodies] == [(1.0, 2.0, 0.2)]
    assert (second.note, [body.size for body in second.bodies]) == (None, [(1.0, 2.0, 0.5)])


FLAT = {"heights": [[0.1, 0.1], [0.1, 0.1]], "base": -0.4}
