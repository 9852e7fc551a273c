"""Motions for a robot's controller, each read back by an interpreter of its own: ROS messages, and URScript."""

import re
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.interpolate import BPoly
from scipy.spatial.transform import Rotation
from starlette.testclient import TestClient

from tests.robots import robot

UR = "/v1/robots/ur5/trajectory"
START = [0.0, -1.2, 1.6, -0.4, 1.2, 0.0]
TARGET = [0.3, -1.0, 1.4, -0.5, 1.0, 0.2]
NEXT = {"type": "joint", "target": TARGET}


def corner(client: TestClient, **more: Any) -> dict[str, Any]:
    """A joint move, a line blended into the next, and that one."""
    pose = client.post("/v1/robots/ur5/fk", json={"joint_positions": [TARGET]}).json()["poses"][0]
    x, y, z = pose["position"]
    first = {"type": "line", "target": {**pose, "position": [x, y + 0.1, z]}, "blend_radius": 0.02}
    second = {"type": "line", "target": {**pose, "position": [x, y + 0.1, z + 0.1]}}
    return {"start": START, "segments": [NEXT, first, second], "law": "trapezoidal", "sample_period": 0.008, **more}


class Program:
    """What a URScript program of moves and streamed joints does; anything else in it is an error."""

    def __init__(self, text: str) -> None:
        self.functions: dict[str, list[tuple[str, Any, dict[str, float]]]] = {}
        self.called: list[str] = []
        inside: str | None = None
        for line in (line.partition("#")[0].strip() for line in text.splitlines()):
            if define := re.fullmatch(r"def (\w+)\(\):", line):
                inside = define[1]
                self.functions[inside] = []
            elif line == "end":
                inside = None
            elif line and inside is not None:
                self.functions[inside].append(self._command(line))
            elif line:
                self.called.append(line)

    @staticmethod
    def _command(line: str) -> tuple[str, Any, dict[str, float]]:
        command = re.fullmatch(r"(servoj|movej|movel|stopj)\((?:p?\[([^\]]*)\]|([\d.]+))(?:, (.*))?\)", line)
        assert command, line
        name, row, number, rest = command.groups()
        values = [float(word) for word in row.split(",")] if row else float(number)
        options = dict(part.split("=") for part in rest.split(", ")) if rest else {}
        return name, values, {key: float(value) for key, value in options.items()}

    def streamed(self) -> tuple[list[float], list[list[float]]]:
        """Times and joint angles that `servoj` asks for, from the start on."""
        (_, start, _), *stream, (last, *_) = self.functions["gelenk"]
        assert last == "stopj"
        times, rows = [0.0], [start]
        for name, row, options in stream:
            assert name == "servoj"
            times.append(times[-1] + options["t"])
            rows.append(row)
        return times, rows


def test_a_streamed_program_asks_for_every_sample(client: TestClient) -> None:
    call = corner(client)
    answer = client.post(UR, json=call).json()
    program = client.post(f"{UR}?format=urscript", json=call)
    assert program.status_code == 200, program.text
    assert program.headers["content-type"].startswith("text/x-urscript")
    assert answer["segments"][1]["blend"] is not None
    read = Program(program.text)
    assert read.called == ["gelenk()"]
    times, rows = read.streamed()
    np.testing.assert_allclose(times, answer["times"], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(rows, answer["joint_positions"], rtol=0.0, atol=1e-6)
    assert "not run on a robot" in program.text
    assert "Radians" in program.text


def test_moves_are_those_that_were_asked_for(client: TestClient) -> None:
    call = corner(client)
    answer = client.post(UR, json=call).json()
    moves = Program(client.post(f"{UR}?format=urscript", json=call).text).functions["gelenk_moves"]
    segments: list[dict[str, Any]] = call["segments"]
    assert [name for name, *_ in moves] == ["movej", "movej", "movel", "movel"]
    np.testing.assert_allclose(moves[1][1], TARGET, rtol=0.0, atol=1e-9)
    half = Rotation.from_euler("z", np.pi)  # of the controller's base, as the description has it
    for (_, place, _), segment in zip(moves[2:], segments[1:], strict=True):
        np.testing.assert_allclose(place[:3], half.apply(segment["target"]["position"]), rtol=0.0, atol=1e-9)
        turn = Rotation.from_rotvec(place[3:]).inv() * half * Rotation.from_quat(segment["target"]["quaternion_xyzw"])
        assert turn.magnitude() < 1e-9
    assert [move[2]["r"] for move in moves[2:]] == pytest.approx([answer["segments"][1]["blend"]["radius"], 0.0])
    first = answer["segments"][0]
    speed, acceleration = moves[1][2]["v"], moves[1][2]["a"]
    largest = np.abs(np.subtract(TARGET, START)).max()  # of a trapezoid: q = v (T - v/a)
    assert speed * (first["end_time"] - speed / acceleration) == pytest.approx(largest, rel=1e-6)


@pytest.mark.parametrize("change", [{"law": "quintic"}, {"task": ["x", "y", "z"]}])
def test_other_motions_are_streamed_alone(client: TestClient, change: dict[str, Any]) -> None:
    text = client.post(f"{UR}?format=urscript", json=corner(client, **change)).text
    assert set(Program(text).functions) == {"gelenk"}


def test_ros_reads_the_message_as_it_was_planned(client: TestClient) -> None:
    """Quintic pieces between points, as ROS's controller interpolates, are the motion where it has no jumps."""
    call = {**corner(client), "segments": [NEXT], "law": "quintic", "sample_period": 0.02}
    answer = client.post(UR, json=call).json()
    message = client.post(f"{UR}?format=joint_trajectory", json=call).json()
    text = client.post(f"{UR}?format=joint_trajectory", json=call, headers={"Accept": "application/yaml"})
    assert text.headers["content-type"].startswith("application/yaml")
    assert yaml.safe_load(text.text) == message
    assert "not run on a robot" in text.text
    assert message["joint_names"] == answer["joint_names"]
    assert message["header"]["frame_id"] == answer["base_frame"]
    stamps = [point["time_from_start"] for point in message["points"]]
    times = np.array([stamp["sec"] + 1e-9 * stamp["nanosec"] for stamp in stamps])
    np.testing.assert_allclose(times, answer["times"], rtol=0.0, atol=1e-9)
    rates = np.array([[p["positions"], p["velocities"], p["accelerations"]] for p in message["points"]])
    between = 0.5 * (times[:-1] + times[1:])
    finer = client.post(UR, json={**call, "sample_period": 0.01}).json()
    np.testing.assert_allclose(rates[:, 0], answer["joint_positions"], rtol=0.0, atol=1e-6)
    expected = np.array(finer["joint_positions"])[1::2][: len(between) - 1]
    found = BPoly.from_derivatives(times, rates)(between)[: len(between) - 1]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-6)


def test_small_numbers_are_numbers_in_yaml(client: TestClient) -> None:
    call = {**corner(client), "segments": [{"type": "joint", "target": [1e-7, *START[1:]]}], "sample_period": 1e-3}
    text = client.post(f"{UR}?format=joint_trajectory", json=call, headers={"Accept": "application/yaml"}).text
    numbers = [value for point in yaml.safe_load(text)["points"] for value in point["positions"]]
    assert all(isinstance(value, float) for value in numbers)


def test_what_a_format_cannot_hold_is_refused(client: TestClient) -> None:
    chain = robot("panda").chain(None, None)
    call = {"start": (0.5 * (chain.lower + chain.upper)).tolist(), "segments": []}
    call["segments"] = [{"type": "joint", "target": (np.array(call["start"]) + 0.1).tolist()}]
    refused = client.post("/v1/robots/panda/trajectory?format=urscript", json=call)
    assert (refused.status_code, refused.json()["field"]) == (422, "format")
    assert "6 turning joints" in refused.json()["detail"]
    for query, field in (("format=gcode", "format"), ("law=cubic", "query"), ("format=csv&format=npy", "query")):
        refused = client.post(f"{UR}?{query}", json=corner(client))
        assert (refused.status_code, refused.json()["field"]) == (422, field)
    later = client.post(f"{UR}?format=urscript", json=corner(client), headers={"Prefer": "respond-async"})
    assert (later.status_code, later.json()["field"]) == (422, "format")


def test_known_forms_have_names_too(client: TestClient) -> None:
    answers = [client.post(f"{UR}?format={name}", json=corner(client)) for name in ("csv", "npy", "json")]
    kinds = [answer.headers["content-type"].partition(";")[0] for answer in answers]
    assert kinds == ["text/csv", "application/x-npy", "application/json"]
