"""Encoders: the lecture's numbers, quadrature of a simulated shaft, and Gray code by its definition."""

from math import ceil, degrees, floor, log2, pi, radians
from typing import cast

import numpy as np
import pytest

from gelenk.course.actuators import encoders
from gelenk.course.actuators.encoders import (
    COUNTS_A_LINE,
    Decoding,
    required,
    required_step,
    resolution,
    resolution_steps,
)
from gelenk.course.actuators.quadrature import Samples, decoded, read_samples
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from tests.oracles import written

# Resolution


@pytest.mark.parametrize(
    ("counts", "gear_ratio", "at_load"),
    [
        (1024 * 4, 1.0, "0.087890625"),
        (1024 * 4, 50.0, "0.0017578125"),
        (2**13, 1.0, "0.043945312"),
    ],
    ids=["1024 lines, x4", "the same behind a gear of 50", "13 bit"],
)
def test_the_resolutions_of_the_lecture_in_degrees(counts: int, gear_ratio: float, at_load: str) -> None:
    assert f"{degrees(resolution(counts, gear_ratio).load):.12f}".startswith(at_load)


def test_a_hundredth_of_a_degree_needs_16_bits() -> None:
    found = required(radians(0.01), 1.0, "x4")
    assert (found.counts_per_revolution, found.bits) == (36000, 16)


def test_the_velocity_quantum_of_the_lecture() -> None:
    """4096 counts a turn, taken every millisecond."""
    assert f"{resolution(4096, 1.0, sample_period=1e-3).motor_velocity_quantum:.9f}" == "1.533980788"


def test_the_encoder_of_the_exam() -> None:
    """De Luca, 16-11-2018: a thousandth of a degree at the link, behind a gear of 128, at 402.1239 rad/s."""
    found = required(radians(1e-3), 128.0, "x4", 402.1239)
    assert degrees(found.motor_resolution) == pytest.approx(0.128)
    assert found.counts_per_revolution == 2813
    assert found.bits == 12
    assert found.pulses_per_revolution == 704
    assert f"{found.count_rate:.3f}" == "180032.018"
    assert "2813" in str(required_step(found, "x4"))


@pytest.mark.parametrize("decoding", ["x1", "x2", "x4"])
@pytest.mark.parametrize("gear_ratio", [0.5, 1.0, 128.0])
def test_what_is_required_is_enough_and_less_is_not(decoding: Decoding, gear_ratio: float) -> None:
    for angle in np.geomspace(1e-7, 1.0, 40):
        found = required(angle, gear_ratio, decoding)
        counts = found.counts_per_revolution
        assert resolution(counts, gear_ratio).load <= angle * (1 + 1e-9)
        assert counts == 1 or resolution(counts - 1, gear_ratio).load > angle
        assert 2**found.bits >= counts
        assert found.bits == max(1, ceil(log2(counts)))
        lines = found.pulses_per_revolution
        assert lines * COUNTS_A_LINE[decoding] >= counts > (lines - 1) * COUNTS_A_LINE[decoding]


@pytest.mark.parametrize("gear_ratio", [1.0, 3.0, 50.0, 128.0])
def test_a_whole_number_of_counts_is_not_rounded_up(gear_ratio: float) -> None:
    """Whatever the division of a turn in degrees, by the counts and the gear, has rounded."""
    for whole in [*range(1, 2000), 36_000, 1_296_000]:
        assert required(radians(360.0 / whole / gear_ratio), gear_ratio, "x1").counts_per_revolution == whole


def test_the_worked_resolution_holds_the_numbers() -> None:
    text = str(resolution_steps(4096, 50.0, r"1024 \cdot 4"))
    assert "0.087890625" in text
    assert "0.0017578125" in text


# Quadrature


def shaft(angles: Array, lines: int, index_width: float = 0.0) -> Samples:
    """What the discs of a shaft show: B is A a quarter of a line later; Z is on for a while once a turn.

    By the geometry of the disc: A is dark where the line's phase is in [1/4, 3/4), B where it is in [1/2, 1).
    """
    phase = angles * lines / (2.0 * np.pi) % 1.0
    a, b = (phase >= 0.25) & (phase < 0.75), phase >= 0.5
    index = (angles % (2.0 * np.pi)) < index_width if index_width else None
    return Samples(2 * a.astype(np.int64) + b, index)


def test_the_forward_order_of_the_lecture() -> None:
    found = decoded(read_samples("00 10 11 01 00", "samples"), "x4")
    assert found.counts == [0, 1, 2, 3, 4]
    assert found.direction == "forward"
    backward = decoded(read_samples("00 01 11 10 00", "samples"), "x4")
    assert backward.counts == [0, -1, -2, -3, -4]
    assert backward.direction == "backward"


@pytest.mark.parametrize(("decoding", "edges"), [("x1", [0.25]), ("x2", [0.25, 0.75]), ("x4", [0.0, 0.25, 0.5, 0.75])])
def test_counts_of_a_shaft_that_wanders(decoding: Decoding, edges: list[float]) -> None:
    """The count is the number of edges between the start and the shaft, whatever the way there."""
    rng = np.random.default_rng(1)
    lines = 12
    for _ in range(20):
        speeds = np.cumsum(rng.normal(size=4000))
        angles = 0.3 + np.cumsum(speeds / np.abs(speeds).max()) * 0.9 * 2.0 * np.pi / (4 * lines)
        passed = np.array([sum(floor(turn * lines - edge) for edge in edges) for turn in angles / (2.0 * np.pi)])
        found = decoded(shaft(angles, lines), decoding)
        assert found.counts == (passed - passed[0]).tolist()
        assert found.illegal_transitions == []
        assert found.direction == {0: "none", 1: "forward", -1: "backward"}[int(np.sign(passed[-1] - passed[0]))]


@pytest.mark.parametrize("decoding", ["x1", "x2", "x4"])
def test_a_shaft_that_trembles_on_an_edge_stays_where_it_is(decoding: Decoding) -> None:
    for first, second in (("00", "10"), ("10", "11"), ("11", "01"), ("01", "00")):
        found = decoded(read_samples(" ".join([first, second] * 50 + [first]), "samples"), decoding)
        assert found.counts[-1] == 0
        assert np.ptp(found.counts) <= 1
        assert found.reversals == 99


def test_illegal_transitions_are_where_both_channels_change() -> None:
    text = "00 11 01 10 10 00 11"
    found = decoded(read_samples(text, "samples"), "x4")
    groups = text.split()
    both = [i for i in range(1, 7) if all(x != y for x, y in zip(groups[i - 1], groups[i], strict=True))]
    assert found.illegal_transitions == both == [1, 3, 6]
    assert found.counts == [0, 0, 1, 1, 1, 0, 0]


def test_a_shaft_faster_than_the_sampling_shows_illegal_transitions() -> None:
    angles = np.linspace(0.01, 0.01 + 199 * 2.0 * (2.0 * np.pi / 48), 200)
    assert len(decoded(shaft(angles, 12), "x4").illegal_transitions) == 199


def test_the_index_comes_once_a_turn_and_tells_lost_counts() -> None:
    lines, turns = 16, 3.5
    angles = np.linspace(-0.5, turns * 2.0 * np.pi - 0.5, 2000)
    samples = shaft(angles, lines, index_width=0.05)
    found = decoded(samples, "x4", 4 * lines)
    assert [pulse.count - found.index_pulses[0].count for pulse in found.index_pulses] == [0, 64, 128, 192]
    assert [pulse.count_error for pulse in found.index_pulses] == [0, 0, 0, 0]
    between = (found.index_pulses[1].sample + found.index_pulses[2].sample) // 2
    assert samples.index is not None
    kept = np.r_[0:between, between + 60 : 2000]
    lossy = decoded(Samples(samples.states[kept], samples.index[kept]), "x4", 4 * lines)
    expected = lossy.index_pulses[2].count - lossy.index_pulses[0].count - 128
    assert expected != 0
    assert [pulse.count_error for pulse in lossy.index_pulses] == [0, 0, expected, expected]
    assert decoded(samples, "x4").index_pulses[1].count_error is None


@pytest.mark.parametrize("count", [-70000, -1, 0, 5, 65535, 65536, 200_000])
def test_a_register_is_the_count_by_twos_complement(count: int) -> None:
    # A count a sample, forward or backward.
    states = np.array([0, 2, 3, 1])[np.arange(0, count + np.sign(count) or 1, np.sign(count) or 1) % 4]
    assert decoded(Samples(states, None), "x4", counter_bits=16).register_value == int(
        np.int64(count).astype(np.uint16)
    )


@pytest.mark.parametrize("text", ["00 10 11", "00,10,11", "00; 10;\n11 ", " 00\t10 11"])
def test_how_samples_may_be_written(text: str) -> None:
    assert read_samples(text, "samples").states.tolist() == [0, 2, 3]
    assert read_samples(text, "samples").index is None


def test_a_third_digit_is_the_index() -> None:
    found = read_samples("001 100 111", "samples")
    assert found.states.tolist() == [0, 2, 3]
    assert found.index is not None
    assert found.index.tolist() == [True, False, True]


@pytest.mark.parametrize("text", ["", "  ", "0", "00 1", "00 0a", "00 1011", "00 101", "0٠", "00 \ud800"])
def test_what_are_no_samples(text: str) -> None:
    with pytest.raises(InvalidField, match="samples"):
        read_samples(text, "samples")


# Gray code


def test_the_gray_code_of_the_lecture() -> None:
    assert [row.gray for row in encoders.table(3)] == ["000", "001", "011", "010", "110", "111", "101", "100"]


@pytest.mark.parametrize("bits", range(1, 13))
def test_neighbours_differ_in_one_track_and_no_code_comes_twice(bits: int) -> None:
    codes = [encoders.gray(value) for value in range(2**bits)]
    assert sorted(codes) == list(range(2**bits))
    for code, following in zip(codes, codes[1:] + codes[:1], strict=True):
        assert (code ^ following).bit_count() == 1
    assert [encoders.binary(code) for code in codes] == list(range(2**bits))


def test_there_and_back_for_wide_discs() -> None:
    for value in np.random.default_rng(0).integers(0, 2**32, 500).tolist():
        assert encoders.binary(encoders.gray(value)) == value
        place = encoders.position(value, 32)
        assert int(place.binary, 2) == value
        assert place.angle == pytest.approx(2.0 * pi * value / 2**32)


@pytest.mark.parametrize("code", ["gray", "binary"])
def test_readings_of_either_code(code: encoders.Code) -> None:
    rows = encoders.table(5)
    texts = [cast(str, getattr(row, code)) for row in rows]
    assert encoders.read_codes(texts, code, 5, "readings") == rows


@pytest.mark.parametrize("text", ["", "0", "0000", "00a", "0 1", "-01", "0٠1", "0b1", "1_1"])
def test_what_are_no_codes(text: str) -> None:
    with pytest.raises(InvalidField, match="readings/1"):
        encoders.read_codes(["010", text], "gray", 3, "readings")


def test_a_turn_ends_and_the_count_goes_on() -> None:
    rng = np.random.default_rng(2)
    bits = 6
    steps = rng.integers(-31, 32, 500)
    true = 17 + np.concatenate(([0], np.cumsum(steps)))
    found = encoders.unwrapped((true % 2**bits).tolist(), bits)
    assert (np.array(found) - found[0]).tolist() == (true - true[0]).tolist()
    assert encoders.unwrapped([], 4) == []
    assert encoders.unwrapped([15, 0, 1, 0, 15], 4) == [15, 16, 17, 16, 15]
    assert encoders.unwrapped([0, 1, 0], 1) == [0, -1, -2]


def test_the_worked_code() -> None:
    steps = encoders.code_step([encoders.position(4, 3)])
    assert steps.latex[1:] == (r"b = 100_2 = 4,\quad g = 110",)


@pytest.mark.parametrize("code", ["gray", "binary"])
def test_every_reading_is_decoded(code: encoders.Code) -> None:
    """Up to a hundred; the text says where there are more. Each binary digit is a parity of Gray digits."""
    rows = [encoders.position(value % 64, 6) for value in range(130)]
    found = encoders.reading_step(rows, code, 6)
    lines = found.latex[code == "gray" :]
    assert len(lines) == 100
    assert found.text.endswith("Shown are the first 100 of 130.")
    for row, line in zip(rows, lines, strict=False):
        if code == "gray":
            digits = [sum(map(int, row.gray[: i + 1])) % 2 for i in range(6)]
            assert line.startswith(rf"g = {row.gray}:\quad b = {''.join(map(str, digits))}_2 = {row.value},")
        shown = line.partition(rf"\frac{{{row.value}}}{{2^{{6}}}} \cdot 2\pi = ")[2].removesuffix(r"\,\mathrm{rad}")
        assert written.value(shown) == pytest.approx(2 * np.pi * row.value / 64, abs=1e-8)
