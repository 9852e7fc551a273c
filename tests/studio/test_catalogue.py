"""Every robot of the catalogue on the screen: its meshes, and the browser's poses against Pinocchio's."""

from collections.abc import Iterator

import numpy as np
import pytest

from gelenk.kinematics.judge.judge import certify_poses
from gelenk.robot.poses import Poses
from tests.oracles import catalogue
from tests.robots import by_name, robot, samples, swept
from tests.studio.browser import Pages, Studio

CONFIGURATIONS = 3
TOLERANCE = 1e-12

POSES = """([root, leaf, configurations]) => configurations.map((positions) => {
  const {model} = studio.store.value;
  model.place(positions);
  return model.pose(root, leaf).elements;
})"""


@pytest.fixture(scope="module")
def gallery(pages: Pages, url: str) -> Iterator[Studio]:
    """A page that shows one robot after the other."""
    studio = Studio(pages.take(), url)
    studio.begin(width=1024, height=240)
    studio.open(robot="planar_2r")
    yield studio
    studio.end()
    pages.give_back(studio.page)


@pytest.mark.slow
@pytest.mark.parametrize("name", swept(catalogue.NAMES)[::2])
def test_a_robot_is_shown_as_pinocchio_places_it(gallery: Studio, name: str) -> None:
    studio = gallery
    studio.show(name)
    meshes = studio.run("studio.store.value.model.meshes")
    assert meshes["failed"] == []
    if name in catalogue.TABLES or "<visual" in catalogue.urdf_text(name):
        assert studio.run("studio.view.countMeshes()") > 0
    machine = robot(name)
    for leaf in machine.description.leaves:
        chain = machine.chain(machine.description.root, leaf)
        qs = samples(chain, CONFIGURATIONS)
        columns = by_name(chain, qs)
        configurations = [{joint: float(values[i]) for joint, values in columns.items()} for i in range(len(qs))]
        Ts = np.array(studio.run(POSES, [chain.base_frame, leaf, configurations])).reshape(-1, 4, 4).transpose(0, 2, 1)
        poses = Poses(np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3]))
        certificate = certify_poses(machine, chain, qs, {leaf: poses})
        assert certificate.samples == CONFIGURATIONS
        assert max(certificate.max_position_error, certificate.max_orientation_error) < TOLERANCE, leaf
    assert studio.complaints == []
