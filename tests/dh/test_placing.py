"""How frames are placed: what follows from the lines of the axes alone is what the table says."""

import math
import re
from typing import get_args

import numpy as np
import pytest

from gelenk.dh.compare.of_chain import dh_of_chain
from gelenk.dh.placing import PairKind, axis_pairs, placing_steps
from gelenk.dh.table_steps import conversion_steps, table_array
from gelenk.dh.tables.columns import Column
from gelenk.dh.tables.convert import converted
from gelenk.robot.dh import Convention, DhTable
from tests.oracles import catalogue
from tests.robots import robot, swept

TOLERANCES = {"so101": 1e-6}
"""Arms some of whose axes the table takes as parallel though they are not quite."""


def parameters(table: DhTable) -> list[tuple[float, float, float, float]]:
    """a, α, d and ϑ of each index, a and α of the last one NaN in a modified table, which has none."""
    links = [(row.a, row.alpha) for row in table.joints]
    if table.convention == "modified":
        links = [*links[1:], (math.nan, math.nan)]
    return [(*link, row.d, row.theta) for link, row in zip(links, table.joints, strict=True)]


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_the_lines_of_the_axes_give_the_rows(name: str, convention: Convention) -> None:
    chain = robot(name).chain(None, None)
    table, _, _ = dh_of_chain(robot(name), chain, convention)
    for pair, (a, alpha, d, theta) in zip(axis_pairs(chain, table), parameters(table), strict=True):
        off = np.array([pair.d - d, math.remainder(pair.theta - theta, 2.0 * math.pi)])
        assert np.abs(off).max() < TOLERANCES.get(name, 1e-8)
        if not math.isnan(a):
            off = np.array([pair.a - a, math.remainder(pair.alpha - alpha, 2.0 * math.pi)])
            assert np.abs(off).max() < TOLERANCES.get(name, 1e-8)
        for x in (pair.x_before, pair.x):  # the two conditions of Denavit and Hartenberg, and that x is a unit vector
            assert abs(float(x @ pair.z)) < 1e-6
        assert abs(float(pair.x @ pair.z_next)) < 1e-3  # the tool takes up a small tilt of the tip
        assert np.linalg.norm(pair.x) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("ur5", ["intersecting", "parallel", "parallel", "intersecting", "intersecting"]),
        ("scara", ["parallel", "parallel"]),
        ("stanford", ["intersecting", "intersecting"]),
        ("panda", ["intersecting", "intersecting", "skew", "skew", "intersecting", "skew"]),
    ],
)
def test_pairs_of_axes_are_what_the_arm_is_known_for(name: str, kinds: list[PairKind]) -> None:
    chain = robot(name).chain(None, None)
    table, _, _ = dh_of_chain(robot(name), chain, "standard")
    assert [pair.kind for pair in axis_pairs(chain, table)][: len(kinds)] == kinds


def test_steps_are_axes_frame_0_a_step_for_each_pair_and_the_table() -> None:
    chain = robot("ur5").chain(None, None)
    table, _, _ = dh_of_chain(robot("ur5"), chain, "standard")
    steps = placing_steps(chain, table, ("a", "d", "alpha", "theta"))
    assert [step.title for step in steps] == [
        "Axes of the joints", "Frame 0", "Frame 1: intersecting axes", "Frame 2: parallel axes",
        "Frame 3: parallel axes", "Frame 4: intersecting axes", "Frame 5: intersecting axes",
        "Frame 6: axes on one line", "The table",
    ]  # fmt: skip
    assert r"a_{2} = x_{2} \cdot (O_{2} - F_{2}) = 0.425" in steps[3].latex
    assert steps[2].latex[4].endswith(r"= -\frac{\pi}{2}")
    assert r"i & a_{i} & d_{i} & \alpha_{i} & \vartheta_{i} \\ \hline 1 & 0 & 0.089159 &" in steps[-1].latex[0]
    assert not any("\\" in line for step in steps for line in step.plain)


@pytest.mark.slow
def test_every_kind_of_pair_is_met_and_every_text_is_filled_in() -> None:
    met = set()
    for name in catalogue.NAMES:
        chain = robot(name).chain(None, None)
        for convention in ("standard", "modified"):
            table, _, _ = dh_of_chain(robot(name), chain, convention)
            met |= {pair.kind for pair in axis_pairs(chain, table)}
        for step in placing_steps(chain, table):
            assert not re.search(r"\{\w*\}", step.title + step.text)
    assert met == set(get_args(PairKind))


@pytest.mark.parametrize("order", [("a", "d", "alpha", "theta"), ("theta", "d", "a", "alpha")])
def test_columns_are_in_the_order_asked_for(order: tuple[Column, ...]) -> None:
    table, _, _ = dh_of_chain(robot("stanford"), robot("stanford").chain(None, None), "standard")
    usual, other = (
        table_array(table, columns).split(r"\hline ")[1] for columns in (("a", "alpha", "d", "theta"), order)
    )
    for row, same in zip(usual.split(r" \\ "), other.split(r" \\ "), strict=True):
        i, *cells = row.removesuffix(r" \end{array}").split(" & ")
        named = dict(zip(("a", "alpha", "d", "theta"), cells, strict=True))
        assert same.removesuffix(r" \end{array}") == " & ".join((i, *(named[column] for column in order)))


def test_the_steps_of_a_conversion_have_both_tables() -> None:
    table, _, _ = dh_of_chain(robot("panda"), robot("panda").chain(None, None), "modified")
    other = converted(table, "standard")
    steps = conversion_steps(table, other)
    assert [step.latex[0] for step in (steps[0], steps[-1])] == [table_array(table), table_array(other)]
    assert r"a_{3} = 0.0825,\quad \alpha_{3} = \frac{\pi}{2}" in steps[1].latex
    assert len(conversion_steps(table, converted(table, "modified"))) == 1
