"""Motor, gear and pulse width modulation: the lecture's numbers, and a second way to each formula."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from gelenk.course.actuators import gear, pwm
from gelenk.course.actuators.dc_motor import (
    Motor,
    balance,
    modes,
    motor_steps,
    motor_warnings,
    operating_point,
    torque_speed_line,
)
from gelenk.course.actuators.motor_response import exponential, step_response
from gelenk.course.actuators.pwm import Pulses, approximate_ripple, exact_ripple, voltage_for_speed
from gelenk.course.steps import tex
from gelenk.errors import CertificationFailed
from gelenk.robot.arrays import Array

LECTURE = Motor(1.2, 2e-3, 0.05, 0.05, 1e-4, 2e-4)
"""R = 1.2 Ω, L = 2 mH, k = 0.05, b = 1e-4, J = 2e-4; at 24 V with a load of 0.1 N m."""

DOUBLE = Motor(2.0, 1.0, 0.5, 0.5, 1.0, 1.0)
"""R/L = 2, b/J = 1 and k/√(LJ) = 1/2 = (2 - 1)/2: both poles are -1.5."""


def printed(value: float, text: str) -> bool:
    """Whether a number is the printed one, to its last digit."""
    decimals = len(text.partition(".")[2])
    return abs(value - float(text)) <= 0.5000001 * 10.0**-decimals


def motors(count: int, seed: int) -> list[Motor]:
    """Motors over many orders of magnitude, stiff and oscillating ones among them; every third with k_t ≠ k_e."""
    rng = np.random.default_rng(seed)
    found = []
    for number in range(count):
        R, L, k, b, J = 10.0 ** rng.uniform([-1, -4, -2, -6, -5], [1, -1, 0, -3, -2])
        found.append(Motor(R, L, k, k * (1.0 if number % 3 else 1.3), b, J))
    return found


def system(motor: Motor, voltage: float, load: float) -> tuple[Array, Array]:
    """A and c of (i̇, ω̇) = A (i, ω) + c, from the two equations as the lecture writes them."""
    A = np.array(
        [
            [-motor.resistance / motor.inductance, -motor.back_emf_constant / motor.inductance],
            [motor.torque_constant / motor.inertia, -motor.viscous_friction / motor.inertia],
        ]
    )
    return A, np.array([voltage / motor.inductance, -load / motor.inertia])


# DC motor


@pytest.mark.parametrize(
    ("quantity", "value"),
    [("angular_velocity", "412.213740458"), ("current", "2.824427481")],
)
def test_the_steady_state_of_the_lecture(quantity: str, value: str) -> None:
    assert printed(getattr(operating_point(LECTURE, 24.0, 0.1), quantity), value)


@pytest.mark.parametrize(
    ("quantity", "value"),
    [("no_load_angular_velocity", "458.015267176"), ("stall_torque", "1.0"), ("stall_current", "20")],
)
def test_the_ends_of_the_line_of_the_lecture(quantity: str, value: str) -> None:
    assert printed(getattr(torque_speed_line(LECTURE, 24.0), quantity), value)


def test_the_poles_of_the_lecture() -> None:
    found = modes(LECTURE)
    assert found.damping == "overdamped"
    slow, fast = (pole.real for pole in found.poles)
    assert printed(slow, "-11.113246024")
    assert printed(fast, "-589.386753976")


def test_the_response_of_the_lecture_after_20_ms_from_rest() -> None:
    response = step_response(LECTURE, 24.0, 0.1, np.array([0.02]), 0.0, 0.0)
    assert printed(response.currents[0], "17.135013700")
    assert printed(response.angular_velocities[0], "75.117516718")


@pytest.mark.parametrize("motor", motors(20, 1))
def test_a_steady_state_is_one(motor: Motor) -> None:
    V, load = 12.0, 0.02
    point = operating_point(motor, V, load)
    A, c = system(motor, V, load)
    x = np.array([point.current, point.angular_velocity])
    np.testing.assert_allclose(A @ x, -c, rtol=1e-12, atol=1e-12 * np.abs(A @ np.diag(x)).max())
    np.testing.assert_allclose(x, np.linalg.solve(A, -c), rtol=1e-9)


@pytest.mark.parametrize("field", ["angular_velocity", "current"])
def test_another_steady_state_is_withheld(field: str) -> None:
    point = operating_point(LECTURE, 24.0, 0.1)
    assert abs(balance(LECTURE, 24.0, 0.1, point)[0]) < 1e-12
    with pytest.raises(CertificationFailed):
        balance(LECTURE, 24.0, 0.1, replace(point, **{field: 1.001 * getattr(point, field)}))


@pytest.mark.parametrize("motor", motors(20, 2))
def test_powers_add_up_where_the_constants_are_one(motor: Motor) -> None:
    motor = replace(motor, back_emf_constant=motor.torque_constant)
    for load in (-2.0, 0.0, 0.01, 2.0):
        point = operating_point(motor, 24.0, load)
        spent = point.copper_loss + point.friction_loss + point.shaft_power
        assert point.electrical_power == pytest.approx(spent, rel=1e-9, abs=1e-9 * point.copper_loss)


@pytest.mark.parametrize("motor", motors(10, 3))
def test_the_line_and_its_most_power_by_trying_loads(motor: Motor) -> None:
    line = torque_speed_line(motor, 24.0)
    loads = np.linspace(0.0, line.stall_torque, 2001)
    points = [operating_point(motor, 24.0, load) for load in loads]
    assert points[0].angular_velocity == pytest.approx(line.no_load_angular_velocity)
    assert points[0].current == pytest.approx(line.no_load_current)
    assert points[-1].angular_velocity == 0.0
    assert points[-1].current == pytest.approx(line.stall_current)
    assert points[-1].torque == pytest.approx(line.stall_torque)
    assert max(point.shaft_power for point in points) == pytest.approx(line.most_power)
    speeds = np.array([point.angular_velocity for point in points])
    np.testing.assert_allclose(np.gradient(speeds, loads), line.slope, rtol=1e-6)


@pytest.mark.parametrize(
    ("voltage", "load", "regime"),
    [
        (24.0, 0.1, "motoring"),
        (24.0, 0.0, "motoring"),
        (-24.0, -0.1, "motoring"),
        (24.0, 1.0, "standstill"),
        (0.0, 0.0, "standstill"),
        (24.0, 1.1, "driven_backwards"),
        (-24.0, -1.1, "driven_backwards"),
        (24.0, -0.04, "assisted"),
        (24.0, -0.5, "generating"),
        (0.0, 0.3, "braking"),
    ],
)
def test_which_way_power_flows(voltage: float, load: float, regime: str) -> None:
    point = operating_point(LECTURE, voltage, load)
    assert point.regime == regime
    assert (point.efficiency is None) == (regime not in {"motoring", "generating"})
    if point.efficiency is not None:
        assert 0.0 <= point.efficiency < 1.0
    if regime == "driven_backwards":
        assert point.electrical_power > 0.0 > point.shaft_power
        assert any("stall torque" in text for text in motor_warnings(LECTURE, voltage, load, point))


def test_constants_that_differ_are_warned_of() -> None:
    other = replace(LECTURE, back_emf_constant=0.06)
    point = operating_point(other, 24.0, 0.1)
    assert any("differ" in text for text in motor_warnings(other, 24.0, 0.1, point))
    assert motor_warnings(LECTURE, 24.0, 0.1, operating_point(LECTURE, 24.0, 0.1)) == ()


@pytest.mark.parametrize("back_emf_constant", [0.04, 0.06])
@pytest.mark.parametrize("load", [0.02, -0.5])
def test_there_is_no_efficiency_where_powers_do_not_add_up(back_emf_constant: float, load: float) -> None:
    motor = Motor(1.0, 1e-3, 0.05, back_emf_constant, 0.0, 1e-4)
    point = operating_point(motor, 10.0, load)
    spent = point.copper_loss + point.friction_loss + point.shaft_power
    assert abs(point.electrical_power - spent) > 0.01 * abs(point.electrical_power)
    assert point.efficiency is None
    assert any("no efficiency" in text for text in motor_warnings(motor, 10.0, load, point))


@pytest.mark.parametrize("load", [1e-9, 0.02, -0.02, -0.5])
def test_constants_that_are_one_but_for_their_digits_have_an_efficiency(load: float) -> None:
    point = operating_point(Motor(1.0, 1e-3, 0.05, 0.05 * (1.0 - 9e-7), 0.0, 1e-4), 10.0, load)
    if point.regime in {"motoring", "generating"}:
        assert point.efficiency is not None
        assert 0.0 <= point.efficiency <= 1.0


def test_the_other_direction_is_a_mirror_image() -> None:
    there, back = (operating_point(LECTURE, 24.0 * sign, 0.1 * sign) for sign in (1, -1))
    assert (back.angular_velocity, back.current) == (-there.angular_velocity, -there.current)
    assert back.efficiency == there.efficiency


@pytest.mark.parametrize("motor", [LECTURE, *motors(30, 4)])
def test_poles_are_eigenvalues(motor: Motor) -> None:
    A, _ = system(motor, 0.0, 0.0)
    expected = sorted(np.linalg.eigvals(A).astype(complex), key=lambda pole: (-pole.real, -pole.imag))
    found = sorted(modes(motor).poles, key=lambda pole: (-pole.real, -pole.imag))
    np.testing.assert_allclose(found, expected, rtol=1e-7)
    assert (modes(motor).damping == "underdamped") == bool(np.iscomplex(expected[0]))


@pytest.mark.parametrize(
    ("motor", "damping"),
    [
        (LECTURE, "overdamped"),
        (DOUBLE, "critically_damped"),
        (replace(DOUBLE, torque_constant=0.5 + 1e-9), "underdamped"),
        (replace(DOUBLE, torque_constant=0.5 - 1e-9), "overdamped"),
        (replace(LECTURE, inductance=0.05), "underdamped"),
        *((motor, None) for motor in motors(30, 5)),
    ],
)
def test_the_response_is_that_of_the_matrix_exponential(motor: Motor, damping: str | None) -> None:
    V, load, start = 24.0, 0.1, np.array([3.0, -40.0])
    assert damping in {None, modes(motor).damping}
    slowest = -1.0 / max(pole.real for pole in modes(motor).poles)
    times = np.concatenate(([0.0], slowest * np.geomspace(1e-6, 20.0, 30)))
    response = step_response(motor, V, load, times, *start)
    A, c = system(motor, V, load)
    final = np.linalg.solve(A, -c)
    expected = np.array([final + expm(A * t) @ (start - final) for t in times])
    found = np.column_stack((response.currents, response.angular_velocities))
    size = np.abs(expected).max(axis=0)
    np.testing.assert_allclose(found / size, expected / size, atol=1e-8)
    assert response.samples == 16


@pytest.mark.parametrize("motor", [LECTURE, DOUBLE, replace(LECTURE, inductance=0.05)])
def test_the_response_is_that_of_integrating_the_equations(motor: Motor) -> None:
    A, c = system(motor, -24.0, 0.1)
    times = np.linspace(0.0, 0.3, 13)
    solved = solve_ivp(
        lambda _, x: A @ x + c, (0.0, 0.3), [1.0, 20.0], "DOP853", t_eval=times, rtol=1e-11, atol=1e-11, max_step=1e-3
    )
    response = step_response(motor, -24.0, 0.1, times, 1.0, 20.0)
    np.testing.assert_allclose(response.currents, solved.y[0], atol=1e-7)
    np.testing.assert_allclose(response.angular_velocities, solved.y[1], atol=1e-7)


def test_without_inductance_it_is_the_limit_of_a_small_one() -> None:
    bare = replace(LECTURE, inductance=0.0)
    times = np.linspace(0.01, 0.5, 20)
    limit = step_response(bare, 24.0, 0.1, times, 0.0, 5.0)
    near = step_response(replace(LECTURE, inductance=1e-10), 24.0, 0.1, times, 0.0, 5.0)
    np.testing.assert_allclose(limit.currents, near.currents, rtol=1e-5)
    np.testing.assert_allclose(limit.angular_velocities, near.angular_velocities, rtol=1e-5)
    found = modes(bare)
    assert found.damping == "first_order"
    assert -1.0 / found.poles[0].real == pytest.approx(bare.mechanical_time_constant)


def test_far_apart_the_time_constants_are_those_of_the_poles() -> None:
    motor = replace(LECTURE, inductance=1e-7)
    slow, fast = (-1.0 / pole.real for pole in modes(motor).poles)
    assert slow == pytest.approx(motor.mechanical_time_constant, rel=1e-4)
    assert fast == pytest.approx(motor.electrical_time_constant, rel=1e-4)


@pytest.mark.parametrize("size", [1, 2])
def test_the_second_way_is_an_exponential_too(size: int) -> None:
    A = np.random.default_rng(6).normal(size=(size, size)) - 3.0 * np.eye(size)
    times = np.array([0.0, 1e-9, 0.3, 2.0, 50.0])
    np.testing.assert_allclose(exponential(A, times), [expm(A * t) for t in times], atol=1e-13)
    assert np.array_equal(exponential(A, np.zeros(2)), np.broadcast_to(np.eye(size), (2, size, size)))


def test_a_response_of_another_motor_is_withheld(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "gelenk.course.actuators.motor_response.exponential", lambda A, times: exponential(1.001 * A, times)
    )
    with pytest.raises(CertificationFailed):
        step_response(LECTURE, 24.0, 0.1, np.array([0.02]), 0.0, 0.0)


def test_the_worked_solution_holds_the_numbers() -> None:
    text = str(motor_steps(LECTURE, 24.0, 0.1, operating_point(LECTURE, 24.0, 0.1)))
    for number in ("412.2137405", "2.824427481", "458.0152672", "-11.11324602", "-589.386754"):
        assert number in text
    oscillating = replace(LECTURE, inductance=0.05)
    assert "mathrm{j}" in str(motor_steps(oscillating, 24.0, 0.1, operating_point(oscillating, 24.0, 0.1)))


@pytest.mark.parametrize(("value", "text"), [(2e-13, r"2 \cdot 10^{-13}"), (24.0, "24"), (0.1 + 0.2, "0.3")])
def test_numbers_in_formulas(value: float, text: str) -> None:
    assert tex(value) == text


# Gear


def test_the_gear_of_the_lecture() -> None:
    """N = 100, η = 0.8 behind the motor of the lecture, whose load has J = 3 kg m²."""
    line = torque_speed_line(LECTURE, 24.0)
    _, load, _ = gear.sides(100.0, 0.8, line.no_load_angular_velocity, None, line.stall_torque, None)
    assert load.torque == pytest.approx(80.0)
    assert load.angular_velocity is not None
    assert printed(load.angular_velocity, "4.580152672")
    inertia = gear.inertias(100.0, LECTURE.inertia, 3.0)
    assert inertia.at_load == pytest.approx(5.0)
    assert inertia.at_motor == pytest.approx(5e-4)
    assert printed(inertia.optimal_ratio, "122.474487139")


@pytest.mark.parametrize("ratio", [0.5, 1.0, 37.0])
@pytest.mark.parametrize("efficiency", [1.0, 0.8, 0.5, 0.3])
@pytest.mark.parametrize("speed", [-3.0, 0.0, 3.0])
@pytest.mark.parametrize("torque", [-2.0, 0.0, 2.0])
def test_there_and_back_across_a_gear(ratio: float, efficiency: float, speed: float, torque: float) -> None:
    motor, load, flow = gear.sides(ratio, efficiency, None, speed, None, torque)
    assert motor.angular_velocity == pytest.approx(ratio * speed)
    assert motor.power is not None
    assert load.power is not None
    assert motor.power >= load.power - 1e-12, "a gear gives no power"
    _, back, _ = gear.sides(ratio, efficiency, motor.angular_velocity, None, motor.torque, None)
    if flow == "load_to_motor" and gear.back_driving(efficiency).self_locking:
        assert motor.torque is not None
        assert motor.torque * speed >= 0.0, "a load on a gear that locks itself has to be driven down"
    else:
        assert back.torque == pytest.approx(torque)


@pytest.mark.parametrize(("efficiency", "locks"), [(1.0, False), (0.8, False), (0.51, False), (0.5, True), (0.2, True)])
def test_a_gear_of_half_or_less_locks_itself(efficiency: float, locks: bool) -> None:
    """By the definition: friction is the same torque both ways, and takes all that the load transmits."""
    found = gear.back_driving(efficiency)
    friction_over_load_torque = 1.0 / efficiency - 1.0
    assert found.self_locking == (friction_over_load_torque >= 1.0) == locks
    assert ("locks" in found.note) == (found.efficiency is None) == locks
    _, held, _ = gear.sides(10.0, efficiency, 5.0, None, -1.0, None)
    assert (held.torque is None) == locks


def test_without_a_speed_the_motor_drives() -> None:
    assert gear.sides(10.0, 0.5, None, None, 2.0, None)[1].torque == pytest.approx(10.0)
    assert gear.sides(10.0, 0.5, None, None, None, 10.0)[0].torque == pytest.approx(2.0)
    motor, load, flow = gear.sides(10.0, 0.5, None, None, None, None)
    assert (flow, motor.power, load.angular_velocity) == ("none", None, None)


def test_the_best_ratio_by_trying_ratios() -> None:
    found = gear.inertias(20.0, 2e-4, 3.0)
    ratios = np.geomspace(10.0, 1000.0, 20001)
    accelerations = ratios / (ratios**2 * 2e-4 + 3.0)
    assert found.optimal_ratio == pytest.approx(ratios[np.argmax(accelerations)], rel=1e-3)
    assert found.acceleration_share == pytest.approx(20.0 / (400.0 * 2e-4 + 3.0) / accelerations.max(), rel=1e-6)


def test_kinetic_energy_is_the_same_from_both_sides() -> None:
    found = gear.inertias(7.0, 2e-4, 0.3)
    assert found.at_motor * 7.0**2 == pytest.approx(found.at_load)
    assert 2e-4 + found.reflected_load == pytest.approx(found.at_motor)
    assert 0.3 + found.reflected_motor == pytest.approx(found.at_load)


# Pulse width modulation


def test_the_pulses_of_the_lecture() -> None:
    """D = 0.35 of 24 V at 20 kHz, R = 1.2 Ω, L = 2 mH."""
    pulses = Pulses(24.0, 0.35, 20e3)
    assert printed(pulses.average_voltage, "8.4")
    assert printed(pulses.rms_voltage, "14.198591479")
    assert printed(1e6 * pulses.on_time, "17.5")
    assert printed(approximate_ripple(pulses, 2e-3), "0.1365")
    found = exact_ripple(pulses, 1.2, 2e-3, 0.0)
    assert printed(found.lowest, "6.931853537")
    assert printed(found.highest, "7.068351208")
    assert printed(found.ripple, "0.136497671")


def test_the_duty_of_the_lecture_for_200_rad_per_second() -> None:
    assert printed(voltage_for_speed(LECTURE, 200.0, 0.1) / 24.0, "0.536666667")


@pytest.mark.parametrize("motor", motors(10, 7))
def test_the_voltage_for_a_speed_gives_that_speed(motor: Motor) -> None:
    for speed in (-30.0, 0.0, 30.0):
        point = operating_point(motor, voltage_for_speed(motor, speed, 0.1), 0.1)
        assert point.angular_velocity == pytest.approx(speed, abs=1e-9)


def simulated(pulses: Pulses, resistance: float, inductance: float, back_emf: float) -> Array:
    """The current over one period, after so many that it repeats itself, by steps of the differential equation."""
    period, tau = 1.0 / pulses.frequency, inductance / resistance
    current = (pulses.average_voltage - back_emf) / resistance
    per_part = 400
    for _ in range(int(12.0 * tau / period) + 2):
        trace = [current]
        for voltage, duration in ((pulses.high_voltage, pulses.on_time), (0.0, pulses.off_time)):
            h = duration / per_part
            for _ in range(per_part):
                slope = (voltage - back_emf - resistance * current) / inductance
                bend = -resistance * slope / inductance
                current += h * slope + 0.5 * h * h * bend - h**3 / 6.0 * resistance * bend / inductance
                trace.append(current)
    return np.array(trace)


@pytest.mark.parametrize("duty", [0.02, 0.35, 0.9])
@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize(("inductance", "back_emf"), [(2e-3, 0.0), (2e-3, 5.0), (1e-4, -3.0)])
def test_the_exact_ripple_by_simulation(duty: float, direction: int, inductance: float, back_emf: float) -> None:
    pulses = Pulses(24.0, duty, 1e3, direction)
    trace = simulated(pulses, 1.2, inductance, back_emf)
    found = exact_ripple(pulses, 1.2, inductance, back_emf)
    assert found.lowest == pytest.approx(trace.min(), abs=1e-5)
    assert found.highest == pytest.approx(trace.max(), abs=1e-5)
    times = np.concatenate((np.linspace(0, duty, 401), np.linspace(duty, 1, 401)[1:]))
    assert found.average == pytest.approx(np.trapezoid(trace, times), abs=1e-3)
    assert found.ripple == pytest.approx(found.highest - found.lowest)
    reverses = (direction * trace).min() < 0.0
    assert any("against the pulses" in text for text in pwm.pwm_warnings(pulses, found)) == reverses


def test_a_small_resistance_leaves_the_approximation() -> None:
    pulses = Pulses(24.0, 0.35, 20e3)
    assert exact_ripple(pulses, 1e-6, 2e-3, 0.0).ripple == pytest.approx(approximate_ripple(pulses, 2e-3), rel=1e-6)


def test_without_inductance_the_current_follows_the_voltage() -> None:
    found = exact_ripple(Pulses(24.0, 0.35, 20e3), 1.2, 0.0, 6.0)
    assert (found.lowest, found.highest, found.ripple) == pytest.approx((-5.0, 15.0, 20.0))


@pytest.mark.parametrize(("duty", "current"), [(0.0, -5.0), (1.0, 15.0)])
def test_at_the_ends_of_the_duty_nothing_switches(duty: float, current: float) -> None:
    pulses = Pulses(24.0, duty, 20e3)
    found = exact_ripple(pulses, 1.2, 2e-3, 6.0)
    assert (found.lowest, found.highest, found.ripple) == pytest.approx((current, current, 0.0))
    assert approximate_ripple(pulses, 2e-3) == 0.0
    assert any(f"D = {duty:g}" in text for text in pwm.pwm_warnings(pulses, found))


def test_the_ripple_is_largest_at_half_the_duty() -> None:
    duties = np.linspace(0.0, 1.0, 101)
    ripples = [exact_ripple(Pulses(24.0, duty, 1e3), 1.2, 2e-3, 0.0).ripple for duty in duties]
    assert np.argmax(ripples) == 50
    np.testing.assert_allclose(ripples, ripples[::-1], atol=1e-12)


@pytest.mark.parametrize("duty", [0.1, 0.5, 0.8])
def test_averages_by_sampling(duty: float) -> None:
    pulses = Pulses(24.0, duty, 50.0, -1)
    volts = np.where((np.arange(100_000) + 0.5) / 100_000 < duty, pulses.high_voltage, 0.0)
    assert pulses.average_voltage == pytest.approx(volts.mean())
    assert pulses.rms_voltage == pytest.approx(sqrt((volts**2).mean()))
    assert pulses.on_time + pulses.off_time == pytest.approx(0.02)
    assert any("H-bridge" in text for text in pwm.pwm_warnings(pulses, None))
