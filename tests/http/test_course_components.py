"""Motor, gear, pulse width modulation and encoder over HTTP: the lecture's numbers, and what is refused."""

import json
import time
from math import degrees, radians
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.common import Answer
from gelenk.contract.dc_motor import DcMotorAnswer
from gelenk.contract.encoder import EncoderAnswer
from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.gear import GearAnswer
from gelenk.contract.pulse_width_modulation import PwmAnswer
from tests.speed import is_within

EXAMPLE_MOTOR = BY_NAME["dc_motor"].example
EXAMPLE_ENCODER = BY_NAME["encoder"].example
EXAMPLE_GEAR = BY_NAME["gear"].example
EXAMPLE_PWM = BY_NAME["pulse_width_modulation"].example

ANSWERS: dict[str, type[Answer]] = {
    "dc-motor": DcMotorAnswer,
    "gear": GearAnswer,
    "pwm": PwmAnswer,
    "encoder": EncoderAnswer,
}
EXAMPLES = {"dc-motor": EXAMPLE_MOTOR, "gear": EXAMPLE_GEAR, "pwm": EXAMPLE_PWM, "encoder": EXAMPLE_ENCODER}
ABSOLUTE = {"type": "absolute", "bits": 3}


def good(client: TestClient, call: str, body: dict[str, Any]) -> Any:
    answer = client.post(f"/v1/course/{call}", json=body)
    assert answer.status_code == 200, answer.text
    ANSWERS[call].model_validate_json(answer.content)
    return answer.json()


def changed(call: str, **fields: Any) -> dict[str, Any]:
    """The example of a call with other fields; None takes one away."""
    return {key: value for key, value in {**EXAMPLES[call], **fields}.items() if value is not None}


# The lecture's numbers


def test_the_motor_of_the_lecture(client: TestClient) -> None:
    content = good(client, "dc-motor", EXAMPLE_MOTOR)
    assert content["steady_state"]["angular_velocity"] == pytest.approx(412.213740458, abs=5e-10)
    assert content["steady_state"]["regime"] == "motoring"
    assert content["torque_speed_line"]["no_load_angular_velocity"] == pytest.approx(458.015267176, abs=5e-10)
    poles = content["dynamics"]["poles"]
    assert [pole["real"] for pole in poles] == pytest.approx([-11.113246024, -589.386753976], abs=5e-10)
    assert [pole["imaginary"] for pole in poles] == [0.0, 0.0]
    at = content["response"]["times"].index(0.02)
    assert content["response"]["currents"][at] == pytest.approx(17.135013700, abs=5e-10)
    assert content["response"]["angular_velocities"][at] == pytest.approx(75.117516718, abs=5e-10)
    assert content["certificate"]["samples"] == 4
    assert abs(content["certificate"]["voltage_residual"]) < 1e-12
    assert abs(content["certificate"]["torque_residual"]) < 1e-14
    assert content["certificate"]["max_current_difference"] < 1e-9
    assert content["certificate"]["max_angular_velocity_difference"] < 1e-9
    assert content["warnings"] == []
    assert "412.2137405" in json.dumps(content["steps"])


def test_without_times_there_is_no_response(client: TestClient) -> None:
    content = good(client, "dc-motor", changed("dc-motor", times=None))
    assert content["response"] is None
    assert content["certificate"]["samples"] == 0
    assert content["certificate"]["max_current_difference"] is None


def test_a_duration_is_sampled_evenly(client: TestClient) -> None:
    content = good(client, "dc-motor", changed("dc-motor", times=None, duration=0.5))
    np.testing.assert_allclose(content["response"]["times"], np.linspace(0.0, 0.5, 101))
    content = good(client, "dc-motor", changed("dc-motor", times=None, duration=0.5, samples=10_000))
    assert len(content["response"]["currents"]) == 10_000
    assert content["certificate"]["samples"] == 16


def test_motors_at_the_edge(client: TestClient) -> None:
    backwards = good(client, "dc-motor", changed("dc-motor", load_torque=1.5))
    assert backwards["steady_state"]["regime"] == "driven_backwards"
    assert backwards["steady_state"]["angular_velocity"] < 0.0
    assert "stall torque" in backwards["warnings"][0]
    negative = good(client, "dc-motor", changed("dc-motor", voltage=-24.0, load_torque=-0.1))
    assert negative["steady_state"]["angular_velocity"] == pytest.approx(-412.213740458)
    bare = good(client, "dc-motor", changed("dc-motor", inductance=0.0))
    assert bare["dynamics"]["damping"] == "first_order"
    assert bare["dynamics"]["time_constants"] == [bare["dynamics"]["mechanical_time_constant"]]
    assert bare["response"]["currents"][0] == pytest.approx(20.0), "without inductance the stall current flows at once"
    two = good(client, "dc-motor", changed("dc-motor", back_emf_constant=0.04, load_torque=0.02))
    assert "differ" in two["warnings"][0]
    assert two["steady_state"]["efficiency"] is None
    swinging = good(client, "dc-motor", changed("dc-motor", inductance=0.05))
    assert swinging["dynamics"]["damping"] == "underdamped"
    assert swinging["dynamics"]["poles"][0]["imaginary"] > 0.0


def test_the_gear_of_the_lecture(client: TestClient) -> None:
    content = good(client, "gear", EXAMPLE_GEAR)
    assert content["load"]["torque"] == pytest.approx(80.0)
    assert content["load"]["angular_velocity"] == pytest.approx(4.580152672, abs=5e-10)
    assert content["inertia"]["at_load"] == pytest.approx(5.0)
    assert content["inertia"]["at_motor"] == pytest.approx(5e-4)
    assert content["inertia"]["optimal_ratio"] == pytest.approx(122.474487139, abs=5e-10)
    assert content["power_loss"] == pytest.approx(0.2 * content["motor"]["power"])
    assert content["back_driving"]["efficiency"] == pytest.approx(0.75)


def test_a_gear_from_the_load_and_one_that_locks_itself(client: TestClient) -> None:
    content = good(
        client, "gear", {"ratio": 50.0, "efficiency": 0.4, "load_angular_velocity": -2.0, "load_torque": 10.0}
    )
    assert content["power_flow"] == "load_to_motor"
    assert content["motor"]["angular_velocity"] == pytest.approx(-100.0)
    assert content["motor"]["torque"] == pytest.approx(10.0 / 50.0 * (2.0 - 1.0 / 0.4))
    assert content["power_loss"] > 0.0
    assert content["back_driving"]["self_locking"]
    assert content["back_driving"]["efficiency"] is None
    alone = good(client, "gear", {"ratio": 50.0})
    assert (alone["motor"]["power"], alone["inertia"], alone["power_flow"]) == (None, None, "none")


def test_the_pulses_of_the_lecture(client: TestClient) -> None:
    content = good(client, "pwm", EXAMPLE_PWM)
    assert content["average_voltage"] == pytest.approx(8.4)
    assert content["rms_voltage"] == pytest.approx(14.198591479, abs=5e-10)
    assert content["on_time"] == pytest.approx(17.5e-6)
    assert content["approximate_ripple"] == pytest.approx(0.1365)
    assert content["current"]["lowest"] == pytest.approx(6.931853537, abs=5e-10)
    assert content["current"]["highest"] == pytest.approx(7.068351208, abs=5e-10)
    assert content["current"]["ripple"] == pytest.approx(0.136497671, abs=5e-10)
    assert content["current"]["closing_error"] < 1e-12


def test_the_duty_for_a_voltage_and_for_a_speed(client: TestClient) -> None:
    wanted = good(client, "pwm", changed("pwm", duty=None, average_voltage=-8.4))
    assert (wanted["duty"], wanted["direction"], wanted["needs_h_bridge"]) == (pytest.approx(0.35), -1, True)
    assert wanted["average_voltage"] == pytest.approx(-8.4)
    assert "H-bridge" in wanted["warnings"][0]
    motor = {"torque_constant": 0.05, "viscous_friction": 1e-4, "load_torque": 0.1}
    speed = good(client, "pwm", changed("pwm", duty=None, angular_velocity=200.0, **motor))
    assert speed["duty"] == pytest.approx(0.536666667, abs=5e-10)
    assert speed["current"]["average"] == pytest.approx(0.12 / 0.05), "the back-EMF of the speed is taken off"
    assert "0.12" not in speed["steps"][0]["title"]
    assert "12.88" in json.dumps(speed["steps"][0])
    zero = good(client, "pwm", changed("pwm", duty=None, average_voltage=0.0, resistance=None))
    assert (zero["duty"], zero["direction"], zero["current"]) == (0.0, 1, None)


def test_the_back_emf_of_a_wanted_speed_may_be_given_if_it_is_that(client: TestClient) -> None:
    motor = {"duty": None, "torque_constant": 0.05, "angular_velocity": 10.0}
    bodies = [changed("pwm", **motor, back_emf=back_emf) for back_emf in (None, 0.5, 0.5000001)]
    currents = [good(client, "pwm", body)["current"] for body in bodies]
    assert currents[0] == currents[1] == currents[2]
    pushed = good(client, "pwm", changed("pwm", back_emf=3.0))
    assert pushed["current"]["average"] == pytest.approx((8.4 - 3.0) / 1.2), "with a duty it is anything"


def test_the_lines_of_an_encoder_that_is_looked_for_follow_from_the_decoding(client: TestClient) -> None:
    body = {"type": "absolute", "wanted_resolution": 0.01}
    lines = [
        good(client, "encoder", {**body, "decoding": d})["required"]["pulses_per_revolution"] for d in ("x1", "x4")
    ]
    assert lines == [629, 158]


def test_the_incremental_encoder_of_the_lecture(client: TestClient) -> None:
    content = good(client, "encoder", EXAMPLE_ENCODER)
    assert degrees(content["resolution"]["motor"]) == pytest.approx(0.087890625)
    assert degrees(content["resolution"]["load"]) == pytest.approx(0.0017578125)
    assert content["resolution"]["motor_velocity_quantum"] == pytest.approx(1.533980788, abs=5e-10)
    assert content["quadrature"]["counts"] == [0, 1, 2, 3, 4, 5, 6, 5]
    assert content["quadrature"]["direction"] == "forward"
    assert content["quadrature"]["motor_angle"] == pytest.approx(5 * content["resolution"]["motor"])


def test_the_encoder_of_the_exam(client: TestClient) -> None:
    """De Luca, 16-11-2018."""
    body = {"type": "absolute", "gear_ratio": 128.0, "wanted_resolution": radians(1e-3)}
    needed = good(client, "encoder", {**body, "motor_angular_velocity": 402.1239})["required"]
    assert (needed["counts_per_revolution"], needed["bits"], needed["pulses_per_revolution"]) == (2813, 12, 704)
    assert needed["count_rate"] == pytest.approx(180032.018, abs=5e-4)
    fine = good(client, "encoder", {"type": "absolute", "wanted_resolution": radians(0.01)})
    assert fine["required"]["bits"] == 16
    assert (fine["resolution"], fine["absolute"], fine["quadrature"]) == (None, None, None)


def test_an_absolute_encoder(client: TestClient) -> None:
    body = {**ABSOLUTE, "readings": ["100", "000", "001"], "values": [4], "table": True, "gear_ratio": 2.0}
    content = good(client, "encoder", body)
    assert [row["gray"] for row in content["absolute"]["table"]] == [
        *("000", "001", "011", "010"),
        *("110", "111", "101", "100"),
    ]
    assert [reading["value"] for reading in content["absolute"]["readings"]] == [7, 0, 1]
    assert content["absolute"]["unwrapped"] == [7, 8, 9]
    assert content["absolute"]["motor_travel"] == pytest.approx(2.0 * content["resolution"]["motor"])
    assert content["absolute"]["load_travel"] == pytest.approx(content["resolution"]["motor"])
    assert content["absolute"]["values"][0]["gray"] == "110"
    assert degrees(good(client, "encoder", {"type": "absolute", "bits": 13})["resolution"]["motor"]) == pytest.approx(
        0.043945312, abs=1e-9
    )


def test_samples_with_an_index_and_a_counter_that_begins_again(client: TestClient) -> None:
    body = {"type": "incremental", "pulses_per_revolution": 1, "counter_bits": 2}
    turn = "101 110 010 000 "
    content = good(client, "encoder", {**body, "samples": turn * 3 + "100 010"})["quadrature"]
    assert [pulse["count"] for pulse in content["index_pulses"]] == [0, 4, 8]
    assert [pulse["count_error"] for pulse in content["index_pulses"]] == [0, 0, 0]
    assert content["illegal_transitions"] == [13]
    assert (content["count"], content["register_value"], content["count_from_index"]) == (12, 0, 4)
    assert content["motor_angle_in_turn"] == 0.0
    backward = good(client, "encoder", {**body, "samples": "000 010"})["quadrature"]
    assert (backward["count"], backward["register_value"], backward["direction"]) == (-1, 3, "backward")
    assert degrees(backward["motor_angle_in_turn"]) == pytest.approx(270.0)
    unknown = good(client, "encoder", {"type": "incremental", "samples": "00 10"})
    assert (unknown["quadrature"]["count"], unknown["quadrature"]["motor_angle"]) == (1, None)


def test_a_hundred_thousand_samples(client: TestClient) -> None:
    body = changed("encoder", samples="00 10 11 01 " * 25_000)
    started = time.perf_counter()
    content = good(client, "encoder", body)
    assert is_within(time.perf_counter() - started, 2.0)
    assert content["quadrature"]["count"] == 99_999


# What is refused

REFUSED = [
    *(("dc-motor", {"resistance": value}, "resistance") for value in (0.0, -1.2, 1e-300, 1e300)),
    *(("dc-motor", {"inertia": value}, "inertia") for value in (0.0, -1.0, 1e300)),
    *(("dc-motor", {"inductance": value}, "inductance") for value in (-1e-3, 1e-300, 1e300)),
    *(("dc-motor", {"torque_constant": value}, "torque_constant") for value in (0.0, -0.05, 1e300)),
    ("dc-motor", {"back_emf_constant": 0.0}, "back_emf_constant"),
    ("dc-motor", {"viscous_friction": -1e-4}, "viscous_friction"),
    ("dc-motor", {"voltage": 1e300}, "voltage"),
    ("dc-motor", {"voltage": "24"}, "voltage"),
    ("dc-motor", {"load_torque": -1e300}, "load_torque"),
    ("dc-motor", {"times": [0.0, -1.0]}, "times"),
    ("dc-motor", {"times": [1e300]}, "times"),
    ("dc-motor", {"times": []}, "times"),
    ("dc-motor", {"times": [0.0] * 10_001}, "times"),
    ("dc-motor", {"duration": 1.0}, "duration"),
    ("dc-motor", {"times": None, "duration": 0.0}, "duration"),
    ("dc-motor", {"times": None, "duration": 1.0, "samples": 10_001}, "samples"),
    ("dc-motor", {"times": None, "samples": 5}, "samples"),
    ("dc-motor", {"inductance": 0.0, "initial_current": 1.0}, "initial_current"),
    ("dc-motor", {"unit": "SI"}, "unit"),
    *(("gear", {"ratio": value}, "ratio") for value in (0.0, -100.0, 1e300, 1e-300)),
    *(("gear", {"efficiency": value}, "efficiency") for value in (0.0, 1.1, -0.5, 5e-324)),
    ("gear", {"load_torque": 1.0}, "load_torque"),
    ("gear", {"load_angular_velocity": 1.0}, "load_angular_velocity"),
    ("gear", {"load_inertia": None}, "load_inertia"),
    ("gear", {"motor_inertia": None}, "motor_inertia"),
    ("gear", {"motor_inertia": 0.0}, "motor_inertia"),
    ("gear", {"motor_torque": 1e300}, "motor_torque"),
    *(("pwm", {"duty": value}, "duty") for value in (-0.01, 1.01, 1e300)),
    *(("pwm", {"frequency": value}, "frequency") for value in (0.0, -20e3, 1e300, 1e-300)),
    *(("pwm", {"supply_voltage": value}, "supply_voltage") for value in (0.0, -24.0, 1e300)),
    *(("pwm", {"resistance": value}, "resistance") for value in (0.0, -1.0)),
    ("pwm", {"inductance": -1.0}, "inductance"),
    ("pwm", {"duty": None}, "duty"),
    ("pwm", {"average_voltage": 5.0}, "average_voltage"),
    ("pwm", {"duty": None, "average_voltage": 24.1}, "average_voltage"),
    ("pwm", {"duty": None, "average_voltage": -24.1}, "average_voltage"),
    ("pwm", {"duty": None, "angular_velocity": 200.0}, "torque_constant"),
    ("pwm", {"duty": None, "angular_velocity": 200.0, "torque_constant": 0.05, "resistance": None}, "resistance"),
    ("pwm", {"duty": None, "angular_velocity": 500.0, "torque_constant": 0.05}, "angular_velocity"),
    *(("pwm", {"duty": None, "angular_velocity": speed, "torque_constant": 0.05, "back_emf": back_emf}, "back_emf")
      for speed, back_emf in ((10.0, 3.0), (10.0, -0.5), (10.0, 0.0), (0.0, 1e-9), (10.0, 0.50001))),
    ("pwm", {"load_torque": 0.1}, "load_torque"),
    ("encoder", {"decoding": "x3"}, "decoding"),
    ("encoder", {"type": "optical"}, "type"),
    ("encoder", {"type": None}, "type"),
    *(("encoder", {"pulses_per_revolution": value}, "pulses_per_revolution") for value in (0, -1, 1e300, 2.5, 10**30)),
    *(("encoder", {"gear_ratio": value}, "gear_ratio") for value in (0.0, -1.0, 1e300)),
    *(("encoder", {"sample_period": value}, "sample_period") for value in (0.0, 1e-300)),
    *(("encoder", {"wanted_resolution": value}, "wanted_resolution") for value in (0.0, -1.0, 1e-300, 7.0)),
    *(("encoder", {"samples": value}, "samples") for value in ("00 1a", "0 1", "", "00 2", "00 101", "\0")),
    ("encoder", {"samples": "0" * 300_001}, "samples"),
    ("encoder", {"counter_bits": 0}, "counter_bits"),
    ("encoder", {"counter_bits": 8, "samples": None}, "counter_bits"),
    ("encoder", {"bits": 12}, "bits"),
    ("encoder", {"table": True}, "table"),
    ("encoder", {"code": "gray"}, "code"),
    ("encoder", {"code": "binary"}, "code"),
    ("encoder", {"pulses_per_revolution": None, "samples": None}, "pulses_per_revolution"),
    ("encoder", {"pulses_per_revolution": None}, "sample_period"),
]  # fmt: skip
REFUSED_ABSOLUTE = [
    ({"bits": 0}, "bits"),
    ({"bits": 33}, "bits"),
    ({"bits": None}, "bits"),
    ({"bits": None, "wanted_resolution": 0.1, "readings": ["000"]}, "readings"),
    ({"bits": None, "wanted_resolution": 0.1, "table": True}, "table"),
    ({"readings": ["000", "0a0"]}, "readings/1"),
    ({"readings": ["0000"]}, "readings/0"),
    ({"readings": ["000", 1]}, "readings/1"),
    ({"readings": ["0" * 100]}, "readings/0"),
    ({"readings": ["000"] * 10_001}, "readings"),
    ({"values": [7, 8]}, "values/1"),
    ({"values": [-1]}, "values/0"),
    ({"values": [1e300]}, "values/0"),
    ({"bits": 9, "table": True}, "table"),
    ({"code": "bcd"}, "code"),
    ({"samples": "00 10"}, "samples"),
    ({"pulses_per_revolution": 5}, "pulses_per_revolution"),
    ({"counter_bits": 5}, "counter_bits"),
    ({"decoding": "x4"}, "decoding"),
    ({"decoding": "x1"}, "decoding"),
]


def refuse(client: TestClient, call: str, body: dict[str, Any], field: str) -> None:
    started, by_the_clock = time.process_time(), time.monotonic()
    answer = client.post(f"/v1/course/{call}", json=body)
    assert is_within(time.process_time() - started, 1.0)
    assert time.monotonic() - by_the_clock < 20.0, "it comes from another process, or waits"
    assert answer.status_code == 422, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert len(answer.content) < 16 * 1024
    problem = answer.json()
    pointers = [problem["pointer"]] if "pointer" in problem else [place["pointer"] for place in problem["errors"]]
    assert pointers[0].startswith(f"#/{field}"), problem


@pytest.mark.parametrize(("call", "fields", "field"), REFUSED, ids=[f"{c} {str(f)[:60]}" for c, f, _ in REFUSED])
def test_a_field_that_cannot_be_is_named(client: TestClient, call: str, fields: dict[str, Any], field: str) -> None:
    refuse(client, call, changed(call, **fields), field)


@pytest.mark.parametrize(("fields", "field"), REFUSED_ABSOLUTE, ids=[str(f)[:60] for f, _ in REFUSED_ABSOLUTE])
def test_a_field_of_an_absolute_encoder_that_cannot_be_is_named(
    client: TestClient, fields: dict[str, Any], field: str
) -> None:
    body = {key: value for key, value in {**ABSOLUTE, **fields}.items() if value is not None}
    refuse(client, "encoder", body, field)


@pytest.mark.quick(1)
@pytest.mark.parametrize("call", EXAMPLES)
def test_every_number_may_be_as_large_or_small_as_json_has_them(client: TestClient, call: str) -> None:
    """Whatever is put in the place of a number: an answer without NaN, or a refusal that says where."""
    for field, value in EXAMPLES[call].items():
        if isinstance(value, str):
            continue
        for number in (1e300, -1e300, 1e-300, 5e-324, -0.0, 1e9, 1e6, 1e-9):
            answer = client.post(f"/v1/course/{call}", json=changed(call, **{field: number}))
            if answer.status_code == 422:
                problem = answer.json()
                assert field in (problem.get("pointer") or problem["errors"][0]["pointer"]), problem
            else:
                assert answer.status_code == 200, answer.text
                ANSWERS[call].model_validate_json(answer.content)


@pytest.mark.parametrize("call", EXAMPLES)
@pytest.mark.parametrize(
    "body", [b"", b"[]", b"{", b"null", b'{"resistance": NaN}', b'{"duty": 1e400}', b"[" * 100_000]
)
def test_a_call_that_is_none(client: TestClient, call: str, body: bytes) -> None:
    answer = client.post(f"/v1/course/{call}", content=body, headers={"content-type": "application/json"})
    assert answer.status_code in {400, 422}
    assert answer.headers["content-type"] == "application/problem+json"


def test_other_media_types_and_queries_are_refused(client: TestClient) -> None:
    assert client.post("/v1/course/pwm", content=b"D=0.35", headers={"content-type": "text/plain"}).status_code == 415
    assert client.post("/v1/course/pwm?duty=0.35", json=EXAMPLE_PWM).status_code == 422
    assert client.get("/v1/course/pwm").status_code == 405


@pytest.mark.slow
def test_random_components_have_finite_answers(client: TestClient) -> None:
    """Over the whole range that is allowed, log-uniformly: nothing overflows and every certificate holds."""
    rng = np.random.default_rng(11)

    def between(lower: float, upper: float) -> float:
        return float(np.clip(10.0 ** rng.uniform(np.log10(lower), np.log10(upper)), lower, upper))

    for _ in range(150):
        motor = {
            "resistance": between(1e-6, 1e9),
            "inductance": between(1e-12, 1e6),
            "torque_constant": between(1e-9, 1e6),
            "viscous_friction": between(1e-12, 1e6),
            "inertia": between(1e-15, 1e9),
            "voltage": -between(1e-6, 1e6),
            "load_torque": between(1e-9, 1e9),
            "times": [between(1e-12, 1e9) for _ in range(6)],
        }
        good(client, "dc-motor", motor)
        pulses = {"supply_voltage": between(1e-6, 1e6), "frequency": between(1e-6, 1e12), "duty": rng.random()}
        electrical = {key: motor[key] for key in ("resistance", "inductance")}
        good(client, "pwm", {**pulses, **electrical, "back_emf": between(1e-6, 1e6)})
        body = {"ratio": between(1e-6, 1e6), "efficiency": between(1e-6, 1.0), "load_torque": between(1e-9, 1e9)}
        good(client, "gear", {**body, "motor_angular_velocity": -between(1e-9, 1e9)})
