"""What a trajectory says of joints along a line holds for the exact line, whatever the tolerance of the motion."""

from collections.abc import Iterator
from itertools import count
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from scipy.spatial.transform import Rotation

from gelenk.main import create_app
from gelenk.settings import Settings
from tests.oracles.dh_columns import Array, Table
from tests.oracles.line_way import LAWS, line_way, of_joints

RATES = ("velocity", "acceleration", "jerk")
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
VELOCITY, ACCELERATION = np.array([3.0, 2.5]), np.array([5.0, 7.0])
BEGIN, END = np.radians([110.0, 140.0]), np.array([0.816, 1.4])


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with TestClient(create_app(Settings(data_dir=tmp_path_factory.mktemp("data")))) as service:
        yield service


def upload(client: TestClient, name: str, rows: Any) -> None:
    joints = [
        dict(zip(("a", "alpha", "d", "theta"), row, strict=True), type="prismatic" if slides else "revolute")
        for row, slides in rows
    ]
    answer = client.post("/v1/robots", json={"name": name, "dh": {"convention": "standard", "joints": joints}})
    assert answer.status_code == 201, answer.text


def two_links(u: float, _: Array) -> Array:
    """Of unit links, elbow as in the lectures: the law of cosines."""
    x, y = (1.0 - u) * np.array([np.cos(BEGIN[0]) + np.cos(BEGIN.sum()), 0.0]) + u * END
    second = np.arccos(0.5 * (x * x + y * y) - 1.0)
    return np.array([np.arctan2(y, x) - np.arctan2(np.sin(second), 1.0 + np.cos(second)), second])


@pytest.mark.slow
def test_the_lectures_scaling_of_a_line_is_that_of_the_exact_one(client: TestClient) -> None:
    """Two unit links, the cubic: k = 2.480316904599, from the accelerations."""
    upload(client, "two", [((1.0, 0.0, 0.0, 0.0), False)] * 2)
    velocities, accelerations, _ = of_joints(two_links, BEGIN).peaks("cubic")
    by_velocity = float((velocities / VELOCITY).max())
    by_acceleration = float((accelerations / ACCELERATION).max())
    assert by_acceleration**0.5 == pytest.approx(2.480316904599, abs=1e-10)
    target = {"position": [*END, 0.0], "quaternion_xyzw": [0, 0, 0, 1]}
    call = {"start": BEGIN.tolist(), "segments": [{"type": "line", "target": target}], "law": "cubic"}
    call |= {"task": ["x", "y"], "compare_timing": True, "tip_poses": False}
    call["limits"] = {"joint_velocity": VELOCITY.tolist(), "joint_acceleration": ACCELERATION.tolist()}
    for tolerance in TOLERANCES:
        told = client.post("/v1/robots/two/trajectory", json=call | {"path_tolerance": tolerance}).json()
        timing, stated = told["timing"][0], told["audit"]["way_error"]["acceleration"]
        assert abs(timing["acceleration_factor"] - by_acceleration) <= stated * by_acceleration
        assert stated <= 1e-5
        assert told["duration"] == pytest.approx(by_acceleration**0.5, rel=1e-6), tolerance
        assert timing["acceleration_factor"] == pytest.approx(by_acceleration, rel=2e-6)
        assert timing["velocity_factor"] == pytest.approx(by_velocity, rel=1e-6)


def random_arm(rng: np.random.Generator, kinds: str) -> Table:
    """Some tenths of a metre from joint to joint, and twists of whole and other right angles."""
    twists = rng.choice([0.0, 0.5 * np.pi, -0.5 * np.pi, float(rng.uniform(-np.pi, np.pi))], 6)
    lengths, offsets = rng.uniform(0.0, 0.5, (2, 6))
    rows = [(float(a), float(alpha), float(d), 0.0) for a, alpha, d in zip(lengths, twists, offsets, strict=True)]
    return Table(True, rows, [kind == "P" for kind in kinds])


def random_start(table: Table, rng: np.random.Generator) -> Array | None:
    """A configuration far from a singularity, if there are such."""
    for q in rng.uniform(-2.0, 2.0, (50, 6)) * np.where(table.slides, 0.2, 1.0):
        if np.linalg.svd(table.jacobian(q), compute_uv=False)[-1] > 0.15:
            return np.asarray(q, dtype=np.float64)
    return None


@pytest.mark.slow
@pytest.mark.parametrize("kinds", ["RRRRRR", "PRRRRR", "RRPRRR"])
def test_peaks_differ_from_those_of_the_exact_way_by_no_more_than_is_stated(client: TestClient, kinds: str) -> None:
    """Lines of random arms that shift and turn the tip, at any tolerance."""
    rng, done = np.random.default_rng(len(kinds.split("P", maxsplit=1)[0])), 0
    for number in count():
        table = random_arm(rng, kinds)
        start = random_start(table, rng)
        if start is None:
            continue
        shift, turn = rng.uniform(-0.15, 0.15, 3), rng.uniform(-0.3, 0.3, 3)
        try:
            way = line_way(table, start, shift, turn)
        except ArithmeticError:
            continue
        name = f"{kinds.lower()}-{number}"
        upload(client, name, zip(table.rows, table.slides, strict=True))
        T = table.pose(start)
        rotation = Rotation.from_rotvec(turn) * Rotation.from_matrix(T[:3, :3])
        target = {"position": (T[:3, 3] + shift).tolist(), "quaternion_xyzw": rotation.as_quat().tolist()}
        velocity, acceleration, jerk = (rng.uniform(0.5, 1.0, 6) * size for size in (2.0, 10.0, 200.0))
        limits = {"joint_velocity": velocity.tolist(), "joint_acceleration": acceleration.tolist()}
        limits["joint_jerk"] = jerk.tolist()
        law, tolerance = str(rng.choice(list(LAWS))), float(10.0 ** rng.uniform(-7.0, -3.0))
        call = {"start": start.tolist(), "segments": [{"type": "line", "target": target}], "law": law}
        call |= {"limits": limits, "path_tolerance": tolerance, "compare_timing": True, "tip_poses": False}
        told = client.post(f"/v1/robots/{name}/trajectory", json=call).json()
        if told.get("completed_fraction") != 1.0:  # A joint meets a limit that the oracle knows nothing of.
            continue
        judged, timing = told["audit"], told["timing"][0]
        exact = way.peaks(law, told["duration"])
        for quantity, peaks, limit in zip(RATES, exact, (velocity, acceleration, jerk), strict=True):
            off = abs(judged[quantity]["ratio"] - float((peaks / limit).max()))
            assert off <= judged["way_error"][quantity], (number, law, tolerance, quantity)
        for quantity, peaks, limit in zip(RATES[:2], way.peaks(law)[:2], (velocity, acceleration), strict=True):
            rel = 1e-5 + judged["way_error"][quantity] / judged[quantity]["ratio"]
            assert timing[f"{quantity}_factor"] == pytest.approx(float((peaks / limit).max()), rel=rel)
        done += 1
        if done == 4:
            break
