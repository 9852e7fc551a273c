"""Some seconds of mutations for each reader, the same ones each time; `./dev fuzz` goes on from there."""

import numpy as np
import pytest

from tests.fuzz.targets import TARGETS, Unsound

COUNTS = {"urdf": 6000, "dh": 5000, "npy": 40_000, "zip": 1000}
"""Inputs that take some three seconds."""
_SOME = 0.01
"""Share of the inputs that is taken at least: what tries out nothing but refusals tries out little."""


@pytest.mark.slow
@pytest.mark.parametrize("name", TARGETS)
def test_no_mutation_does_harm(name: str) -> None:
    target = TARGETS[name]
    target.warm()
    taken = 0
    for number, data in zip(range(COUNTS[name]), target.mutations(7).inputs(), strict=False):
        try:
            taken += target.judge(data)
        except Exception as error:
            raise AssertionError(f"{type(error).__name__}: {error}; input {number}: {data!r}") from error
    assert taken > _SOME * COUNTS[name]


@pytest.mark.parametrize("name", TARGETS)
def test_good_seeds_are_taken_and_bad_ones_refused(name: str) -> None:
    target = TARGETS[name]
    target.warm()
    assert all(target.judge(seed) for seed in target.seeds.good)
    assert not any(target.judge(seed) for seed in target.seeds.bad)


def test_the_same_seed_gives_the_same_inputs() -> None:
    target = TARGETS["urdf"]
    one, other, another = (target.mutations(number).inputs() for number in (3, 3, 4))
    first = [next(one) for _ in range(50)]
    assert first == [next(other) for _ in range(50)]
    assert first != [next(another) for _ in range(50)]


def test_harm_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    array = TARGETS["npy"]
    good = array.seeds.good[0]
    monkeypatch.setattr("tests.fuzz.targets.read_npy", lambda data: 1 / len(data[:0]))
    with pytest.raises(ZeroDivisionError):
        array.judge(good)
    monkeypatch.setattr("tests.fuzz.targets.read_npy", lambda _: np.zeros((2, 2)))
    with pytest.raises(Unsound, match="other numbers"):
        array.judge(good)
    monkeypatch.setattr("tests.fuzz.targets.MOST_SECONDS", 0.0)
    with pytest.raises(Unsound, match="it took"):
        TARGETS["zip"].judge(b"no zip")


def test_a_file_of_an_archive_that_is_not_what_was_packed_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.fuzz.targets.pieces", lambda _: [b"something else"])
    with pytest.raises(Unsound, match="other bytes"):
        TARGETS["zip"].judge(TARGETS["zip"].seeds.good[0])
