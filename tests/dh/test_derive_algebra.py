"""The algebra of a worked solution against the values of what it turns into one another."""

import cmath
from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from sympy.core import random as sympy_random

from gelenk.dh.derive import factors as factoring
from gelenk.dh.derive.algebra import (
    LENGTH,
    MAX_TERMS,
    ONE,
    ROOT,
    ZERO,
    Angle,
    Atom,
    Polynomial,
    TooManyTerms,
    angle_sum,
    cosine,
    cross,
    derivative,
    number,
    reduced,
    sine,
    symbol,
    total,
)
from gelenk.dh.derive.factors import factorised, without_multiples

A2, A3, D4 = (symbol(Atom(LENGTH, (index,), name)) for index, name in ((2, "a"), (3, "a"), (4, "d")))
CONFIGURATIONS = [[Random(seed * 6 + k).uniform(-3.0, 3.0) for k in range(6)] for seed in range(4)]


def group(index: int) -> int:
    """Joints 2, 3 and 4 are parallel, all others alone."""
    return 2 if index in {2, 3, 4} else index


def value(polynomial: Polynomial, q: Sequence[complex]) -> complex:
    """What it is at these joint angles, by the complex functions of the standard library."""
    result = 0j
    for monomial, factor in polynomial:
        term = complex(factor)
        for atom, power in monomial:
            term *= _atom(atom, q) ** power
        result += term
    return result


def _atom(atom: Atom, q: Sequence[complex]) -> complex:
    if atom.kind == ROOT:
        return cmath.sqrt(atom.indices[0])
    if atom.kind == LENGTH:
        return 0.1 + 0.37 * atom.indices[0]
    angle = sum(q[abs(index)] * (1 if index > 0 else -1) for index in atom.indices)
    return cmath.cos(angle) if atom.name == "c" else cmath.sin(angle)


def is_zero(polynomial: Polynomial) -> bool:
    """Whether it vanishes at a few configurations drawn at random."""
    return all(abs(value(polynomial, q)) < 1e-9 for q in CONFIGURATIONS)


def parallel_sum(indices: Sequence[int]) -> Angle:
    """The sum of those angles that are parallel to the first."""
    result: Angle = ()
    for index in indices:
        if group(abs(index)) == group(abs(indices[0])):
            result = angle_sum(result, (index,))
    return result


ANGLE = st.lists(st.sampled_from([1, 2, 3, 4, 5, -2, -3]), min_size=1, max_size=3).map(parallel_sum)
WAVE = st.builds(lambda angle, kind: (cosine if kind else sine)(angle), ANGLE, st.booleans())
TERM = st.builds(
    lambda waves, length, factor: reduce(lambda x, y: x * y, waves, length * number(factor)),
    st.lists(WAVE, min_size=1, max_size=3),
    st.sampled_from([A2, A3, D4, ONE]),
    st.integers(-3, 3),
)
POLYNOMIAL = st.lists(TERM, min_size=1, max_size=3).map(total)


@given(POLYNOMIAL)
@settings(max_examples=100, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
def test_reducing_leaves_the_function_and_one_wave_a_group(polynomial: Polynomial) -> None:
    short = reduced(polynomial, group)
    for q in CONFIGURATIONS:
        assert value(short, q) == pytest.approx(value(polynomial, q), abs=1e-9)
    for monomial, _ in short:
        groups = [group(abs(atom.indices[0])) for atom, _ in monomial if atom.name in {"c", "s"}]
        assert len(groups) == len(set(groups))


@given(POLYNOMIAL)
@settings(max_examples=100, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
def test_a_reduced_polynomial_is_zero_only_where_the_function_is(polynomial: Polynomial) -> None:
    assert bool(reduced(polynomial, group)) != is_zero(polynomial)
    assert not reduced(polynomial - reduced(polynomial, group), group)


@given(st.lists(WAVE, min_size=1, max_size=2, unique=True).map(total), st.sampled_from([1, 2, 3]))
@settings(max_examples=50, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
def test_derivatives_by_a_complex_step(polynomial: Polynomial, index: int) -> None:
    for q in CONFIGURATIONS:
        stepped = [angle + (1e-20j if k == index else 0.0) for k, angle in enumerate(q)]
        rate = value(polynomial, stepped).imag / 1e-20
        assert value(derivative(polynomial, index), q).real == pytest.approx(rate, abs=1e-12)


def drawn(random: Random) -> Polynomial:
    """A polynomial like POLYNOMIAL's; the same ones each time, since they are not equally quick to factorise."""
    terms = []
    for _ in range(random.randint(1, 3)):
        term = random.choice([A2, A3, D4, ONE]) * number(random.choice([-3, -2, -1, 1, 2, 3]))
        for _ in range(random.randint(1, 3)):
            wave = random.choice([sine, cosine])
            term = term * wave(parallel_sum(random.choices([1, 2, 3, 4, 5, -2, -3], k=random.randint(1, 3))))
        terms.append(term)
    return total(terms)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_a_factorisation_multiplies_out_to_what_was_factorised(seed: int) -> None:
    random = Random(seed)
    for _ in range(8):
        polynomial = reduced(drawn(random) * drawn(random), group)
        if not polynomial or len(polynomial) > 40:
            continue
        factor, factors = factorised(polynomial, group)
        assert reduce(lambda x, y: reduced(x * y, group), factors, number(factor)) == polynomial


def test_a_factorisation_draws_the_same_numbers_each_time() -> None:
    product = reduced((A2 + A3 * cosine((3,))) * (A2 * cosine((2,)) + A3 * cosine((2, 3))), group)
    left = []
    for begun in (1, 2):
        sympy_random.seed(begun)
        factorised(product, group)
        left.append(sympy_random.rng.getstate())
    assert left[0] == left[1]


def test_factors_that_would_take_long_to_find_are_not_looked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(factoring, "MAX_HALF_ANGLE_TERMS", 11)
    product = reduced((A2 + A3 * cosine((3,))) * (A2 * cosine((2,)) + A3 * cosine((2, 3))), group)
    factor, found = factorised(product, group)
    assert len(found) == 1
    assert number(factor) * found[0] == product


C2, S2, C3, S3, S5 = cosine((2,)), sine((2,)), cosine((3,)), sine((3,)), sine((5,))
C23, S23, S234 = cosine((2, 3)), sine((2, 3)), sine((2, 3, 4))


@pytest.mark.parametrize(
    "factors",
    [
        [S3, S5, A2 * C2 + A3 * C23 + D4 * S234],
        [S3, A2 * C2 + A3 * C23],
        [A2 + A3 * C3, A2 * C2 + A3 * C23],
        [A2 + A3 * C3, A2 + A3 * C3],
        [S2, C2, S3],
        [ONE + C3, A2 + D4 * S5],
        [A2 + A3, S23, C3],
    ],
    ids=lambda factors: " ".join(str(len(factor)) for factor in factors),
)
def test_factors_with_common_angles_are_found_again(factors: list[Polynomial]) -> None:
    product = reduce(lambda left, right: reduced(left * right, group), factors, ONE)
    _, found = factorised(product, group)
    wanted = [reduced(factor, group) for factor in factors]
    assert sorted(map(sorted, (f.terms for f in found))) == sorted(map(sorted, (f.terms for f in wanted)))


def test_doubled_angles_are_written_by_single_ones_where_that_is_shorter() -> None:
    factor, short = without_multiples(ONE + cosine((3, 3)))
    assert (factor, short) == (Fraction(2), C3 * C3)
    assert without_multiples(C2 + sine((3, 3))) == (Fraction(1), C2 + sine((3, 3)))


def test_names_of_waves_are_unique() -> None:
    assert cosine((-2, -3)) == C23
    assert sine((-2, -3)) == -S23
    assert (sine(()), cosine(())) == (ZERO, ONE)
    assert [cosine((2,), quarters) for quarters in range(4)] == [C2, -S2, -C2, S2]
    assert angle_sum((2, 3), (3,), -1) == (2,)


def test_roots_are_squared_away() -> None:
    root = symbol(Atom(ROOT, (2,), "sqrt"))
    assert reduced(root * root * C2, group) == number(2) * C2


def test_a_vector_product() -> None:
    assert cross((ONE, ZERO, ZERO), (ZERO, ONE, ZERO)) == (ZERO, ZERO, ONE)


def test_what_nobody_would_read_is_refused_and_not_waited_for() -> None:
    long = total(symbol(Atom(LENGTH, (index,), "a")) for index in range(MAX_TERMS))
    with pytest.raises(TooManyTerms):
        long * long
