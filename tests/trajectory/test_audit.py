"""The audit: every planted defect is found with the right joint, time and ratio, and sound motions pass."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

from gelenk.errors import CertificationFailed
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.audit import DERIVATIVES, audit
from gelenk.trajectory.audit.demands import Demands, JointLimits, TipLimits
from gelenk.trajectory.audit.examine import Examined, examined
from gelenk.trajectory.audit.joints import joint_figures
from gelenk.trajectory.audit.pieces import pieces_of
from gelenk.trajectory.audit.result import Audit
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from tests.oracles.catalogue import NAMES
from tests.robots import robot

PANDA = robot("panda")
ARM = PANDA.chain(None, None)
MIDDLE = 0.5 * (ARM.lower + ARM.upper)


def motion_of(spline: CubicSpline) -> PiecewisePolynomial:
    return PiecewisePolynomial(spline.x, np.ascontiguousarray(spline.c[::-1].transpose(1, 0, 2)))


def clamped(times: Array, knots: Array) -> PiecewisePolynomial:
    """A cubic spline from rest to rest."""
    return motion_of(CubicSpline(times, knots, bc_type="clamped"))


def some_motion(chain: Chain, pieces: int = 8, seed: int = 0, reach: float = 0.3) -> PiecewisePolynomial:
    """From rest to rest, well within the limits of every joint."""
    rng = np.random.default_rng(seed)
    lower, upper = np.maximum(chain.lower, -2.0), np.minimum(chain.upper, 2.0)
    middle, half = 0.5 * (lower + upper), 0.5 * (upper - lower)
    return clamped(
        np.linspace(0.0, 4.0, pieces + 1), middle + reach * half * rng.uniform(-1.0, 1.0, (pieces + 1, len(chain)))
    )


def quintic(start: Array, end: Array, duration: float) -> PiecewisePolynomial:
    """Rest to rest: 10 τ³ - 15 τ⁴ + 6 τ⁵."""
    coefficients = np.zeros((1, 6, len(start)))
    coefficients[0, 0] = start
    for power, factor in ((3, 10.0), (4, -15.0), (5, 6.0)):
        coefficients[0, power] = factor * (end - start) / duration**power
    return PiecewisePolynomial(np.array([0.0, duration]), coefficients)


def ends_of(motion: PiecewisePolynomial) -> tuple[Array, Array]:
    start, end = motion.at(motion.breaks[[0, -1]])
    return start, end


def judged(motion: PiecewisePolynomial, demands: Demands | None = None) -> Audit:
    return audit(PANDA, ARM, motion, demands or Demands(ends=ends_of(motion)))


def only_reason(found: Audit) -> tuple[str, str | None, float]:
    assert not found.passed
    assert len(found.reasons) == 1, found.reasons
    reason = found.reasons[0]
    return reason.check, reason.joint, reason.time


# Sound motions


@pytest.mark.quick(36)
@pytest.mark.parametrize("name", NAMES)
def test_a_sound_motion_passes_on_every_robot(name: str) -> None:
    arm = robot(name)
    chain = arm.chain(None, None)
    motion = some_motion(chain)
    rates = [np.abs(motion.derivative(k).at(np.linspace(0.0, 4.0, 4001))).max(axis=0) * 1.001 for k in (1, 2, 3)]
    found = audit(arm, chain, motion, Demands(JointLimits(*rates), ends=ends_of(motion), continuous=2))
    assert found.passed, found.reasons
    assert found.velocity is not None
    assert found.velocity.ratio is not None
    can_move = bool((chain.upper > chain.lower).any())
    assert 0.998 < found.velocity.ratio <= 1.0 if can_move else found.velocity.ratio == 0.0
    assert found.certificate.samples == 16
    assert found.certificate.max_position_error < 1e-9
    assert max(found.ends.values()) < 1e-12


def test_a_joint_that_stands_still_and_a_chain_without_joints() -> None:
    still = PiecewisePolynomial(np.array([0.0, 1.0]), MIDDLE[None, None])
    found = judged(still)
    assert found.passed
    assert found.velocity is not None
    assert found.velocity.value == 0.0
    assert found.tip.speed.value == 0.0
    fixed = PANDA.chain("panda_link0", "panda_link0")
    nothing = audit(PANDA, fixed, PiecewisePolynomial(np.array([0.0, 1.0]), np.zeros((1, 1, 0))), Demands())
    assert nothing.passed
    assert (nothing.velocity, nothing.min_singular_value, nothing.limit_margin) == (None, None, None)


# Peaks


def test_the_peaks_of_a_quintic_are_those_of_its_closed_form() -> None:
    """Velocity 1.875 Δ/T at T/2, acceleration 5.773502692 Δ/T² at T (3 - √3)/6, jerk 60 Δ/T³ at the ends."""
    end = MIDDLE.copy()
    end[3] += 0.6
    found = judged(
        quintic(MIDDLE, end, 2.0),
        Demands(JointLimits(np.full(7, 1.0), np.full(7, 1.0), np.full(7, 1.0), *[None] * 2), continuous=3),
    )
    assert found.velocity is not None
    assert found.acceleration is not None
    assert found.jerk is not None
    assert (found.velocity.ratio, found.velocity.time) == pytest.approx((1.875 * 0.6 / 2.0, 1.0), abs=1e-6)
    assert found.velocity.joint == "panda_joint4"
    assert found.acceleration.ratio == pytest.approx(5.773502692 * 0.6 / 4.0, abs=1e-9)
    assert min(abs(found.acceleration.time - 2.0 * (3.0 + s * 3.0**0.5) / 6.0) for s in (-1.0, 1.0)) < 1e-6
    assert found.jerk.value == pytest.approx(60.0 * 0.6 / 8.0, abs=1e-9)
    assert found.jerk.time in {0.0, 2.0}
    assert [reason.check for reason in found.reasons] == ["jerk"]


@pytest.mark.parametrize("degree", [1, 2, 3, 5, 7, 9])
@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_extremes_by_brute_force(degree: int, order: int) -> None:
    """Random polynomials, wiggling within each piece, sampled two thousand times each."""
    rng = np.random.default_rng(degree)
    widths = rng.uniform(0.05, 1.0, 30)
    scale = (1.0 / widths)[:, None, None] ** np.arange(degree + 1)[None, :, None]
    signs = rng.normal(size=(30, degree + 1, 4)) * 3.0 ** np.arange(degree + 1)[None, :, None]
    motion = PiecewisePolynomial(np.concatenate(([0.0], np.cumsum(widths))), signs * scale)
    part = motion.derivative(order) if order else motion
    tau = np.linspace(0.0, 1.0, 2001)
    # Each piece by itself, so that both sides of a break count.
    values = np.polynomial.polynomial.polyval(
        tau,
        np.moveaxis(part.coefficients * widths[:, None, None] ** np.arange(part.coefficients.shape[1])[:, None], 1, 0),
    )
    found, size = joint_figures(pieces_of(motion)).extremes, np.abs(values).max()
    highest, lowest, largest = values.max(axis=(0, 2)), values.min(axis=(0, 2)), np.abs(values).max(axis=(0, 2))
    for larger in [np.abs(found[order + 1]) - largest] if order else [found[1] - highest, found[0] + lowest]:
        assert (larger >= -1e-9 * size).all(), "none is missed"
        assert (larger <= 1e-4 * size).all(), "none is invented"


# Planted defects


@pytest.mark.parametrize("joint", [0, 4])
@pytest.mark.parametrize(("check", "order"), [("velocity", 1), ("acceleration", 2), ("jerk", 3)])
def test_a_limit_that_is_exceeded_between_samples(check: str, order: int, joint: int) -> None:
    """A bump of 2 ms in one of many pieces of a slow motion, its peak strictly inside."""
    times = np.linspace(0.0, 4.0, 401)
    slow = quintic(MIDDLE, MIDDLE + 0.1, 4.0)
    pieces = np.zeros((400, 10, 7))
    for k in range(6):
        derivative = slow.derivative(k).at(times[:-1]) if k else slow.at(times[:-1])
        pieces[:, k] = derivative / np.prod(np.arange(1, k + 1))
    h, size = 0.01, 1e-4
    # size · 256 τ⁴ (1 - τ)⁴: nothing changes at the ends of the piece, up to the third derivative.
    bump = size * 256.0 * np.array([0.0, 0, 0, 0, 1, -4, 6, -4, 1, 0]) / h ** np.arange(10)
    pieces[123, :, joint] += bump
    motion = PiecewisePolynomial(times, pieces)
    fine = np.linspace(times[123], times[124], 200_001)[1:-1]
    values = np.abs(motion.derivative(order).at(fine)[:, joint])
    limits = JointLimits(**{check: np.full(7, values.max() / 1.25)})
    found = judged(motion, Demands(limits, continuous=3, ends=ends_of(motion)))
    assert only_reason(found)[:2] == (check, ARM.joint_names[joint])
    peak = getattr(found, check)
    assert peak.ratio == pytest.approx(1.25, rel=1e-7)
    symmetric = 2.0 * times[123] + h - peak.time
    assert min(abs(peak.time - fine[values.argmax()]), abs(symmetric - fine[values.argmax()])) < 1e-6
    assert times[123] < peak.time < times[124]
    on_samples = np.abs(motion.derivative(order).at(times)).max()
    assert on_samples < values.max() / 1.25, "the ends of the pieces show nothing"
    loose = JointLimits(**{check: np.full(7, values.max() * (1.0 + 1e-7))})
    assert judged(motion, Demands(loose, continuous=3, ends=ends_of(motion))).passed


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_a_jump_where_two_pieces_meet(order: int) -> None:
    """One derivative jumps by 10⁻³ where a piece begins; those below it go on, and all do where it ends."""
    breaks, h = np.linspace(0.0, 4.0, 9), 0.5
    coefficients = np.zeros((8, 8, 7))
    coefficients[:, 0] = MIDDLE
    size = 1e-3 / np.prod(np.arange(1, order + 1))
    # t^k (1 - t/h)⁴
    coefficients[5, order : order + 5, 2] += size * np.array([1.0, -4.0, 6.0, -4.0, 1.0]) / h ** np.arange(5)
    motion = PiecewisePolynomial(breaks, coefficients)
    promised = Demands(continuous=order, ends=(MIDDLE, MIDDLE))
    found = judged(motion, promised)
    assert only_reason(found) == ("continuity", "panda_joint3", 2.5)
    jumps = [getattr(found.continuity, name) for name in DERIVATIVES]
    jump = jumps[order]
    assert (jump.joint, jump.time) == ("panda_joint3", 2.5)
    assert jump.value == pytest.approx(1e-3, abs=1e-12)
    assert [below.value for below in jumps[:order]] == pytest.approx([0.0] * order, abs=1e-12)
    if order:
        assert judged(motion, replace(promised, continuous=order - 1)).passed, "nobody promised more"


def test_a_wrong_end_and_an_end_that_is_not_at_rest() -> None:
    motion = some_motion(ARM)
    start, end = ends_of(motion)
    off = end.copy()
    off[5] += 2e-6
    found = judged(motion, Demands(ends=(start, off)))
    assert only_reason(found) == ("boundary", "panda_joint6", 4.0)
    assert found.ends["end_position"] == pytest.approx(2e-6, rel=1e-6)
    moving = PiecewisePolynomial(motion.breaks, motion.coefficients.copy())
    moving.coefficients[0, 1, 1] += 1e-5
    moving.coefficients[0, 2, 1] -= 1e-5 / motion.breaks[1]
    found = judged(moving, Demands(ends=(start, end), continuous=0))
    assert only_reason(found) == ("boundary", "panda_joint2", 0.0)
    assert found.ends["start_velocity"] == pytest.approx(1e-5, rel=1e-6)


def test_a_joint_beyond_its_limits_between_samples() -> None:
    """Both ends are within the limits, the curve between them is not: 0.02 · 16 t² (1 - t)²."""
    start = MIDDLE.copy()
    start[1] = ARM.upper[1] - 0.01
    coefficients = np.zeros((1, 5, 7))
    coefficients[0, 0], coefficients[0, 2:, 1] = start, 0.32 * np.array([1.0, -2.0, 1.0])
    motion = PiecewisePolynomial(np.array([0.0, 1.0]), coefficients)
    ends = (start, start)
    found = judged(motion, Demands(ends=ends))
    assert only_reason(found)[:2] == ("joint_limit", "panda_joint2")
    assert found.limit_margin is not None
    assert found.limit_margin.bound == "upper"
    assert found.limit_margin.value == pytest.approx(-0.01)
    assert found.limit_margin.time == pytest.approx(0.5, abs=1e-6)
    wider = JointLimits(lower=ARM.lower - 0.1, upper=ARM.upper + 0.1)
    assert judged(motion, Demands(wider, ends=ends)).passed


def test_a_lower_limit() -> None:
    found = judged(quintic(MIDDLE, np.where(np.arange(7) == 3, ARM.lower - 0.2, MIDDLE), 2.0))
    assert only_reason(found) == ("joint_limit", "panda_joint4", 2.0)
    assert found.limit_margin is not None
    assert found.limit_margin.bound == "lower"
    assert found.limit_margin.value == pytest.approx(-0.2)


# The path


def poses_of(motion: PiecewisePolynomial, chain: Chain = ARM) -> tuple[PiecewisePolynomial, object]:
    def path(times: Array) -> Poses:
        return Poses(*chain_poses(chain.flat, motion.at(times)))

    return motion, path


def test_a_motion_keeps_to_its_own_path() -> None:
    motion = some_motion(ARM)
    path = poses_of(motion)[1]
    found = judged(motion, Demands(ends=ends_of(motion), path=path))  # type: ignore[arg-type]
    assert found.passed
    assert found.path_deviation is not None
    assert found.path_deviation.value < 1e-12


@pytest.mark.parametrize("quantity", ["position", "orientation"])
def test_a_deviation_between_samples(quantity: str) -> None:
    """The path wanted has a bump of 12 ms that misses every knot of the motion."""
    motion, (centre, width) = some_motion(ARM, 100), (1.2213, 0.012)

    def bump(times: Array) -> Array:
        x = np.clip(np.abs(times - centre) / width, 0.0, 1.0)
        return np.asarray((1.0 - x**2) ** 3)

    def path(times: Array) -> Poses:
        poses = Poses(*chain_poses(ARM.flat, motion.at(times)))
        if quantity == "position":
            return Poses(poses.positions + 3e-4 * bump(times)[:, None] * [0.6, 0.0, 0.8], poses.rotations)
        turns = Rotation.from_rotvec(2e-3 * bump(times)[:, None] * [0.0, 1.0, 0.0]).as_matrix()
        return Poses(poses.positions, poses.rotations @ turns)

    assert bump(motion.breaks).max() == 0.0
    found = judged(motion, Demands(ends=ends_of(motion), path=path))
    check, joint, when = only_reason(found)
    assert (check, joint) == ("path", None)
    assert when == pytest.approx(centre, abs=1e-5)
    peak = found.path_deviation if quantity == "position" else found.orientation_deviation
    assert peak is not None
    assert peak.value == pytest.approx(3e-4 if quantity == "position" else 2e-3, rel=1e-6)
    assert peak.ratio == pytest.approx(3.0 if quantity == "position" else 2.0, rel=1e-6)
    loose = Demands(ends=ends_of(motion), path=path, path_tolerance=4e-4, orientation_tolerance=3e-3)
    assert judged(motion, loose).passed


def beside(offset: Callable[[Array], Array]) -> Callable[[Array], Poses]:
    """A path beside the tip at `MIDDLE` by some distance in time, on the side to which joint 1 moves it."""
    positions, rotations, Js = chain_jacobians(ARM.flat, MIDDLE[None])
    direction = Js[0, :3, 0] / np.linalg.norm(Js[0, :3, 0])

    def path(times: Array) -> Poses:
        return Poses(positions + offset(times)[:, None] * direction, np.repeat(rotations, len(times), axis=0))

    return path


def test_a_deviation_right_after_a_break() -> None:
    """Its peak is between the break and the next sample, and the sample before the break is larger by rounding."""
    coefficients = np.repeat(MIDDLE[None, None], 2, axis=0)
    coefficients[1, 0, 0] += 1e-13
    motion = PiecewisePolynomial(np.array([0.0, 1.0, 4.0]), coefficients)
    peak = 1.0 + 0.3 * 4.0 / 1500.0
    path = beside(lambda times: 3e-4 / (1.0 + np.square((times - peak) / 0.02)))
    found = judged(motion, Demands(path=path, path_tolerance=1.0)).path_deviation
    assert found is not None
    assert found.value == pytest.approx(3e-4, rel=1e-8)
    assert found.time == pytest.approx(peak, abs=1e-6)


def test_a_deviation_that_hides_on_a_plateau() -> None:
    """All samples around its peak are lower than hundreds of others."""
    motion = PiecewisePolynomial(np.array([0.0, 4.0]), MIDDLE[None, None])
    step = 4.0 / 1500.0
    centre = 700.5 * step

    def offset(times: Array) -> Array:
        x = (times - centre) / step
        return np.asarray(1e-4 * np.where(np.abs(x) < 3.0, 1.002 - 0.012 * x**2, 1.0))

    found = judged(motion, Demands(path=beside(offset), path_tolerance=1.0)).path_deviation
    assert found is not None
    assert found.value == pytest.approx(1.002e-4, rel=1e-9)
    assert found.time == pytest.approx(centre, abs=1e-6)


def test_a_path_without_a_pose_fails() -> None:
    motion = some_motion(ARM)

    def path(times: Array) -> Poses:
        poses = Poses(*chain_poses(ARM.flat, motion.at(times)))
        poses.positions[times > 3.0] = np.nan
        return poses

    assert {reason.check for reason in judged(motion, Demands(path=path)).reasons} == {"path"}


# The tip


def test_speeds_and_accelerations_of_the_tip_by_differences() -> None:
    motion = some_motion(ARM, 5)
    found = judged(motion)
    step, times = 2e-5, np.linspace(1e-3, 4.0 - 1e-3, 8001)
    before, at, after = (chain_poses(ARM.flat, motion.at(times + k * step)) for k in (-1, 0, 1))
    speed = np.linalg.norm(after[0] - before[0], axis=1) / (2.0 * step)
    turns = [Rotation.from_matrix(pose[1]) for pose in (before, at, after)]
    angular = (turns[2] * turns[0].inv()).magnitude() / (2.0 * step)
    acceleration = np.linalg.norm(after[0] - 2.0 * at[0] + before[0], axis=1) / step**2
    changes = (turns[2] * turns[1].inv()).as_rotvec() - (turns[1] * turns[0].inv()).as_rotvec()
    for quantity, values in (
        ("speed", speed),
        ("angular_speed", angular),
        ("acceleration", acceleration),
        ("angular_acceleration", np.linalg.norm(changes, axis=1) / step**2),
    ):
        i = int(values.argmax())
        if 1e-2 < times[i] < 4.0 - 1e-2:
            assert getattr(found.tip, quantity).value == pytest.approx(values[i], rel=1e-3)
            assert getattr(found.tip, quantity).time == pytest.approx(times[i], abs=2e-3)
        else:
            assert getattr(found.tip, quantity).value >= values[i] * (1.0 - 1e-4)


def test_the_tip_s_acceleration_is_exact() -> None:
    """J q̈ + J̇ q̇ at the peak itself, J̇ by the Hessian."""
    from gelenk.kinematics.simd.kernels import chain_hessians

    motion = some_motion(ARM, 5)
    peak = judged(motion).tip.acceleration

    def acceleration(t: float) -> float:
        q, v, a = (np.ascontiguousarray((motion.derivative(k) if k else motion).at(np.array([t]))) for k in range(3))
        J, H = chain_jacobians(ARM.flat, q)[2][0], chain_hessians(ARM.flat, q)[0]
        return float(np.linalg.norm((J @ a[0] + (H @ v[0]) @ v[0])[:3]))

    around = np.clip([peak.time - 1e-3, peak.time + 1e-3], 0.0, 4.0)
    best = minimize_scalar(lambda t: -acceleration(t), bounds=tuple(around), method="bounded", options={"xatol": 1e-10})
    assert peak.value == pytest.approx(max(-best.fun, acceleration(peak.time)), rel=1e-9)


def test_a_limit_of_nothing() -> None:
    """What moves is infinitely far beyond it, what stands still keeps to it."""
    end = MIDDLE.copy()
    end[2] += 0.1
    motion, velocity = quintic(MIDDLE, end, 2.0), np.zeros(7)
    demands = Demands(JointLimits(velocity), TipLimits(speed=0.0), ends_of(motion))
    found = judged(motion, demands)
    assert found.velocity is not None
    assert (found.velocity.ratio, found.velocity.joint) == (np.inf, "panda_joint3")
    assert [reason.check for reason in found.reasons] == ["velocity", "tip"]
    still = quintic(MIDDLE, MIDDLE, 2.0)
    assert judged(still, replace(demands, ends=ends_of(still))).passed


def test_a_tip_that_is_too_fast() -> None:
    motion = some_motion(ARM)
    peaks = judged(motion).tip
    for quantity in peaks.__slots__:
        limits = TipLimits(**{quantity: getattr(peaks, quantity).value / 1.5})
        found = judged(motion, Demands(ends=ends_of(motion), tip=limits))
        assert only_reason(found)[0] == "tip"
        assert getattr(found.tip, quantity).ratio == pytest.approx(1.5)
        assert quantity.replace("_", " ") in found.reasons[0].detail


# Singularities


def test_the_smallest_singular_value_by_brute_force() -> None:
    for seed in range(5):
        motion = some_motion(ARM, 6, seed, 0.8)
        found = judged(motion).min_singular_value
        assert found is not None
        times = np.linspace(0.0, 4.0, 20_001)
        sigmas = np.linalg.svd(chain_jacobians(ARM.flat, motion.at(times))[2], compute_uv=False)[:, -1]
        assert found.value <= sigmas.min() + 1e-12
        assert found.value == pytest.approx(sigmas.min(), abs=1e-5)
        at = chain_jacobians(ARM.flat, motion.at(np.array([found.time])))[2]
        assert np.linalg.svd(at, compute_uv=False)[0, -1] == pytest.approx(found.value, abs=1e-12)


def test_a_wrist_that_passes_its_singularity() -> None:
    """q5 of the UR5 goes through zero between samples, and σ_min there is zero."""
    arm = robot("ur5")
    chain = arm.chain(None, None)
    start = np.array([0.3, -1.1, 1.3, -0.7, -0.4, 0.2])
    end = start.copy()
    end[4] = 0.31
    motion = quintic(start, end, 2.0)
    found = audit(arm, chain, motion, Demands(ends=(start, end))).min_singular_value
    assert found is not None
    assert found.value < 1e-4
    assert motion.at(np.array([found.time]))[0, 4] == pytest.approx(0.0, abs=1e-3)


# How it judges


def test_pinocchio_has_a_say(monkeypatch: pytest.MonkeyPatch) -> None:
    motion = some_motion(ARM)

    def wrong(*args: object) -> Examined:
        found = examined(*args)  # type: ignore[arg-type]
        assert found is not None
        return found._replace(poses=Poses(found.poses.positions + 1e-6, found.poses.rotations))

    monkeypatch.setattr("gelenk.trajectory.audit.audit.examined", wrong)
    with pytest.raises(CertificationFailed):
        judged(motion)


def test_what_is_no_motion_is_not_judged() -> None:
    motion = some_motion(ARM)
    coefficients, breaks = motion.coefficients.copy(), motion.breaks.copy()
    coefficients[3, 2, 1] = np.nan
    breaks[2] = breaks[1]
    for none in (PiecewisePolynomial(motion.breaks, coefficients), PiecewisePolynomial(breaks, motion.coefficients)):
        with pytest.raises(CertificationFailed):
            judged(none)


def test_a_thousand_pieces_of_seven_joints_pass() -> None:
    motion = some_motion(ARM, 1000)
    demands = Demands(
        JointLimits(np.full(7, 1e3), np.full(7, 1e6), np.full(7, 1e9)), ends=ends_of(motion), continuous=2
    )
    assert judged(motion, demands).passed
