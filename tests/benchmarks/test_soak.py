"""The soak, short: every operation is called, none breaks, and memory is measured."""

import pytest

from tests.benchmarks.soak import Times, measured


@pytest.mark.slow
def test_a_short_one_tells_of_answers_and_memory() -> None:
    # By then the processes are replaced that have loaded what is seldom needed, which gives memory back.
    (row,) = measured(Times(warm_up=40.0, measured=10.0, plateau=4.0))
    assert int(row.measured.split()[0]) > 50  # a busy machine answers few
    assert "unexpected none" in row.measured
    assert row.ratio is not None
    assert 0.7 < row.ratio < 1.3
