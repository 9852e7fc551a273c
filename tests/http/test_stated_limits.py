"""No audit passes above a limit that the request states: motions of all kinds, their polynomials evaluated by NumPy."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from scipy.spatial.transform import Rotation

from gelenk.main import create_app
from gelenk.settings import Settings
from tests.oracles.dh_columns import Array
from tests.oracles.tip_rates import tip_rates
from tests.oracles.urdf_product import UrdfProduct

ARMS = ("ur5", "panda", "tiago", "stanford", "kinova", "z1", "pr2", "talos_left_arm")
"""Two of them with a sliding joint."""
LAWS = ("cubic", "quintic", "septic", "trapezoidal", "jerk_limited", "time_optimal")
REFUSED = ("time_optimal", "timed")
"""Whoever says when leaves that law nothing to find."""
KINDS = ("joint", "waypoints", "timed", "past", "line", "circle", "spline", "blended", "slow_down", "several")
CASES = [(law, kind) for law, kind in product(LAWS, KINDS) if kind != "past" and (law, kind) != REFUSED]
JOINTS = ("joint_velocity", "joint_acceleration", "joint_jerk")
TIP = ("tip_velocity", "tip_angular_velocity", "tip_acceleration", "tip_angular_acceleration")
_EXCESS = 1e-6
_SAMPLES = 3000
"""Of each motion; at least some of each piece."""


@dataclass(frozen=True)
class Arm:
    """An arm, its joints' ranges, and where its tip is."""

    name: str
    joints: list[str]
    lower: Array
    upper: Array
    product: UrdfProduct
    base: str
    tip: str

    def poses(self, qs: Array) -> Array:
        """T_base_tip; shape (N, n) → (N, 4, 4)."""
        return self.product.poses(self.base, self.tip, dict(zip(self.joints, qs.T, strict=True)))


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with TestClient(create_app(Settings(data_dir=tmp_path_factory.mktemp("data")))) as service:
        yield service


def arm(client: TestClient, name: str) -> Arm:
    told = client.get(f"/v1/robots/{name}").json()
    product = UrdfProduct(client.get(f"/v1/robots/{name}/urdf").text)
    ends = told["default_chain"]
    shared = set(product.path(ends["base_frame"]))
    names = [joint for joint in product.variables(ends["tip_frame"]) if joint not in shared]
    joints = {joint["name"]: joint["limits"] or {} for joint in told["joints"]}
    ranges = [(joints[one].get("lower"), joints[one].get("upper")) for one in names]
    lower, upper = (
        np.array([default if one[end] is None else one[end] for one in ranges])
        for end, default in ((0, -np.pi), (1, np.pi))
    )
    return Arm(name, names, lower, upper, product, ends["base_frame"], ends["tip_frame"])


def some_limits(rng: np.random.Generator, names: list[str]) -> dict[str, Any]:
    """Some of them: of joints as a number, one each, or by name of some; of the tip."""
    limits: dict[str, Any] = {}
    for name, low, high in zip(JOINTS, (0.2, 0.5, 2.0), (1.5, 4.0, 40.0), strict=True):
        values = rng.uniform(low, high, len(names)).tolist()
        match int(rng.integers(5)):
            case 0:
                limits[name] = values[0]
            case 1:
                limits[name] = values
            case 2:
                limits[name] = {joint: value for joint, value in zip(names, values, strict=True) if rng.random() < 0.6}
    for name, low, high in zip(TIP, (0.03, 0.1, 0.1, 0.3), (0.3, 1.0, 2.0, 4.0), strict=True):
        if rng.random() < 0.3:
            limits[name] = float(rng.uniform(low, high))
    return limits


def some_options(rng: np.random.Generator, names: list[str]) -> dict[str, Any]:
    scales = {name: float(rng.uniform(0.2, 1.0)) for name in ("velocity_scale", "acceleration_scale")}
    options: dict[str, Any] = {name: scale for name, scale in scales.items() if rng.random() < 0.3}
    return options | ({"limits": some_limits(rng, names)} if rng.random() < 0.8 else {})


def some_pose(rng: np.random.Generator, T: Array, size: float) -> dict[str, Any]:
    turn = Rotation.from_rotvec(rng.uniform(-1.0, 1.0, 3) * size * 2.0) * Rotation.from_matrix(T[:3, :3])
    return {"position": (T[:3, 3] + rng.uniform(-size, size, 3)).tolist(), "quaternion_xyzw": turn.as_quat().tolist()}


def some_segments(rng: np.random.Generator, kind: str, start: Array, arm: Arm) -> list[dict[str, Any]]:
    """Of a kind: short ways of the tip, which mostly can be gone."""
    T, width = arm.poses(start[None])[0], np.minimum(arm.upper - arm.lower, 2.0)

    def configurations(count: int) -> list[list[float]]:
        rows = start + rng.uniform(-0.2, 0.2, (count, len(start))) * width
        return np.clip(rows, arm.lower, arm.upper).tolist()  # type: ignore[no-any-return]

    def poses(count: int, size: float = 0.08) -> list[dict[str, Any]]:
        return [some_pose(rng, T, size) for _ in range(count)]

    match kind:
        case "joint":
            return [{"type": "joint", "target": configurations(1)[0]}]
        case "waypoints":
            boundary = str(rng.choice(["clamped", "natural", "not_a_knot", "assigned"]))
            return [{"type": "spline", "waypoints": configurations(int(rng.integers(2, 5))), "boundary": boundary}]
        case "timed":
            times = np.cumsum(rng.uniform(3.0, 20.0, 3)).tolist()
            points = configurations(3) if rng.random() < 0.5 else poses(3)
            return [{"type": "spline", "waypoints": points, "times": times}]
        case "past":
            return [{"type": "spline", "waypoints": configurations(3), "blends": True}]
        case "circle":
            return [{"type": "circle", "via": poses(1)[0], "target": poses(1)[0]}]
        case "spline":
            return [{"type": "spline", "waypoints": poses(int(rng.integers(2, 6)))}]
        case "blended":
            ways = [(poses(2, 0.12), rng.random() < 0.3) for _ in range(int(rng.integers(2, 5)))]
            lines = [
                {"type": "circle", "via": via, "target": pose} if is_arc else {"type": "line", "target": pose}
                for (via, pose), is_arc in ways
            ]
            return [line | {"blend_radius": float(rng.uniform(0.002, 0.015))} for line in lines[:-1]] + lines[-1:]
        case "several":
            kinds = rng.choice(["joint", "line", "circle"], 3)
            return [segment for one in kinds for segment in some_segments(rng, str(one), start, arm)]
        case _:
            return [{"type": "line", "target": poses(1)[0]}]


def stated(options: list[dict[str, Any]], names: list[str]) -> dict[str, Array]:
    """The limits in force of what the trajectory, and then the segment, says; infinite where nothing is said."""
    found = {name: np.full(len(names), np.inf) for name in JOINTS} | {name: np.full(1, np.inf) for name in TIP}
    for one in options:
        for name, value in one.get("limits", {}).items():
            kept = dict(zip(names, found[name], strict=False))
            values = [value.get(joint, kept[joint]) for joint in names] if isinstance(value, dict) else value
            found[name] = np.broadcast_to(np.array(values, dtype=np.float64), found[name].shape)
    scales = {name: value for one in options for name, value in one.items() if name.endswith("_scale")}
    return {
        name: limit * scales.get("velocity_scale" if name.endswith("velocity") else "acceleration_scale", 1.0)
        for name, limit in found.items()
    }


def in_force(told: dict[str, Any], call: dict[str, Any], names: list[str], number: int) -> dict[str, Array]:
    """The limits on each piece of a segment: its own, and in blends those of the line on the other side too."""
    segments = told["segments"]
    breaks = np.array(segments[number]["polynomials"]["breaks"])
    index = segments[number]["index"]
    found = {
        name: np.tile(limits, (len(breaks) - 1, 1))
        for name, limits in stated([call, call["segments"][index]], names).items()
    }
    before = segments[number - 1]["blend"] if number else None
    for blend, other in ((segments[number]["blend"], index + 1), (before, index - 1)):
        if blend is not None:
            rows = (breaks[:-1] >= blend["start_time"] - 1e-9) & (breaks[1:] <= blend["end_time"] + 1e-9)
            for name, limits in stated([call, call["segments"][other]], names).items():
                found[name][rows] = np.minimum(found[name][rows], limits)
    return found


def largest_ratios(told: dict[str, Any], call: dict[str, Any], arm: Arm) -> dict[str, float]:
    """How near to each of the limits a motion comes, on a dense grid."""
    found = dict.fromkeys((*JOINTS, *TIP), 0.0)
    count = max(5, _SAMPLES // max(1, sum(len(one["polynomials"]["coefficients"]) for one in told["segments"])))
    nodes = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count))
    for number, segment in enumerate(told["segments"]):
        pieces = segment["polynomials"]
        if not pieces["coefficients"]:
            continue
        limits = in_force(told, call, arm.joints, number)
        c, widths = np.array(pieces["coefficients"]), np.diff(pieces["breaks"])
        t = (nodes[:, None] * widths)[:, :, None]
        q, *rates = (
            np.polynomial.polynomial.polyval(
                t, np.moveaxis(np.polynomial.polynomial.polyder(c, k, axis=1), 1, 0)[:, None], tensor=False
            )
            for k in range(4)
        )
        for name, values in zip(JOINTS, rates, strict=True):
            found[name] = max(found[name], float((np.abs(values) / limits[name]).max()))
        if any(np.isfinite(limits[name]).any() for name in TIP):
            rows = (values.reshape(-1, len(arm.joints)) for values in (q, *rates[:2]))
            for name, values in zip(TIP, tip_rates(arm.poses, *rows).T, strict=True):
                ratios = values.reshape(count, -1) / limits[name][:, 0]
                found[name] = max(found[name], float(ratios.max()))
    return found


def tried(client: TestClient, rng: np.random.Generator, one: Arm, law: str, kind: str) -> tuple[int, str]:
    """One motion: its status, and what it does beyond a stated limit."""
    share = rng.uniform(0.25, 0.75, len(one.joints))
    start = one.lower + share * (one.upper - one.lower)
    segments = [one_ | some_options(rng, one.joints) for one_ in some_segments(rng, kind, start, one)]
    call = {"start": start.tolist(), "segments": segments, "law": "trapezoidal" if kind == "past" else law}
    call |= some_options(rng, one.joints) | {"coefficients": True, "tip_poses": False, "sample_period": 1.0}
    if kind == "slow_down":
        call |= {"near_singularity": "slow_down", "law_fallback": True}
    answer = client.post(f"/v1/robots/{one.name}/trajectory", json=call)
    if answer.status_code == 200 and rng.random() < 0.2 and kind != "timed":
        call["duration"] = answer.json()["duration"] * float(rng.uniform(1.0, 1.5))
        answer = client.post(f"/v1/robots/{one.name}/trajectory", json=call)
    if answer.status_code != 200:
        return answer.status_code, answer.json()["detail"]
    told = answer.json()
    ratios = largest_ratios(told, call, one)
    beyond = {name: ratio for name, ratio in ratios.items() if ratio > 1.0 + _EXCESS}
    return 200, f"{beyond}" if beyond and told["audit"]["passed"] else ""


@pytest.mark.quick(1)
@pytest.mark.parametrize(("law", "kind"), CASES)
@pytest.mark.parametrize("motions", [1, pytest.param(6, marks=pytest.mark.slow)])
def test_no_audit_passes_above_a_limit_that_the_request_states(
    client: TestClient, law: str, kind: str, motions: int
) -> None:
    """Of joint point-to-point, splines with and without times, lines, arcs, blended chains, and several in a row."""
    found = []
    for number in range(motions):
        rng = np.random.default_rng([motions, number, LAWS.index(law), KINDS.index(kind)])
        one = arm(client, ARMS[(number + LAWS.index(law) + KINDS.index(kind)) % len(ARMS)])
        status, beyond = tried(client, rng, one, law, kind)
        assert status in {200, 413, 422}, (number, one.name, beyond)
        assert status != 200 or not beyond, (number, one.name, beyond)
        found.append(status)
    assert found.count(200) >= 0.3 * motions - 1


@pytest.mark.slow
@pytest.mark.parametrize("motions", [4, pytest.param(40, marks=pytest.mark.slow)])
def test_no_audit_passes_above_a_stated_limit_past_waypoints(client: TestClient, motions: int) -> None:
    for number in range(motions):
        one = arm(client, ARMS[number % len(ARMS)])
        status, beyond = tried(client, np.random.default_rng([motions, number]), one, "trapezoidal", "past")
        assert (status, beyond) == (200, ""), (number, one.name)


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
def test_limits_of_a_line_that_is_not_reached_do_no_harm(client: TestClient, law: str) -> None:
    """The first of two blended lines leads out of reach; the second alone has a limit of the tip."""
    start = [0.0, -1.2, 1.6, -0.4, 1.2, 0.0]
    pose = client.post("/v1/robots/ur5/fk", json={"joint_positions": [start]}).json()["poses"][0]
    x, y, z = pose["position"]
    far, back = ({**pose, "position": place} for place in ([x, y, z + 3.0], [x + 0.1, y, z + 2.0]))
    limited = {"type": "line", "target": back, "limits": {"tip_velocity": 0.05}}
    lines = [{"type": "line", "target": far, "blend_radius": 0.01}, limited]
    answer = client.post("/v1/robots/ur5/trajectory", json={"start": start, "segments": lines, "law": law})
    assert answer.status_code == 200, answer.text
    assert answer.json()["failure"]["segment"] == 0
