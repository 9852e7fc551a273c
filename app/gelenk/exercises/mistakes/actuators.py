"""Mistakes about motors, gears, pulses and encoders."""

from gelenk.language import marked

MISTAKES = {
    "friction_forgotten": marked("The friction b ω takes a part of the torque."),
    "back_emf_forgotten": marked("The back-EMF k ω stands against the voltage."),
    "load_forgotten": marked("This is without the load torque."),
    "load_helps": marked("The load torque is against the motion: it has a minus sign."),
    "constant_once": marked("The denominator has k squared: once for the torque, once for the back-EMF."),
    "ratio_inverted": marked("The gear ratio is used the wrong way round."),
    "efficiency_forgotten": marked("The efficiency of the gear is missing."),
    "efficiency_inverted": marked("The motor has to give more than the load takes: divide by η, not multiply."),
    "ratio_not_squared": marked("An inertia crosses a gear with the ratio squared."),
    "root_forgotten": marked("The optimal ratio is the square root of the ratio of inertias."),
    "inertias_exchanged": marked("The inertias of motor and load are exchanged."),
    "duty_of_pause": marked("This is the share of the pause, 1 - D."),
    "mean_for_rms": marked("This is the mean; the root mean square is √D times the supply."),
    "duty_for_rms": marked("The root mean square has the square root of D, not its square."),
    "ripple_without_pause": marked("The ripple has the factor D (1 - D), not D alone."),
    "ripple_of_pause": marked("The ripple has the factor D (1 - D), not 1 - D alone."),
    "ratio_upside_down": marked("This is the fraction upside down."),
    "whole_period": marked("This is the whole period; the pulse is its share D."),
    "voltage_for_torque": marked("This is the current at which it stalls; the torque is k_t times that."),
    "inertia_at_load": marked("This is the inertia at the load, N² times that at the motor."),
    "inertia_without_rotor": marked("The rotor's own inertia is missing."),
    "period_multiplied": marked("A speed is an angle divided by the time, not multiplied by it."),
    "frequency_forgotten": marked("The time is a share of the period 1/f."),
    "quadrature_forgotten": marked("With quadrature each line gives four counts, not one."),
    "quadrature_halved": marked("With quadrature each line gives four counts, not two: both edges of both channels."),
    "gear_forgotten": marked("The encoder is on the motor: at the load a count is smaller by the gear ratio."),
    "gear_multiplied": marked("The load turns less than the motor: divide the angle by the gear ratio."),
    "rounded_down": marked("Rounded down, the resolution is not reached: round up."),
}
