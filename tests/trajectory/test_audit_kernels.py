"""What the audit computes of the tip, against Pinocchio and numpy, which share no code with it."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.interpolate import PPoly

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.joints import joint_figures
from gelenk.trajectory.audit.kernels import smallest_singular_values, tip_rates
from gelenk.trajectory.audit.pieces import Pieces, enough, pieces_of, positions_at, spread_times, travels
from gelenk.trajectory.audit.tip import smallest_singular_value, tip_peaks
from gelenk.trajectory.audit.worst import worst
from tests.robots import robot
from tests.trajectory.test_audit import some_motion

ARMS = ["panda", "ur5", "stanford", "scara", "pr2"]
"""Turning and sliding joints, also in a longer chain."""


def samples(pieces: Pieces, count: int) -> tuple[Indices, Array]:
    rng = np.random.default_rng(1)
    return rng.integers(0, len(pieces.widths), count), rng.uniform(0.0, 1.0, count)


def judged_rates(machine: RobotModel, chain: Chain, pieces: Pieces, times: Array) -> Array:
    """Pinocchio's norms of the tip's twist and classical acceleration; joints by numpy's polynomials."""
    model, data, expansion = machine.model, machine.data, machine.expansion(chain)
    tip, rows = machine.frame_id(chain.tip_frame), []
    for time in times:
        i = int(np.clip(np.searchsorted(pieces.starts, time, side="right") - 1, 0, None))
        c = pieces.scaled[i] / pieces.widths[i] ** np.arange(pieces.scaled.shape[1])[:, None]
        joints = [np.polynomial.Polynomial(column) for column in c.T]
        q, v, a = (np.array([(p.deriv(k) if k else p)(time - pieces.starts[i]) for p in joints]) for k in range(3))
        full = (expansion.offset + expansion.matrix @ q, expansion.matrix @ v, expansion.matrix @ a)
        pin.forwardKinematics(model, data, *full)
        pin.updateFramePlacement(model, data, tip)
        twist = pin.getFrameVelocity(model, data, tip, pin.LOCAL_WORLD_ALIGNED)
        change = pin.getFrameClassicalAcceleration(model, data, tip, pin.LOCAL_WORLD_ALIGNED)
        rows.append([np.linalg.norm(part) for part in (twist.linear, twist.angular, change.linear, change.angular)])
    return np.array(rows)


@pytest.mark.parametrize("is_sorted", [False, True])
@pytest.mark.parametrize("name", ARMS)
def test_rates_of_the_tip_are_pinocchio_s(name: str, is_sorted: bool) -> None:
    """Sorted samples are in one piece where eight of them are computed at a time, and in two."""
    machine = robot(name)
    chain = machine.chain(None, None)
    pieces = pieces_of(some_motion(chain, 3, reach=0.8))
    piece, tau = samples(pieces, 37 if is_sorted else 13)
    if is_sorted:
        piece = np.sort(piece)
    found = tip_rates(chain.flat, pieces, piece, tau)
    assert found == pytest.approx(judged_rates(machine, chain, pieces, pieces.times(piece, tau)), rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("seed", range(2))
def test_peaks_of_the_tip_are_pinocchio_s_on_a_dense_grid(seed: int) -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    pieces = pieces_of(some_motion(chain, 4, seed, 0.8))
    peaks = list(tip_peaks(pieces, chain).values())
    around = np.clip([peak.time + np.linspace(-2e-3, 2e-3, 9) for peak in peaks], 0.0, 4.0)
    judge = judged_rates(machine, chain, pieces, np.append(np.linspace(0.0, 4.0, 101), around))
    for k, peak in enumerate(peaks):
        assert judge[:, k].max() <= peak.value * (1.0 + 1e-9)
        assert judge[101 + 9 * k : 110 + 9 * k, k].max() == pytest.approx(peak.value, rel=1e-6)


@pytest.mark.parametrize("rows", [[0, 1, 2, 3, 4, 5], [0, 1, 2], [0, 1, 2, 3, 4]])
@pytest.mark.parametrize("name", ["panda", "scara"])
def test_singular_values_are_numpy_s(name: str, rows: list[int]) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    expansion, tip = machine.expansion(chain), machine.frame_id(chain.tip_frame)
    qs = np.random.default_rng(2).uniform(-1.0, 1.0, (11, len(chain)))
    qs[3] = 0.0
    for about_tip in (False, True):
        wanted = []
        for q in qs:
            full = expansion.offset + expansion.matrix @ q
            J = pin.computeFrameJacobian(machine.model, machine.data, full, tip, pin.LOCAL_WORLD_ALIGNED)
            if about_tip:
                J[3:] = pin.computeFrameJacobian(machine.model, machine.data, full, tip, pin.LOCAL)[3:]
            wanted.append(np.linalg.svd((J @ expansion.matrix)[rows], compute_uv=False)[-1])
        found = smallest_singular_values(chain.flat, qs, np.array(rows), about_tip)
        assert found == pytest.approx(np.array(wanted), rel=1e-11, abs=1e-14)


def test_the_smallest_singular_value_is_the_least_of_dense_samples() -> None:
    chain = robot("panda").chain(None, None)
    for seed in range(4):
        pieces = pieces_of(some_motion(chain, 4, seed, 0.9))
        found = smallest_singular_value(pieces, chain)
        times = np.append(np.linspace(0.0, 4.0, 4001), found.time)
        dense = smallest_singular_values(chain.flat, positions_at(pieces, times), np.arange(6), False)
        assert dense[-1] == pytest.approx(found.value, rel=1e-9)
        assert dense.min() >= found.value * (1.0 - 1e-9)


def test_samples_are_spread_over_time_and_travel() -> None:
    """A thousandth of the time with all of the travel holds half of the samples; joints at rest are sampled evenly."""
    widths, c = np.array([5.0, 0.01, 4.99]), np.zeros((3, 3, 2))
    c[1, 1] = [0.5, -1.5]
    c[2, 0] = c[1, 1]
    pieces = Pieces(np.cumsum(widths) - widths, widths, c)
    travel = travels(pieces)
    times = spread_times(pieces, travel, 200)
    assert (times[0], times[-1], len(times)) == (0.0, 10.0, 201)
    assert (np.diff(times) > 0.0).all()
    assert ((times >= 5.0) & (times <= 5.01)).sum() == pytest.approx(100, abs=2)
    assert enough(travel, 60, 10.0, 1000) == 80
    assert enough(travel, 60, 10.0, 70) == 70
    assert spread_times(pieces, np.zeros(3), 4) == pytest.approx([0, 2.5, 5, 7.5, 10])


def test_a_dip_in_a_short_quick_piece_is_found() -> None:
    """The elbow goes through its stretched pose within a hundredth of the time, once there and once back."""
    chain = robot("ur5").chain(None, None)
    n, elbow = len(chain), 2
    widths, c = np.array([6.0, 0.03, 0.03, 6.0]), np.zeros((4, 2, n))
    c[:, 0] = [0.1, -1.0, 0.0, -1.2, 1.3, 0.2]
    c[:, 0, elbow], c[:, 1, elbow] = [0.9, 1.0, -0.02, 1.0], [0.1, -1.02, 1.02, -0.1]
    found = smallest_singular_value(Pieces(np.cumsum(widths) - widths, widths, c), chain)
    assert 6.0 < found.time < 6.06
    assert found.value < 1e-9


def test_positions_do_not_depend_on_the_order_of_the_times() -> None:
    motion = some_motion(robot("panda").chain(None, None), 6)
    times = np.sort(np.concatenate((motion.breaks, np.linspace(-0.1, 4.1, 60))))
    pieces, found = pieces_of(motion), PPoly(motion.coefficients[:, ::-1].swapaxes(0, 1), motion.breaks)
    for each in (times, times[::-1].copy(), np.random.default_rng(0).permutation(times)):
        assert positions_at(pieces, each) == pytest.approx(found(each), rel=1e-11, abs=1e-11)


@pytest.mark.parametrize("row", range(5))
def test_extremes_are_at_the_roots_of_the_derivative(row: int) -> None:
    rng, order = np.random.default_rng(row), max(row - 1, 0)
    size = (np.negative, np.positive, np.abs)[min(row, 2)]
    for degree in (3, 5, 7):
        c = rng.normal(size=(1, degree + 1, 3))
        found = joint_figures(Pieces(np.zeros(1), np.array([0.7]), c))
        for joint, column in enumerate(c[0].T):
            p = np.polynomial.Polynomial(column / 0.7 ** np.arange(degree + 1))
            p = p.deriv(order) if order else p
            roots = p.deriv().roots()
            inner = roots.real[(abs(roots.imag) < 1e-12) & (roots.real > 0.0) & (roots.real < 0.7)]
            places = np.concatenate(([0.0, 0.7], inner))
            best = places[size(p(places)).argmax()]
            value = -p(best) if row == 0 else p(best)
            assert (found.extremes[row, joint], found.times[row, joint]) == (
                pytest.approx(value, rel=1e-12),
                pytest.approx(best, abs=1e-7),
            )


def test_jumps_are_the_differences_where_pieces_meet() -> None:
    rng = np.random.default_rng(5)
    widths, c = rng.uniform(0.1, 1.0, 19), rng.normal(size=(19, 6, 4))
    starts = np.cumsum(widths) - widths
    found = joint_figures(Pieces(starts, widths, c * widths[:, None, None] ** np.arange(6)[:, None]))
    for order in range(4):
        p = [[np.polynomial.Polynomial(column).deriv(order) for column in piece.T] for piece in c]
        jumps = [
            [abs(a(h) - b(0.0)) for a, b in zip(*pair, strict=True)]
            for *pair, h in zip(p[:-1], p[1:], widths[:-1], strict=True)
        ]
        assert found.jumps[order] == pytest.approx(np.max(jumps, axis=0), rel=1e-12)
        assert (found.jump_times[order] == starts[1 + np.argmax(jumps, axis=0)]).all()


def test_the_joint_that_counts_is_the_nearest_to_its_limit() -> None:
    values, times = np.array([-3.0, 1.0, 2.0, 0.0]), np.arange(4.0)
    none = np.full(4, np.inf)
    assert worst(values, times, np.array([6.0, 1.0, 4.0, np.inf])) == (1.0, 1.0, 1.0, 1.0)
    assert worst(values, times, np.array([6.0, np.inf, 4.0, 1.0])) == (0.5, -3.0, 0.0, 0.0), "the first of equals"
    assert worst(values, times, none) == (-1.0, -3.0, 0.0, 0.0), "no limit"
    assert worst(values, times, np.array([1.0, 0.0, 1.0, 0.0])) == (np.inf, 1.0, 1.0, 1.0), "a limit of 0"
    assert worst(np.zeros(2), times, np.array([0.0, 1.0])) == (0.0, 0.0, 0.0, 0.0), "kept by 0"
    for limits in (np.ones(2), np.array([1.0, 0.0])):
        assert worst(np.array([9.0, np.nan]), times, limits)[2] == 1.0, "what is no number counts first"
