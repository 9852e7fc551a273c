"""What pendants show, against poses, parameters and descriptions that others publish.

The source of an arm says whether the senses and zeros of its joints are verified here, or inferred from a description.

`library.json` has what RoboDK's library gives for an arm, as SaltworkerMLU/robotkinematicscatalogue lists it: rows of
the modified convention, alpha [°], a [mm], d [mm] and theta [°], the sense of each joint, and the joints that count
against the ground: these turn by what they show, less what the joint before shows. They are facts. Arms of other makers
are there too, whose tables they confirm.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from tests.dh.test_arms import CONTROLLED, at_pendant, pose
from tests.oracles import catalogue
from tests.robots import robot, table

Shown = dict[tuple[float, ...], tuple[tuple[float, ...], tuple[float, ...]]]

ROBODK: Shown = {
    (0, 0, 0, 0, 0, 0): ((374.0, 0.0, 630.0), (0.0, 90.0, 0.0)),
    (30, -45, 20, 40, -30, 60): ((96.492, 28.99, 723.337), (112.051, -18.032, 41.412)),
    (-60, 35, -40, -70, 45, -120): ((209.494, -458.536, 594.316), (-52.419, -74.149, 131.03)),
    (90, -80, 50, 100, -60, 200): ((61.407, -2.768, 557.13), (-50.859, 50.287, -79.197)),
    (-120, 70, -70, 140, 80, -300): ((-244.638, -514.881, 506.663), (110.979, -38.549, 15.287)),
    (150, -100, 65, -150, -100, 350): ((11.445, -47.546, 416.203), (165.873, -30.404, -157.744)),
}
"""Of ABB's IRB 120, as RoboDK shows them: axes [°], then x, y, z [mm] and turns about z, y, x [°]."""

IRB4600_20: Shown = {
    (0, 0, 0, 0, 0, 0): ((1490.5, 0.0, 1765.0), (0.0, 90.0, 0.0)),
    (45, 45, 45, 45, 45, 45): ((734.88, 794.99, -21.32), (-144.74, -30.0, 125.26)),
    (-45, -45, -45, -45, -45, -45): ((-547.5, 607.6, 2559.89), (35.26, -30.0, -144.74)),
}
"""Of ABB's IRB 4600-20/2.50, from the README of Susta79/RF210001: as above, but turns about fixed x, y, z. Its fourth
pose has a tilt of 90°, where its angles are not unique."""

H = np.pi / 2.0
MAKERS: dict[str, list[tuple[list[float], list[float], int]]] = {
    "kr6_r700_sixx": [
        ([0, 0, 0.4], [0, 0, 0], -3), ([0.025, 0, 0], [0, 0, 0], 2), ([0.315, 0, 0], [0, 0, 0], 2),
        ([0, 0, 0.035], [0, 0, 0], -1), ([0.365, 0, 0], [0, 0, 0], 2), ([0.08, 0, 0], [0, 0, 0], -1),
        ([0, 0, 0], [0, H, 0], 0),
    ],
    "kr6_r900_sixx": [
        ([0, 0, 0.4], [0, 0, 0], -3), ([0.025, 0, 0], [0, 0, 0], 2), ([0.455, 0, 0], [0, 0, 0], 2),
        ([0, 0, 0.035], [0, 0, 0], -1), ([0.42, 0, 0], [0, 0, 0], 2), ([0.08, 0, 0], [0, 0, 0], -1),
        ([0, 0, 0], [0, H, 0], 0),
    ],
    "kr150_r3100_2": [
        ([0, 0, 0.3056], [2 * H, 0, 0], 3), ([0.33, 0.072, -0.3394], [H, 0, 0], 3),
        ([1.35, 0, -0.103], [0, 0, 0], 3), ([1.028, -0.115, 0.175], [H, 0, -H], 3),
        ([0, 0.096, -0.392], [0, H, H], 3), ([0.1665, 0, -0.096], [H, 0, -H], 3),
        ([0, 0, -0.0485], [2 * H, 0, 2 * H], 0),
    ],
    "kr210_r2700_2": [
        ([0, 0, 0], [-2 * H, 0, 0], 3), ([0.33, 0, -0.645], [H, 0, 0], 3), ([1.15, 0, 0], [0, 0, -H], 3),
        ([0.115, 0, 0], [H, 0, 0], 3), ([0, 0, -1.22], [-H, 0, 0], 3), ([0, 0, 0], [H, 0, 0], 3),
        ([0, 0, -0.215], [0, 2 * H, 0], 0),
    ],
}  # fmt: skip
"""KUKA's own descriptions, whose transformations its README says are verified, from `base`, that of the controller, to
`tool0`, its flange: xyz [m] and rpy [rad] of each joint, and its axis, ±1 to ±3. Its drivers change but the units."""
LIBRARY: dict[str, dict[str, Any]] = json.loads(Path(__file__).with_name("library.json").read_text())

CRX: dict[str, list[tuple[list[float], list[float], list[float]]]] = {
    "crx5ia": [
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [575.0, -130.0, 410.0],
         [0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0]),
        ([188.1, -42.0, -47.6, -127.4, 11.7, 44.8], [-13.8448, -58.1304, -199.3782],
         [-0.1427262, 0.7973799, -0.586357, 0.9695212, 0.2318297, 0.0792696, 0.199143, -0.5571717, -0.8061649]),
        ([25.7, 67.5, 259.9, -169.8, 100.0, -59.4], [87.734, 156.1519, -212.9642],
         [-0.3529827, -0.550196, -0.7567612, 0.7876326, 0.2618318, -0.5577446, 0.505013, -0.792924, 0.3409302]),
        ([93.1, -78.5, -299.7, -152.9, -84.5, -97.3], [-168.1248, -251.4626, 501.6426],
         [-0.9045722, 0.1028531, -0.4137274, 0.2718902, -0.6083013, -0.7456844, -0.3283669, -0.7870138, 0.5222877]),
        ([-156.7, -145.8, 206.9, -59.9, -10.5, 86.9], [716.1317, 354.5097, -486.0362],
         [-0.1821017, -0.3828322, 0.9056923, -0.5735811, 0.7894997, 0.2183918, -0.7986512, -0.4797184, -0.3633545]),
        ([-95.6, -16.4, 182.9, 160.4, 96.2, -129.4], [222.1402, 515.0145, 464.4286],
         [0.8079076, -0.4909295, 0.3259962, 0.5441215, 0.8338659, -0.0927326, -0.226312, 0.2523009, 0.9408119]),
    ],
    "crx10ia": [
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [700.0, -150.0, 540.0],
         [0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0]),
        ([-180.0, -123.4, -124.9, 141.5, 99.1, -145.7], [770.1195, -215.74, -702.072],
         [0.2628493, 0.7973373, 0.5432895, -0.5223542, 0.5910289, -0.6146795, -0.8112067, -0.1222215, 0.571844]),
        ([130.2, 4.4, 86.0, -13.4, -121.3, -159.5], [-68.0742, 257.5353, 982.4706],
         [0.6349152, -0.3965435, -0.6630504, -0.0488018, -0.8770981, 0.4778257, -0.7710389, -0.2710208, -0.576235]),
        ([-180.0, -51.5, -217.9, 107.3, 13.7, -106.4], [1052.4273, -80.786, 659.2452],
         [0.6655075, 0.1839446, 0.72337, -0.0233768, 0.973818, -0.2261238, -0.746025, 0.133577, 0.6523832]),
        ([-70.9, 176.9, 23.4, -80.4, 148.0, -122.3], [45.7198, -463.9659, -501.3965],
         [-0.3718946, -0.5331584, -0.7598924, -0.7223087, -0.347975, 0.5976484, -0.5830648, 0.7711391, -0.2556949]),
        ([14.7, 170.2, 138.4, 44.2, -87.2, -178.7], [-245.3638, -290.7291, -160.9374],
         [0.7473656, 0.2828223, 0.6012123, 0.1440528, 0.8143783, -0.5621715, -0.6486088, 0.506754, 0.567897]),
    ],
}  # fmt: skip
"""Six of the poses of mattj23/industrial-robots, which says that FANUC's controller shows them: J1 to J6 [°], x, y, z
[mm], and the rotation by rows."""


def turned(angles: tuple[float, ...], axes: str) -> Array:
    return np.asarray(Rotation.from_euler(axes, angles, degrees=True).as_matrix())


@pytest.mark.parametrize("axes", ROBODK, ids=str)
def test_an_irb_120_stands_where_robodk_shows_it(axes: tuple[float, ...]) -> None:
    """Within the three decimals that are shown."""
    xyz, zyx = ROBODK[axes]
    T = at_pendant("irb120_3_58", np.deg2rad(axes))
    assert np.abs(1000.0 * T[:3, 3] - xyz).max() < 1e-3
    assert np.abs(T[:3, :3] - turned(zyx, "ZYX")).max() < 2e-5


@pytest.mark.parametrize("axes", IRB4600_20, ids=str)
def test_an_irb_4600_moves_as_its_table_with_a_shorter_forearm(axes: tuple[float, ...]) -> None:
    given = table(catalogue.dh_table("irb4600_40_255"))
    lengths = (*(row.d for row in given.joints[:3]), 1.2305, 0.0, 0.085)
    shorter = replace(given, joints=tuple(replace(row, d=d) for row, d in zip(given.joints, lengths, strict=True)))
    T, (xyz, about) = shorter.pose(np.deg2rad(axes).tolist()), IRB4600_20[axes]
    assert np.abs(1000.0 * T[:3, 3] - xyz).max() < 0.01
    assert np.abs(T[:3, :3] - turned(about, "xyz")).max() < 2e-4


@pytest.mark.parametrize("name", MAKERS)
def test_a_kuka_stands_as_the_makers_description(name: str) -> None:
    for q in np.random.default_rng(4).uniform(-2.0, 2.0, (20, 6)):
        T = np.eye(4)
        for (xyz, rpy, axis), angle in zip(MAKERS[name], (*q, 0.0), strict=True):
            T = T @ pose(xyz, rpy)
            if axis:
                turn = np.eye(3)[abs(axis) - 1] * np.sign(axis) * angle
                T[:3, :3] = T[:3, :3] @ Rotation.from_rotvec(turn).as_matrix()
        np.testing.assert_allclose(at_pendant(name, q), T, atol=1e-9)


def at(name: str, q: Array) -> Array:
    """Pose of the flange in the base at the angles of the table, [rad]; shape (4, 4)."""
    T = np.eye(4)
    T[:3, 3], T[:3, :3] = (part[0] for part in chain_poses(robot(name).chain(None, None).flat, q[None]))
    return T


def in_the_library(name: str, shown: Array) -> Array:
    """Pose of the flange by RoboDK's parameters; shape (4, 4), [mm]."""
    one, T = LIBRARY[name], np.eye(4)
    for i, (alpha, a, d, theta) in enumerate(one["rows"]):
        angle = np.deg2rad(theta) + one["senses"][i] * shown[i] - (shown[i - 1] if i + 1 in one["held"] else 0.0)
        twist, step, turn = np.eye(4), np.eye(4), np.eye(4)
        twist[:3, :3], twist[0, 3] = turned((alpha,), "x"), a
        turn[:3, :3], step[2, 3] = Rotation.from_rotvec([0.0, 0.0, angle]).as_matrix(), d
        T = T @ twist @ turn @ step
    return T


@pytest.mark.quick(8)
@pytest.mark.parametrize("name", LIBRARY)
def test_an_arm_stands_as_in_robodks_library(name: str) -> None:
    """It turns alike. RoboDK has some lengths rounded, of Universal Robots to 5 mm at the flange."""
    near = 5.0 if name.startswith("ur") else {"lite6": 0.4, "xarm7_dh": 0.3}.get(name, 0.11)
    for q in np.random.default_rng(5).uniform(-2.0, 2.0, (20, len(LIBRARY[name]["rows"]))):
        T, expected = (at_pendant if name in CONTROLLED else at)(name, q), in_the_library(name, q)
        assert np.abs(T[:3, :3] - expected[:3, :3]).max() < 1e-9
        assert np.abs(1000.0 * T[:3, 3] - expected[:3, 3]).max() < near


@pytest.mark.parametrize("name", CRX)
def test_a_crx_stands_where_its_controller_shows_it(name: str) -> None:
    for axes, xyz, R in CRX[name]:
        T = at_pendant(name, np.deg2rad(axes))
        assert np.abs(1000.0 * T[:3, 3] - xyz).max() < 1e-3
        assert np.abs(T[:3, :3] - np.reshape(R, (3, 3))).max() < 1e-6


@pytest.mark.parametrize("name", CONTROLLED)
def test_the_source_says_which_are_verified(name: str) -> None:
    source, verified = catalogue.entry(name)["source"], name in LIBRARY
    assert ("senses and zeros of the pendant: verified" in source) == verified
    assert ("senses and zeros of the pendant: inferred" in source) == (not verified)
    assert ("SaltworkerMLU/robotkinematicscatalogue" in source) == verified


FRANKA = (
    [0.0167305, -0.762614, -0.0207622, -2.34352, -0.0305686, 1.53975, 0.753872],
    [
        [0.998578, 0.0335224, -0.04122, 0.305468],
        [0.0328747, -0.999317, -0.016294, -0.00814133],
        [-0.0417381, 0.0149157, -0.999017, 0.483198],
    ],
)
"""Angles and pose of the hand, by rows, of the state that Franka's documentation of its interface shows
(https://github.com/frankaemika/docs, source/getting_started.rst, commit 1da6bd33e7); the hand is turned by an eighth
turn and 103.4 mm beyond the flange."""


@pytest.mark.parametrize("name", ["panda_dh", "fr3"])
def test_a_franka_stands_where_its_documentation_shows_it(name: str) -> None:
    hand = pose([0.0, 0.0, 0.1034], [0.0, 0.0, -np.pi / 4.0])
    assert np.abs((at(name, np.array(FRANKA[0])) @ hand)[:3] - FRANKA[1]).max() < 1e-5


SHOWN: dict[str, Shown] = {
    "lite6": {(0, 0, 0, 0, 0, 0): ((87.0, 0.0, 154.2), (180.0, 0.0, 0.0))},
    "xarm6": {
        (0, 0, 0, 0, 0, 0): ((207.0, 0.0, 112.0), (180.0, 0.0, 0.0)),
        (90, -90, 90, -90, 90, -90): ((97.0, -207.0, -98.0), ()),
    },
    "xarm7_dh": {(0, 0, 0, 0, 0, 0, 0): ((206.0, 0.0, 120.5), (180.0, 0.0, 0.0))},
    "meca500": {
        (0, 0, 0, 0, 0, 0): ((190.0, 0.0, 308.0), (0.0, 90.0, 0.0)),
        (10, 0, 15, 0, -20, -50): ((192.51, 33.945, 281.748), (-63.26, 78.831, 13.697)),
        (15, 16, -14, 7, 37, 50): ((204.293, 60.055, 254.821), (-156.474, 47.04, -151.773)),
        (52, -13, -35, -38, 76, 91): ((77.768, 31.618, 357.916), (-147.977, 66.959, -149.095)),
        (46.287, 6.624, -5.171, 39.165, -59.322, 73.873): ((147.299, 99.049, 349.801), (-0.485, 49.179, 131.053)),
    },
}
"""Angles [°], x, y, z [mm] and turns about x, y, z [°], moving axes. Zero poses: as the makers' controllers show them,
by courses and programs that print them. The xArm 6 in another pose: https://github.com/viamrobotics/rdk,
referenceframe/frame_system_test.go. The Meca500 in others: the exercise of a course that has this arm."""


@pytest.mark.parametrize("name", SHOWN)
def test_an_arm_stands_where_others_show_it(name: str) -> None:
    for axes, (xyz, xyz_turns) in SHOWN[name].items():
        T = at(name, np.deg2rad(axes))
        assert np.abs(1000.0 * T[:3, 3] - xyz).max() < 2e-3
        if xyz_turns:
            assert np.abs(T[:3, :3] - turned(xyz_turns, "XYZ")).max() < 5e-5
