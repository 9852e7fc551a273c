"""Workspaces of which samples in contact are no part: each verdict against Coal's, and dexterity in a cell."""

from dataclasses import replace

import numpy as np
import pytest

from gelenk.collision.cell import Cell, cell_in
from gelenk.collision.contact.judge import ContactJudge
from gelenk.errors import CertificationFailed
from gelenk.kinematics.workspace.survey import Survey
from gelenk.kinematics.workspace.workspace import Wish, plan, sampled
from gelenk.robot.arrays import Array, Flags
from tests.collision.arms import world


def test_samples_in_contact_are_no_part_of_a_workspace() -> None:
    cell = cell_in(world(), 0.03)
    robot, chain = cell.world.robot, cell.world.chain
    work = replace(plan(chain, Wish("cloud", 200))[0], world=cell.world.flat)
    survey, judge = Survey(work), ContactJudge(cell.world)
    survey.add(sampled((work, 0)))
    found = survey.result(robot, chain, cell)
    qs = work.sampling.configurations(0, 200)
    free = np.array([judge.least_slack(judge.poses(q), 0.01)[0] > 0.0 for q in qs])
    assert 20 < free.sum() == found.free == found.count < 180
    assert found.points is not None
    np.testing.assert_allclose(found.points, np.column_stack(work.measured(qs[free])), atol=1e-12)
    assert found.voxels.counts.sum() == found.count
    assert set(found.voxels.first) <= set(np.flatnonzero(free))
    assert found.contacts is not None
    assert found.contacts.samples == found.certificate.samples == 16


def test_a_wrong_verdict_is_withheld(monkeypatch: pytest.MonkeyPatch) -> None:
    cell = cell_in(world())
    work, _ = plan(cell.world.chain, Wish("cloud", 20))
    survey = Survey(work)
    survey.add(sampled((work, 0)))

    def nothing(_: Cell, qs: Array) -> Flags:
        return np.zeros(len(qs), dtype=bool)

    monkeypatch.setattr(Cell, "touching", nothing)
    with pytest.raises(CertificationFailed, match="a contact"):
        survey.result(cell.world.robot, cell.world.chain, cell)
