"""The address bar: what a link reopens."""

import json

import pytest

from tests.studio.browser import Studio
from tests.studio.tables import ANTHROPOMORPHIC, type_table

KEPT = (
    *("panel", "robot", "draft", "base", "tip", "target", "inverse", "positions"),
    *("degrees", "frames", "axes", "names", "dh", "options"),
)


def states(studio: Studio) -> dict[str, object]:
    return {key: studio.state(key) for key in KEPT}


@pytest.mark.slow
def test_a_reload_restores_everything(studio: Studio) -> None:
    studio.open(robot="ur5")
    studio.button("Random").click()
    studio.button("deg").click()
    for mark in ("Frames", "Names", "DH frames"):
        studio.button(mark).click()
    studio.field("Tip frame").select_option("wrist_2_link")
    target = {"position": [0.3, 0.1, 0.4], "rpy": [0.1, 0.2, 0.3]}
    studio.run(
        "(target) => studio.store.set("
        "{target, inverse: {task: ['x', 'y', 'z']}, options: {'panel.option': 'a value'}})",
        target,
    )
    studio.address()
    before, tip = states(studio), studio.tip()
    studio.page.reload()
    studio.wait_for_robot("ur5")
    assert states(studio) == before
    assert studio.tip() == tip


@pytest.mark.slow
def test_a_draft_is_reopened(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Pose").click()
    studio.type("joint_2, number", "0.7")
    link, before, tip = studio.address(), states(studio), studio.tip()
    studio.go("#" + link.split("#")[1])
    studio.wait_for_robot(None)
    assert states(studio) == before
    assert studio.tip() == tip


@pytest.mark.slow
def test_back_returns_to_the_robot_before(studio: Studio) -> None:
    studio.open(robot="planar_2r", q="0.25,0.5")
    studio.address()
    studio.run("studio.store.set({robot: 'scara'})")
    studio.wait_for_robot("scara")
    studio.address()
    studio.page.go_back()
    studio.wait_for_robot("planar_2r")
    assert studio.state("positions") == {"joint_1": 0.25, "joint_2": 0.5}


@pytest.mark.slow
@pytest.mark.parametrize(
    "fragment",
    [
        "#robot=planar_2r&q=1,2,3",
        "#robot=planar_2r&q=a,b",
        "#panel=nothing",
        "#robot=planar_2r&base=nowhere&tip=nowhere",
        "#robot=planar_2r&target={",
        "#robot=planar_2r&panel=ik&target=[1]&ik=3",
        '#robot=planar_2r&panel=ik&target={"position":[0,0],"rpy":5}&ik={"task":5}',
    ],
)
def test_a_broken_link_still_opens(studio: Studio, fragment: str) -> None:
    studio.go(fragment)
    name, joints = ("planar_2r", 2) if "planar_2r" in fragment else ("panda", 8)
    studio.wait_for_robot(name)
    assert len(studio.state("positions")) == joints
    assert json.dumps(studio.state("base")) == "null"


def test_a_link_that_says_nothing_opens_the_first_screen(studio: Studio) -> None:
    studio.go("#%%%")
    studio.until("studio.store.value.starting")
    assert studio.page.get_by_role("heading", name="Which robot?").is_visible()
