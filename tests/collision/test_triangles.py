"""Verdicts about pieces against Coal on the triangles that they are made of."""

from pathlib import Path

import numpy as np
import pytest

from gelenk.operations.robot_bodies import bodies_of
from gelenk.settings import Settings
from gelenk.store.library import Library
from tests.collision.coal_peer import drawn_links
from tests.collision.figures_meshes import compared, draw, random_world


@pytest.mark.slow
@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_no_contact_of_a_triangle_is_missed(name: str, tmp_path: Path) -> None:
    loaded, rng = Library(Settings().catalogue_dir, tmp_path).get(name), np.random.default_rng(5)
    world = random_world(rng, loaded, bodies_of(loaded))
    counts, gap = compared(world, drawn_links(loaded), draw(rng, world, 300))
    assert not counts["missed"]
    assert not counts["unexplained"]
    assert 20 < counts["contacts"] < 280
    assert counts["alarms"] < 15
    assert gap < 0.05
