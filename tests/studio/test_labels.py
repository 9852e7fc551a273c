"""Labels in the picture: each can be read."""

import json
import math
import random
from collections.abc import Callable
from itertools import combinations

import pytest

from tests.studio.browser import Studio
from tests.studio.pure import values

Box = dict[str, float]

SEEN = """[...document.querySelectorAll(".labels > *")]
    .filter((label) => label.style.display !== "none" && label.style.visibility !== "hidden")
    .map((label) => [label.textContent, label.getBoundingClientRect().toJSON()])"""


def covers(a: Box, b: Box) -> bool:
    """Whether two boxes have more than rounding in common."""
    wide = min(a["x"] + a["width"], b["x"] + b["width"]) - max(a["x"], b["x"])
    high = min(a["y"] + a["height"], b["y"] + b["height"]) - max(a["y"], b["y"])
    return wide > 1e-3 and high > 1e-3


def test_labels_move_as_little_as_will_do() -> None:
    apart = [{"x": 0, "y": 0, "width": 40, "height": 16}, {"x": 60, "y": 0, "width": 40, "height": 16}]
    same = [{"x": 0, "y": 0, "width": 40, "height": 10}] * 2
    still, moved, none = values(
        "view/placing.ts", [f"m.placed({json.dumps(boxes)})" for boxes in (apart, same, [same[0]] * 40)]
    )
    assert still == [[0, 0], [0, 0]]
    assert moved == [[0, 0], [0, -11]]
    # There is no room for forty at one place, and none is put where it would be taken for another thing's label.
    assert 5 < sum(shift is not None for shift in none) < 25
    assert max(math.hypot(*shift) for shift in none if shift) <= 48


def test_no_label_covers_another() -> None:
    draw = random.Random(7)
    sets = [
        [
            {"x": draw.uniform(0, 200), "y": draw.uniform(0, 200), "width": draw.uniform(10, 90), "height": 16}
            for _ in range(30)
        ]
        for _ in range(20)
    ]
    for boxes, shifts in zip(
        sets, values("view/placing.ts", [f"m.placed({json.dumps(boxes)})" for boxes in sets]), strict=True
    ):
        shown = [
            {**box, "x": box["x"] + shift[0], "y": box["y"] + shift[1]}
            for box, shift in zip(boxes, shifts, strict=True)
            if shift is not None
        ]
        assert len(shown) > 15
        assert not any(covers(a, b) for a, b in combinations(shown, 2))


@pytest.mark.slow
@pytest.mark.parametrize("size", [(1440, 900), (390, 844)])
def test_names_and_frames_can_be_read(another: Callable[..., Studio], size: tuple[int, int]) -> None:
    """However the arm is turned; the page draws on demand, and leaves labels that have room where they belong."""
    studio = another(width=size[0], height=size[1])
    studio.open(robot="panda", show="frames,names,dh")
    studio.until("studio.store.value.table && document.querySelectorAll('.labels > *').length > 20")
    for key in ("", "ArrowLeft", "ArrowUp", "-"):
        if key:
            studio.page.locator("canvas[role=img]").focus()
            for _ in range(3):
                studio.page.keyboard.press(key)
        studio.drawn()
        seen = studio.run(SEEN)
        assert len(seen) > (20 if size[0] > 1000 else 12)
        assert [(a[0], b[0]) for a, b in combinations(seen, 2) if covers(a[1], b[1])] == []
