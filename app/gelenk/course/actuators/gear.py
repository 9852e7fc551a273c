"""A gear between motor and load: speeds, torques and inertias, seen from either side.

The ratio N is ω_motor / ω_load. Losses are friction between the teeth: a fraction of the transmitted torque, always
against the motion. So a gear of efficiency η, driven from the motor, has efficiency 2 - 1/η when the load drives; where
that is zero or less, at η ≤ 1/2, the gear is self-locking.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.language import translated as _
from gelenk.robot.result import Result

PowerFlow: TypeAlias = Literal["motor_to_load", "load_to_motor", "none"]


@dataclass(frozen=True, slots=True)
class BackDriving(Result):
    """What happens when the load drives.

    Attributes:
        efficiency: 2 - 1/η, no unit; null where the gear locks itself.
        self_locking: Whether no load can turn the motor: η ≤ 1/2.
        note: An explanation in one sentence.
    """

    efficiency: float | None
    self_locking: bool
    note: str


def back_driving(efficiency: float) -> BackDriving:
    """Return what happens when the load drives a gear of efficiency η in (0, 1]."""
    back = 2.0 - 1.0 / efficiency
    note = _(
        "the load can drive the motor: its efficiency is then {efficiency:.4g}, if the losses are friction in "
        "proportion to what is transmitted"
    ).format(efficiency=back)
    if efficiency == 1.0:
        note = _("without losses the load drives the motor as well as the motor the load")
    if back <= 0.0:
        note = _(
            "the gear locks itself: driven from the load its friction is more than what is transmitted, so the load "
            "cannot turn the motor, and lowering a load takes motor torque in the direction of motion"
        )
    return BackDriving(None if back <= 0.0 else back, back <= 0.0, note)


@dataclass(frozen=True, slots=True)
class GearSide(Result):
    """One side of the gear; null where not given.

    Attributes:
        angular_velocity: ω, [rad/s].
        torque: τ, from the motor towards the load, [N m].
        power: τ ω, [W]: negative where it flows from the load to the motor.
    """

    angular_velocity: float | None
    torque: float | None
    power: float | None


def sides(
    ratio: float,
    efficiency: float,
    motor_velocity: float | None,
    load_velocity: float | None,
    motor_torque: float | None,
    load_torque: float | None,
) -> tuple[GearSide, GearSide, PowerFlow]:
    """Compute motor, load and the driving side from one speed and one torque, each given at either side, or omitted.

    The load torque is None where the motor brakes a self-locking gear, which holds any load. The ratio is N > 0, the
    efficiency η in (0, 1] when the motor drives; speeds in [rad/s], torques in [N m].
    """
    if motor_velocity is None and load_velocity is not None:
        motor_velocity = ratio * load_velocity
    elif motor_velocity is not None:
        load_velocity = motor_velocity / ratio
    flow = _power_flow(motor_velocity, motor_torque if motor_torque is not None else load_torque)
    factor = ratio * efficiency
    if flow == "load_to_motor":
        back = 2.0 - 1.0 / efficiency
        if motor_torque is not None:
            load_torque = None if back <= 0.0 else ratio * motor_torque / back
        elif load_torque is not None:
            motor_torque = back * load_torque / ratio
    elif motor_torque is not None:
        load_torque = factor * motor_torque
    elif load_torque is not None:
        motor_torque = load_torque / factor
    return _side(motor_velocity, motor_torque), _side(load_velocity, load_torque), flow


def _power_flow(velocity: float | None, torque: float | None) -> PowerFlow:
    """Return the driving side by the sign of the power: the motor at unknown or zero speed, none without torque."""
    if not torque:
        return "none"
    return "load_to_motor" if velocity and (velocity < 0.0) != (torque < 0.0) else "motor_to_load"


def _side(velocity: float | None, torque: float | None) -> GearSide:
    return GearSide(velocity, torque, None if velocity is None or torque is None else velocity * torque)


@dataclass(frozen=True, slots=True)
class ReflectedInertias(Result):
    """Rotor and load as one inertia.

    Attributes:
        at_motor: J_m + J_L / N², [kg m²].
        at_load: N² J_m + J_L, [kg m²].
        reflected_load: J_L / N², [kg m²].
        reflected_motor: N² J_m, [kg m²].
        optimal_ratio: N* = √(J_L / J_m), with which a given motor torque accelerates the load most; no unit.
        acceleration_share: Acceleration with this ratio over that with N*, same torque, no losses; in [0, 1].
    """

    at_motor: float
    at_load: float
    reflected_load: float
    reflected_motor: float
    optimal_ratio: float
    acceleration_share: float


def inertias(ratio: float, motor_inertia: float, load_inertia: float) -> ReflectedInertias:
    """Compute the inertias of rotor and load, [kg m²], across a ratio.

    The load's acceleration N τ / (N² J_m + J_L) is largest at N* = √(J_L / J_m), where both contribute equally.
    """
    load, motor = load_inertia / ratio**2, motor_inertia * ratio**2
    optimal = math.sqrt(load_inertia / motor_inertia)
    share = 2.0 / (ratio / optimal + optimal / ratio)
    return ReflectedInertias(motor_inertia + load, motor + load_inertia, load, motor, optimal, share)


def gear_steps(
    ratio: float,
    efficiency: float,
    motor: GearSide,
    load: GearSide,
    flow: PowerFlow,
    inertia: ReflectedInertias | None,
) -> tuple[Step, ...]:
    """Return the worked solution of speeds, torques and inertias."""
    N, eta = tex(ratio), tex(efficiency)
    steps = []
    if motor.angular_velocity is not None and load.angular_velocity is not None:
        divided = rf"\frac{{{tex(motor.angular_velocity)}}}{{{N}}} = {tex(load.angular_velocity, 'rad/s')}"
        text = _("The gear divides the speed by its ratio.")
        steps.append(step(_("Speeds"), text, rf"\omega_L = \frac{{\omega_m}}{{N}} = {divided}"))
    if motor.torque is not None and load.torque is not None:
        symbol, value = r"\eta", eta
        text = _("The gear multiplies the torque by its ratio, less what friction takes.")
        if flow == "load_to_motor":
            symbol, value = r"\left(2 - \tfrac{1}{\eta}\right)^{-1}", f"({tex(2.0 - 1.0 / efficiency)})^{{-1}}"
            text = _("The load drives: now friction helps the motor to hold it.")
        product = rf"{value} \cdot {N} \cdot {tex_factor(motor.torque)}"
        steps.append(step(_("Torques"), text, rf"\tau_L = {symbol}\,N\,\tau_m = {product} = {tex(load.torque, 'N m')}"))
    if inertia is not None:
        steps.append(_inertia_step(inertia))
    return tuple(steps)


def _inertia_step(inertia: ReflectedInertias) -> Step:
    unit = "kg m^2"
    return step(
        _("Inertias"),
        _(
            "Kinetic energy is the same from both sides, so an inertia crosses the gear with the ratio squared. A "
            "given motor torque accelerates the load most where rotor and reflected load are equal."
        ),
        rf"J_{{\mathrm{{motor}}}} = J_m + \frac{{J_L}}{{N^2}} = {tex(inertia.at_motor, unit)}",
        rf"J_{{\mathrm{{load}}}} = N^2 J_m + J_L = {tex(inertia.at_load, unit)}",
        rf"N^* = \sqrt{{\frac{{J_L}}{{J_m}}}} = {tex(inertia.optimal_ratio)}",
    )
