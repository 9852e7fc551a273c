"""The problems of MotionBenchMaker are read as they are meant: goals touch nothing, but objects are near."""

from pathlib import Path

import numpy as np
import pytest

from gelenk.collision.contact.judge import ContactJudge
from gelenk.collision.contact.kernels import nearest_pairs
from gelenk.collision.contact.world import build_world
from gelenk.operations.robot_bodies import bodies_of
from gelenk.settings import Settings
from gelenk.store.library import Library
from tests.collision.motion_bench_maker import FINGERS, SETS, START, problems


@pytest.mark.slow
def test_starts_and_goals_are_free_and_goals_are_near_to_an_object(tmp_path: Path) -> None:
    loaded = Library(Settings().catalogue_dir, tmp_path).get("panda")
    for problem in (one for name in SETS for one in problems(name)[:1]):
        chain = loaded.robot.chain(None, None)
        world = build_world(loaded.robot, chain, bodies_of(loaded), problem.obstacles, FINGERS)
        (at_start, at_goal), pairs, _ = nearest_pairs(world.flat, np.array([START, problem.goal]))
        assert at_start > 0.0
        assert 0.0 < at_goal < 0.06
        assert world.names[world.flat.pairs[pairs[1], 1]] in {one.name for one in problem.obstacles}
        judge = ContactJudge(world)
        assert judge.least_slack(judge.poses(problem.goal), 0.1)[0] == pytest.approx(at_goal, abs=1e-6)
