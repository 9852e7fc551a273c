"""The makers' arms of the catalogue against the public descriptions that their figures come from.

`arms.json` holds those as numbers: of each arm the pose of its base in the first link, where that is another frame, and
then each joint from base to tip as xyz [m], rpy [rad] and, of one that moves, its axis. The numbers are facts; the
descriptions are under Apache-2.0, BSD or MIT, and none of their text is here. Some write quarter turns as 1.57 or
1.5708: an angle within a milliradian of a quarter turn is taken as that.
"""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from tests.oracles import catalogue
from tests.robots import robot

ARMS: dict[str, dict[str, Any]] = json.loads(Path(__file__).with_name("arms.json").read_text())
QUARTER = math.pi / 2.0


def pose(xyz: list[float], rpy: list[float]) -> Array:
    near = [QUARTER * round(x / QUARTER) if abs(x - QUARTER * round(x / QUARTER)) < 1e-3 else x for x in rpy]
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.from_euler("xyz", near).as_matrix(), xyz
    return T


def described(name: str, q: Array) -> Array:
    """Pose of the tip in the base by the description's joint origins alone; with fewer angles of the next joint."""
    arm, turns = ARMS[name], iter(q)
    T = np.linalg.inv(pose(*arm["base"][:2])) if "base" in arm else np.eye(4)
    for xyz, rpy, *axis in arm["steps"]:
        T = T @ pose(xyz, rpy)
        if axis and (angle := next(turns, None)) is None:
            return np.asarray(T)  # the frame of the first joint without an angle
        if axis:
            T[:3, :3] = (
                T[:3, :3] @ Rotation.from_rotvec(angle * np.array(axis[0]) / np.linalg.norm(axis[0])).as_matrix()
            )
    return np.asarray(T)


def configurations(name: str, count: int) -> Array:
    lower, upper = (
        np.array([joint[end] for joint in catalogue.dh_table(name)["joints"]]) for end in ("lower", "upper")
    )
    return np.random.default_rng(8).uniform(lower, upper, (count, len(lower)))


def test_there_are_arms_of_all_the_makers() -> None:
    assert len(ARMS) >= 50
    makers = {catalogue.entry(name)["maker"] for name in ARMS}
    assert makers >= {"ABB", "FANUC", "KUKA", "Kinova", "Stäubli", "UFACTORY", "Universal Robots", "Yaskawa"}


@pytest.mark.quick(12)
@pytest.mark.parametrize("name", ARMS)
def test_the_table_moves_as_the_description(name: str) -> None:
    qs = configurations(name, 5)
    found = chain_poses(robot(name).chain(None, None).flat, qs)
    for p, R, q in zip(*found, qs, strict=True):
        T = described(name, q)
        assert np.abs(p - T[:3, 3]).max() <= 1e-6
        assert np.abs(R - T[:3, :3]).max() <= 1e-6


def test_limits_are_sane_and_sources_are_named() -> None:
    for name, arm in ARMS.items():
        entry = catalogue.entry(name)
        for row in catalogue.dh_table(name)["joints"]:
            assert -4.5 * math.pi <= row["lower"] < row["upper"] <= 4.5 * math.pi, name
            assert row["upper"] - row["lower"] > 1.0, name
            assert 0.3 < row.get("velocity", 1.0) < 30.0, name
        assert arm["source"]["repository"] in entry["source"]
        assert arm["source"]["file"] in entry["source"]
        assert 0.1 < entry.get("payload", 1.0) < 500.0


def test_all_but_a_few_figures_have_a_document() -> None:
    sources = {name: catalogue.entry(name)["source"] for name in ARMS}
    assert {name for name in ARMS if "payload" not in catalogue.entry(name)} == {"rx160l"}
    assert {name for name in ARMS if "reach" not in catalogue.entry(name)} == set()
    assert {name for name, source in sources.items() if "without a document" in source} == {
        *("rv2fr", "rv4fr", "rv7frl", "rx160l"),
    }


def test_limits_against_the_ground_are_told() -> None:
    """Where a linkage holds axis 3, the maker limits its angle against the ground: no limit of the joint itself."""
    linked = {name for name in ARMS if "subtracted" in catalogue.entry(name).get("controller", {})}
    told = {name for name in ARMS if "against the ground" in catalogue.entry(name)["source"]}
    assert (linked, told) == ({"irb2400"}, {"irb2400", "m10ia"})


REACHES = [name for name in catalogue.TABLES if "reach" in catalogue.entry(name)]
TO_FLANGE = {
    *("a0509", "h2017", "m0609", "m0617", "m1013", "m1509", "panda_dh", "gen3", "jaco2"),
    *("crx10ia", "crx10ia_l", "crx20ia_l", "crx25ia", "crx5ia", "fr3", "gen3_6dof", "jaco2_7dof", "piper"),
    *("rx160", "rx160l", "tx2_60", "tx2_60l", "tx2_90", "tx2_90l"),
}
"""Arms whose figure is that of the flange; most are that of the wrist's centre, where axes 4 and 5 meet."""
BETWEEN = {name for name in REACHES if name.startswith("ur")} | {
    *("crb15000_5_95", "crx30ia", "rizon4", "rizon10", "xarm5", "xarm6", "xarm7_dh"),
}
"""Arms whose figure is of a point between that centre, or their last two joints, and the flange: nobody says which."""
GRIPPERS = {"gen3_lite": 0.13}
"""How far before the flange the tool frame of a gripper stands that the figure includes, by the maker's description."""
FARTHER = {"sawyer"}
"""Arms whose figure is farther than their table reaches: nobody says to what."""


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", REACHES)
def test_the_reach_is_that_which_the_maker_publishes(name: str) -> None:
    """The farthest point from axis 1 within the limits, to 2.5 %, as much as the designation of an IRB 1600 leaves."""
    published, flange, wrist = catalogue.entry(name)["reach"], farthest(name, 0), farthest(name, 2)
    if name in BETWEEN:
        assert wrist <= published <= flange
    elif name in FARTHER:
        assert published > flange
    else:
        length = flange + GRIPPERS.get(name, 0.0) if name in {*TO_FLANGE, *GRIPPERS} else wrist
        assert published == pytest.approx(length, rel=0.025)


def farthest(name: str, without: int) -> float:
    """Greatest distance from axis 1 of the tip, or of the frame of the table before its last rows, [m]."""
    joints = catalogue.dh_table(name)["joints"]
    lower, upper = (np.array([joint[end] for joint in joints]) for end in ("lower", "upper"))
    count = len(joints) - without
    chain, random = robot(name).chain("base", f"frame_{count}" if without else "tool"), np.random.default_rng(8)
    lower, upper = lower[:count], upper[:count]
    best, most, width = 0.5 * (lower + upper), 0.0, 1.0
    for _ in range(60):  # ever nearer to the best so far
        qs = np.clip(best + width * random.uniform(-1.0, 1.0, (500, count)) * (upper - lower), lower, upper)
        points = chain_poses(chain.flat, qs)[0]
        far = np.hypot(points[:, 0], points[:, 1])
        if far.max() > most:
            best, most = qs[far.argmax()], float(far.max())
        width *= 0.85
    return most


CONTROLLED = {
    name: entry["controller"] for name in catalogue.TABLES if "controller" in (entry := catalogue.entry(name))
}


def at_pendant(name: str, shown: Array) -> Array:
    """Pose of the flange in the controller's base at what the pendant shows, [rad]; shape (4, 4)."""
    controller, names = CONTROLLED[name], [joint["name"] for joint in catalogue.dh_table(name)["joints"]]
    own = shown.copy()
    for sign, key in ((1.0, "added"), (-1.0, "subtracted")):
        for joint, other in controller.get(key, {}).items():
            own[names.index(joint)] += sign * shown[names.index(other)]
    q = np.array(controller["joint_signs"]) * own + controller["joint_zeros"]
    chain = robot(name).chain(controller["base_frame"], controller["tip_frame"])
    T = np.eye(4)
    T[:3, 3], T[:3, :3] = (part[0] for part in chain_poses(chain.flat, q[None]))
    return T


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", CONTROLLED)
def test_the_arm_stands_as_its_pendant_says(name: str) -> None:
    """At zero, arms of UR lie stretched out backwards; of the others the flange faces ahead, KUKA's arm lying."""
    zero, kind = at_pendant(name, np.zeros(6)), CONTROLLED[name]["pose_format"]
    x, y = zero[:2, 3]
    lengths = sum(abs(joint["a"]) for joint in catalogue.dh_table(name)["joints"])
    if kind == "ur":
        assert x == pytest.approx(-lengths, rel=1e-6)
        return
    np.testing.assert_allclose(zero[:3, 2], [1.0, 0.0, 0.0], atol=1e-3)
    assert abs(y) < 0.3 * x
    turned = at_pendant(name, np.array([0.3, 0.0, 0.0, 0.0, 0.0, 0.0]))
    assert turned[1, 2] == pytest.approx(-np.sin(0.3) if kind == "kuka_abc" else np.sin(0.3), abs=1e-3)
    leaning = at_pendant(name, np.array([0.0, 0.4, 0.0, 0.0, 0.0, 0.0]))
    assert leaning[0, 3] < x if kind == "kuka_abc" else leaning[0, 3] > x
    # Of FANUC and the IRB 2400, J3 says how the forearm stands against the ground: J2 alone does not turn it.
    turns = np.abs(leaning[:3, :3] - zero[:3, :3]).max()
    assert turns < 1e-9 if kind == "fanuc_wpr" or name == "irb2400" else turns > 0.1
