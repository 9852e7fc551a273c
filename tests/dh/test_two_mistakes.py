"""What people get wrong in a table, alone and two of them together, made by other means than what undoes it."""

import itertools
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from typing import Literal, TypeAlias

import numpy as np
import pytest

from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.compare import Comparison, compare
from gelenk.robot.dh import DhJoint, DhTable
from tests.oracles import catalogue
from tests.robots import of_table, rows, table

PLACES = Freedom(base=True, tool=True, offsets=False, signs=False)
Q = np.pi / 2
Maker: TypeAlias = Callable[[np.random.Generator, DhTable], DhTable | None]


def random_table(seed: int) -> DhTable:
    """Six or seven joints whose axes lie in general, or with quarter turns, zeros and a sliding joint."""
    rng = np.random.default_rng(seed)
    count = 6 + seed % 2
    numbers = rng.uniform([0.05, 0.4, 0.05, 0.4], [0.6, 2.7, 0.6, 2.7], (count, 4)) * rng.choice([1, -1], (count, 4))
    types = "R" * count
    if seed % 3 == 2:
        special = rng.random((count, 4)) < 0.4
        plain = np.column_stack((np.zeros(count), rng.choice([Q, -Q], count), np.zeros(count), np.zeros(count)))
        numbers = np.where(special, plain, numbers)
        types = "RRP" + types[3:]
    convention: Literal["standard", "modified"] = "standard" if seed % 4 < 2 else "modified"
    return rows(convention, [(row[0], row[1], row[2], row[3]) for row in numbers.tolist()], types)


OWN = set(catalogue.TABLES) - catalogue.ARMS
SIX = [name for name in sorted(OWN) if len(catalogue.dh_table(name)["joints"]) >= 6]
TABLES = {name: replace(table(catalogue.dh_table(name)), base=np.eye(4), tool=np.eye(4)) for name in SIX}
TABLES |= {f"random-{seed}": random_table(seed) for seed in range(20 - len(SIX) + 4)}


def renumbered(dh: DhTable, change: Callable[[int, DhJoint], dict[str, float]]) -> DhTable | None:
    """Other numbers in some rows; None where none has changed."""
    joints = tuple(replace(joint, **change(i, joint)) for i, joint in enumerate(dh.joints))  # type: ignore[arg-type]
    return None if joints == dh.joints else replace(dh, joints=joints)


def one(rng: np.random.Generator, dh: DhTable, names: str, change: Callable[[float], float]) -> DhTable | None:
    """Another number in a place where there is one that counts: neither in the first nor in the last row."""
    places = [
        (i, name)
        for i in range(1, len(dh.joints) - 1)
        for name in names.split()
        if abs(getattr(dh.joints[i], name)) > 1e-3
    ]
    if not places:
        return None
    row, name = places[rng.integers(len(places))]
    return renumbered(dh, lambda i, joint: {name: change(getattr(joint, name))} if i == row else {})


def scaled(names: str, factor: float) -> Maker:
    return lambda _, dh: renumbered(dh, lambda _, row: {name: factor * getattr(row, name) for name in names.split()})


def row_scaled(names: str, factor: float) -> Maker:
    def make(rng: np.random.Generator, dh: DhTable) -> DhTable | None:
        first, second = names.split()
        full = [i for i, row in enumerate(dh.joints) if getattr(row, first) and getattr(row, second)]
        among = [i for i in full if 0 < i < len(dh.joints) - 1]
        if not among:
            return None
        chosen = among[rng.integers(len(among))]
        return renumbered(
            dh, lambda i, row: {name: factor * getattr(row, name) for name in names.split()} if i == chosen else {}
        )

    return make


def exchanged(first: str, second: str, throughout: bool) -> Maker:
    def make(rng: np.random.Generator, dh: DhTable) -> DhTable | None:
        chosen = int(rng.integers(1, len(dh.joints) - 1))
        return renumbered(
            dh,
            lambda i, row: (
                {first: getattr(row, second), second: getattr(row, first)} if throughout or i == chosen else {}
            ),
        )

    return make


def row_missing(rng: np.random.Generator, dh: DhTable) -> DhTable:
    joints = list(dh.joints)
    del joints[rng.integers(1, len(joints) - 1)]
    return replace(dh, joints=tuple(joints))


def row_doubled(rng: np.random.Generator, dh: DhTable) -> DhTable:
    joints = list(dh.joints)
    i = int(rng.integers(1, len(joints) - 1))
    joints.insert(i, replace(joints[i], name=f"again {len(joints)}"))
    return replace(dh, joints=tuple(joints))


def rows_swapped(rng: np.random.Generator, dh: DhTable) -> DhTable | None:
    joints = list(dh.joints)
    i = int(rng.integers(len(joints) - 1))
    joints[i : i + 2] = joints[i + 1], joints[i]
    same = [getattr(joints[i], name) == getattr(joints[i + 1], name) for name in ("type", "a", "alpha", "d", "theta")]
    return None if all(same) else replace(dh, joints=tuple(joints))


def other_convention(_: np.random.Generator, dh: DhTable) -> DhTable:
    return replace(dh, convention="modified" if dh.convention == "standard" else "standard")


def nudged(value: float) -> float:
    return value + (0.123 if value < 0 else -0.117)


MAKERS: dict[str, tuple[str, Maker]] = {
    "sign": ("sign", lambda rng, dh: one(rng, dh, "a alpha d theta", lambda x: -x)),
    "signs of a column": ("sign", scaled("alpha", -1.0)),
    "degrees": ("degrees", scaled("alpha theta", 180 / np.pi)),
    "degrees of alpha": ("degrees", scaled("alpha", 180 / np.pi)),
    "degrees once": ("degrees", lambda rng, dh: one(rng, dh, "alpha theta", lambda x: float(np.degrees(x)))),
    "degrees in a row": ("degrees", row_scaled("alpha theta", 180 / np.pi)),
    "millimetres": ("millimetres", scaled("a d", 1000.0)),
    "centimetres": ("centimetres", scaled("a d", 100.0)),
    "tenfold": ("power_of_ten", scaled("a d", 10.0)),
    "kilometres": ("power_of_ten", scaled("a d", 0.001)),
    "millimetres of a": ("millimetres", scaled("a", 1000.0)),
    "centimetres once": ("centimetres", lambda rng, dh: one(rng, dh, "a d", lambda x: 100.0 * x)),
    "millimetres in a row": ("millimetres", row_scaled("a d", 1000.0)),
    "a tenth in a row": ("power_of_ten", row_scaled("a d", 0.1)),
    "a and d": ("columns", exchanged("a", "d", throughout=True)),
    "a and d in a row": ("columns", exchanged("a", "d", throughout=False)),
    "alpha and theta": ("columns", exchanged("alpha", "theta", throughout=True)),
    "alpha and theta in a row": ("columns", exchanged("alpha", "theta", throughout=False)),
    "rows": ("rows", rows_swapped),
    "row missing": ("row_missing", row_missing),
    "row doubled": ("row_doubled", row_doubled),
    "convention": ("convention", other_convention),
    "number": ("number", lambda rng, dh: one(rng, dh, "a alpha d theta", nudged)),
}


def asked(right: DhTable, wrong: DhTable) -> Comparison:
    arm = of_table(right)
    return compare(arm, arm.chain(None, None), wrong, PLACES)


def made(right: DhTable, names: tuple[str, ...], seed: int) -> DhTable | None:
    """A table with mistakes, one after the other; None where one of them changes nothing."""
    rng = np.random.default_rng(seed)
    wrong: DhTable | None = right
    for name in names:
        wrong = None if wrong is None else MAKERS[name][1](rng, wrong)
    return wrong


def named(comparison: Comparison, names: tuple[str, ...]) -> bool:
    """Whether a diagnosis has these mistakes and no others."""
    kinds = sorted(MAKERS[name][0] for name in names)
    return any(sorted(each.mistakes) == kinds for each in comparison.diagnoses)


def explained(right: DhTable, names: tuple[str, ...], seed: int) -> str | None:
    """What is said of a table with mistakes; None where nothing is wrong with it, "named" where they are named."""
    wrong = made(right, names, seed)
    comparison = None if wrong is None else asked(right, wrong)
    if comparison is None or comparison.equivalent:
        return None
    if named(comparison, names):
        return "named"
    return f"{len(comparison.diagnoses[0].mistakes)} mistakes" if comparison.diagnoses else "nothing"


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", MAKERS)
@pytest.mark.parametrize("arm", ["ur5_dh", "panda_dh", "puma560", "random-0", "random-2", "random-3"])
def test_a_mistake_is_named(arm: str, name: str) -> None:
    assert explained(TABLES[arm], (name,), seed=len(arm) + len(name)) in {"named", None}


@pytest.mark.slow
@pytest.mark.parametrize("arm", list(TABLES)[::3])
def test_every_mistake_is_named(arm: str) -> None:
    for seed, name in enumerate(MAKERS):
        assert explained(TABLES[arm], (name,), seed) in {"named", None}, (name, seed)


TOGETHER = list(itertools.product(MAKERS, repeat=2))


@pytest.mark.quick(3)
@pytest.mark.parametrize(("names", "arm"), list(zip(TOGETHER[::9], itertools.cycle(TABLES), strict=False)))
def test_two_mistakes_are_named(names: tuple[str, str], arm: str) -> None:
    """Or a single one that makes the same table: millimetres of centimetres, a wrong number in a row left out."""
    assert explained(TABLES[arm], names, seed=7) in {"named", "1 mistakes", None}


@pytest.mark.slow
@pytest.mark.parametrize(("number", "arm"), list(enumerate(TABLES)))
def test_any_two_mistakes_are_named(number: int, arm: str) -> None:
    """A quarter of all pairs, each on one of the tables."""
    said = Counter(explained(TABLES[arm], names, number) for names in TOGETHER[number :: 4 * len(TABLES)])
    assert said["nothing"] == 0
    assert said["named"] >= 0.5 * (said.total() - said[None])
