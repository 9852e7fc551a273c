"""The line of an arm against poses from other sources."""

import numpy as np
import pytest

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.plots.arm import arm_line
from tests.oracles import catalogue, dh_columns
from tests.robots import robot, samples, swept


@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_the_line_ends_at_the_tip(name: str) -> None:
    chain = robot(name).chain(None, None)
    for q in samples(chain, 3):
        points, slides = arm_line(chain, q)
        assert np.abs(points[-1] - chain_poses(chain.flat, q[None])[0][0]).max() < 1e-12
        assert len(points) == len(slides) + 2
        assert not points[0].any()


@pytest.mark.parametrize("name", ["planar_3r", "stanford", "ur5_dh"])
def test_joints_are_on_the_axes_of_the_table(name: str) -> None:
    chain = robot(name).chain(None, None)
    table = dh_columns.from_json(catalogue.dh_table(name))
    q = samples(chain, 1)[0]
    for point, frame in zip(arm_line(chain, q)[0][1:-1], table.frames(q), strict=False):
        assert np.linalg.norm(np.cross(frame[:3, 2], point - frame[:3, 3])) < 1e-12


def test_followers_and_ways_up_the_tree() -> None:
    panda = robot("panda")
    chain = panda.chain("panda_rightfinger", "panda_link5")
    q = samples(chain, 1)[0]
    points, slides = arm_line(chain, q)
    assert np.abs(points[-1] - chain_poses(chain.flat, q[None])[0][0]).max() < 1e-12
    assert slides.tolist() == [True, False, False]
