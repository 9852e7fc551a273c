"""Expressions of a xacro: as Python gives them, without Python's objects, and within bounds."""

import math
import time

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from gelenk.robot.formats.expressions import evaluate
from gelenk.robot.formats.functions import MATH, PYTHON
from gelenk.robot.formats.sources import Fault
from gelenk.robot.formats.values import MAX_ITEMS, Function, Names, Steps, Value

NAMES = Names({**MATH, **PYTHON, "d": {"a": 1, "b": {"c": [1, 2]}}, "s": "abc"})


def value(text: str) -> Value:
    return evaluate(text, NAMES, Steps())


NUMBERS = st.one_of(st.integers(-9, 9), st.floats(-9, 9).map(lambda x: round(x, 3))).map(str)
OPERATORS = ["+", "-", "*", "/", "//", "%", "<", "<=", "==", "!=", "and", "or"]
EXPRESSIONS = st.recursive(
    st.one_of(NUMBERS, st.sampled_from(["pi", "True", "e"])),
    lambda parts: st.one_of(
        st.tuples(parts, st.sampled_from(OPERATORS), parts).map(lambda of: f"({of[0]} {of[1]} {of[2]})"),
        parts.map(lambda of: f"-({of})"),
        parts.map(lambda of: f"(not {of})"),
        st.tuples(parts, parts, parts).map(lambda of: f"({of[0]} if {of[1]} else {of[2]})"),
        st.tuples(st.sampled_from(["sin", "cos", "atan", "degrees", "abs"]), parts).map(lambda of: f"{of[0]}({of[1]})"),
        st.lists(parts, min_size=1, max_size=3).map(lambda of: f"max([{', '.join(of)}])"),
    ),
    max_leaves=12,
)


@settings(max_examples=150, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
@given(EXPRESSIONS)
def test_numbers_are_those_of_python(text: str) -> None:
    try:
        expected = eval(text, {**vars(math)})  # noqa: S307
    except ZeroDivisionError:
        with pytest.raises(Fault):
            value(text)
        return
    found = value(text)
    assert type(found) is type(expected)
    assert found == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("d.b.c[1]", 2),
        ("d['b']['c'][-1]", 2),
        ("'c' in d.b", True),
        ("s.upper() + s[1:]", "ABCbc"),
        ("list(map(float, '1 2'.split(' ')))", [1.0, 2.0]),
        ("[k + str(v) for k, v in dict(x=1).items()]", ["x1"]),
        ("sum(x for x in [1, 2])", 3),
        ("{'a': (1, 2)}['a'][0]", 1),
        ("', '.join(['a', 'b']).replace('a', 'c')", "c, b"),
    ],
)
def test_values_are_reached_by_keys(text: str, expected: Value) -> None:
    assert value(text) == expected


REFUSED = [
    *("__import__('os')", "().__class__", "d.__class__", "s.format", "'{0.__class__}'.format(1)", "(lambda: 1)()"),
    *("open('/etc/passwd')", "eval('1')", "getattr(d, 'a')", "f'{1}'", "[x for x in [1] for y in [2]]", "x := 1"),
    *("s.join.__self__", "sin.__call__", "d._a", "type(1)", "vars()", "print(1)", "1j", "(-8) ** 0.5", "...", "b'a'"),
    *(
        "9 ** 9 ** 9",
        "10 ** 4000",
        "2.0 ** 1e9",
        "'a' * 10 ** 9",
        "[1] * 10 ** 9",
        "10 ** 9 * (1,)",
        "'%999999999d' % 1",
    ),
    *("range(10 ** 9)", "round(5, -10 ** 9)", "factorial(99999)", "comb(10 ** 9, 10 ** 8)", "1 << 10 ** 9", "1 / 0"),
    *(
        "('a' * 9999).replace('a', 'b' * 9999)",
        "[[1] * 9999] * 9",
        "('x' * 9999).join(['y'] * 9999)",
        "int('9' * 9999)",
    ),
    *("[['a' * 9999] * 99] * 2", "str(['a' * 9999] * 99) * 9", "d['z']", "d.z", "[1][2]", "1()", "1 +", "", "'"),
    *(
        "sin(*[1])",
        "dict(**d)",
        "sin('a')",
        "nothing",
        "len(5)",
        "[1][0:1:0]",
        "'a' < 1",
        "{1, 2}",
        "{**d}",
        "{[1]: 2}",
    ),
    *("(" * 300 + ")" * 300, "-" * 4000 + "1", "1+" * 2000 + "1", "[" * 4000, "not " * 900 + "1", "d[" * 99),
]


@pytest.mark.parametrize("text", REFUSED)
def test_what_is_not_evaluated_is_refused_at_once(text: str) -> None:
    started = time.monotonic()
    with pytest.raises((Fault, RecursionError)):
        value(text)
    assert time.monotonic() - started < 20


def test_nothing_grows_by_repeated_use() -> None:
    names = {**NAMES.values, "x": [1]}
    with pytest.raises(Fault, match=f"more than {MAX_ITEMS} items"):
        for _ in range(99):
            names["x"] = evaluate("[x, x]", Names(names), Steps())


LONG = {
    "searches": "sum([1 for i in range(3000) if 'b' in t])",
    "comparisons": "[many == other for i in range(3000)]",
    "slices": "[len(many[1:]) for i in range(3000)]",
    "methods": "[t.count('b') for i in range(3000)]",
    "mapped methods": "map(t.count, ['b'] * 3000)",
    "arguments": "[max(many) for i in range(3000)]",
    "copies": "[len([t]) for i in range(9000)]",
}


@pytest.mark.parametrize("name", LONG)
def test_steps_are_as_many_as_the_work(name: str) -> None:
    names = {**NAMES.values, "t": "a" * 60_000, "many": [0.0] * 9000, "other": [0.0] * 9000}
    with pytest.raises(Fault, match="takes more than 1000000 steps"):
        evaluate(LONG[name], Names(names), Steps())


def test_lists_are_refused_while_they_grow() -> None:
    made = 0

    def text(*_: Value) -> str:
        nonlocal made
        made += 1
        return "a" * 60_000

    names = Names({**NAMES.values, "make": Function("make", text)})
    for grown in ("map(make, range(999))", "[make() for i in range(999)]", "[" + "make()," * 99 + "]"):
        made = 0
        with pytest.raises(Fault, match="characters"):
            evaluate(grown, names, Steps())
        assert made == 17
