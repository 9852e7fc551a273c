"""What tests of the Inverse panel ask of it."""

import json
from typing import Any

from gelenk.contract.pose import Pose
from gelenk.operations.pose_arrays import poses_from
from gelenk.robot.poses import Poses
from tests.studio.browser import Studio
from tests.test_serve import get

TARGET = {"position": [0.4, 0.1, 0.5], "rpy": [3.0, 0.2, 0.4]}
FAR = {"position": [0.9, 0.3, 0.5], "rpy": [3.0, 0.2, 0.4]}
START = "0,-0.785,0,-2.356,0,1.571,0.785,0"

SOLVED = "document.querySelector('.solution') !== null"
GHOSTS = """[...document.querySelectorAll('.solution')].map((_, i) =>
  studio.view.scene.getObjectByName(`ghost ${i}`)?.visible ?? false)"""
IS_THERE = """(name) => {
  const {model, base, tip} = studio.store.value;
  const chain = model.chain(base ?? model.ends.base_frame, tip ?? model.ends.tip_frame);
  const robot = model.moving(chain).map((mesh) => mesh.matrixWorld.elements);
  const ghost = studio.view.scene.getObjectByName(name).children.map((mesh) => mesh.matrix.elements);
  const apart = ghost.flatMap((matrix, i) => matrix.map((number, k) => Math.abs(number - robot[i][k])));
  return apart.length ? Math.max(...apart) : Infinity;
}"""
"""How far the ghost's parts are from the robot's, at most."""
TIP_HEIGHT = "(({model}) => model.pose(model.ends.base_frame, model.ends.tip_frame).elements[14])(studio.store.value)"


def open_at(studio: Studio, robot: str, target: dict[str, Any], **address: str) -> None:
    studio.open("ik", robot=robot, target=json.dumps(target), **address)


def sent(studio: Studio) -> dict[str, Any]:
    """The last call, as the panel shows it."""
    details = studio.page.locator("details.request")
    if details.get_attribute("open") is None:
        details.locator("summary").click()
    studio.button("JSON").click()
    call: dict[str, Any] = json.loads(studio.page.locator(".request code").text_content() or "")
    return call


def answered(studio: Studio, robot: str) -> Any:
    """What the service says to the last call, asked without the page."""
    status, answer = get(f"{studio.url}/v1/robots/{robot}/ik", "POST", sent(studio))
    assert status == 200, answer
    return answer


def chain_positions(studio: Studio, names: list[str]) -> list[float]:
    positions = studio.state("positions")
    return [positions[name] for name in names]


def texts(studio: Studio, selector: str) -> list[str]:
    return studio.page.locator(selector).all_text_contents()


def pose_of(target: dict[str, Any]) -> Poses:
    return poses_from([Pose.model_validate(target)], "targets")
