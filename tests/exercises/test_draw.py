"""Numbers by their annotations, and what a wrong model makes of them."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.exercises.arms import angles_not_summed, jacobian, misread, own_links
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Exercise
from gelenk.exercises.fields import quantity


class Numbers(NamedTuple):
    size: Annotated[float, Draw.decimal, 1.0, 2.0, 0.5]
    kind: Annotated[str, Draw.choice, ("a", "b")]
    fixed: float = 48.0


class Arm(NamedTuple):
    l1: float = 0.5
    l2: float = 0.4
    q1: float = 30.0
    q2: float = 60.0


def test_fields_are_drawn_in_their_order_within_their_ranges() -> None:
    source = Draw("x")
    expected = Numbers(source.decimal(1.0, 2.0, 0.5), source.choice(("a", "b")))
    assert drawn(Numbers)(Draw("x")) == expected
    found = {drawn(Numbers, size=(Draw.integer, 7, 8))(Draw(str(seed))) for seed in range(50)}
    assert found == {Numbers(size, kind) for size in (7, 8) for kind in ("a", "b")}


def test_a_model_may_return_other_numbers() -> None:
    one = Exercise(
        id="poses.test",
        title="A test",
        difficulty=1,
        draw=drawn(Numbers),
        text=lambda _: "",
        fields=lambda _: (quantity("twice", ""),),
        solve=lambda one: {"twice": 2.0 * one.size},
        steps=lambda _: (),
        wrong={"sign": lambda one: one._replace(size=-one.size)},
    ).variant(0)
    assert one.wrong == {"sign": {"twice": -one.answers["twice"]}}


def test_an_arm_is_read_from_the_names_of_its_numbers() -> None:
    one = math.radians(30.0), math.radians(90.0)
    right = [[-0.5 * math.sin(one[0]) - 0.4, -0.4], [0.5 * math.cos(one[0]), 0.0]]
    assert np.allclose(jacobian(Arm()), right)
    assert np.allclose(own_links(Arm()), [[-0.25, -0.4], [0.5 * math.cos(one[0]), 0.0]])
    assert np.allclose(angles_not_summed(Arm())[:, 1], [-0.4 * math.sin(math.radians(60.0)), 0.2])


def test_a_calculator_in_the_wrong_mode_takes_degrees_for_radians() -> None:
    assert np.allclose(jacobian(misread(Arm()))[:, 1], [-0.4 * math.sin(90.0), 0.4 * math.cos(90.0)])
    assert misread(Arm(), "q1").q2 == 60.0
