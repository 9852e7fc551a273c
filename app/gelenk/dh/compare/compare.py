"""Check whether a DH table describes a chain of a robot, and find where it is wrong if not.

A chain has many DH tables: x axes can be reversed, z axes too with the sense of their joint, origins slide along
parallel axes, the first row's d and θ can move into the base, and the last row's parameters into the tool. So the
entries are not compared one by one. A table describes a chain if some base and tool and, where these may be found,
zeros and senses of the joints make the poses of both equal at random configurations.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.mistakes import diagnoses, diagnoses_of_rows
from gelenk.dh.compare.numbers import Difference, first_wrong_row
from gelenk.dh.compare.placement import Placement, Subject, placed, plain, subject, variable_columns
from gelenk.dh.compare.screws import BASE_DIRECTIONS, PARAMETERS, Tables, geometry, jacobians, parameters_of
from gelenk.dh.compare.trials import Diagnosis
from gelenk.dh.compare.words import LOOKS, ORIENTATION_TOLERANCE, POSITION_TOLERANCE, SAMPLES, Unverified
from gelenk.errors import InvalidField, counted, listed, quoted
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain, crossed_joints
from gelenk.robot.description import Mimic
from gelenk.robot.dh import DhTable
from gelenk.robot.robot import RobotModel

MAX_ROWS_WITH_SENSES = 16
"""Largest number of rows for which offsets and signs are found: more rows would take many seconds."""
_MOST_DIAGNOSES = 8
_PARALLEL = 1e-6
_SPANNED = 1e-7
_SAME_MULTIPLIER = 1e-9


@dataclass(frozen=True, slots=True)
class Comparison:
    """The result of comparing a table with a chain; `equivalent` if the table describes it.

    Attributes:
        placement: The table fitted to the chain as closely as possible, with the errors measured through Pinocchio;
            None if the rows and the joints do not match in number or type.
        differences: All known differences, the first row and parameter that differ first.
        diagnoses: Single mistakes, or pairs of them, that explain the differences; the likeliest first.
        unverified: Entries that cannot be checked, because something found compensates for them.
        samples: Number of configurations compared.
    """

    equivalent: bool
    placement: Placement | None
    differences: tuple[Difference, ...]
    diagnoses: tuple[Diagnosis, ...]
    unverified: tuple[Unverified, ...]
    notes: tuple[str, ...]
    samples: int

    @property
    def first_difference(self) -> Difference | None:
        """The first row and parameter that differ; None if nothing differs."""
        return self.differences[0] if self.differences else None


def compare(
    robot: RobotModel,
    chain: Chain,
    table: DhTable,
    freedom: Freedom,
    tolerances: tuple[float, float] = (POSITION_TOLERANCE, ORIENTATION_TOLERANCE),
    seed: int = 0,
) -> Comparison:
    """Compare a table with a chain, whose joints, mimic joints included, are the table's rows.

    The table's base and tool are ignored where they are to be found. Positions [m] and orientations [rad] count as
    equal within the tolerances. `seed` is that of the random configurations.

    Raises:
        InvalidField: Zeros or senses are requested for a chain with mimic joints, or with too many joints.
    """
    unlike = _unlike(chain, table)
    if unlike is not None:
        return _refused(unlike, robot, chain, table, freedom, tolerances, seed)
    rows = len(table.joints)
    only = "offsets and signs can only be found"
    if rows != len(chain) and (freedom.offsets or freedom.signs):
        raise InvalidField("find", f"{only} for chains without mimic joints; base and tool for any chain")
    if rows > MAX_ROWS_WITH_SENSES and (freedom.offsets or freedom.signs):
        raise InvalidField("find", f"{only} for tables with at most {MAX_ROWS_WITH_SENSES} rows")
    on = replace(subject(robot, chain, tolerances, SAMPLES, seed), senses=_senses(chain, table))
    placement = placed(on, table, freedom)
    assert placement is not None  # noqa: S101 - a fit that is not strict always succeeds
    if on.accepts(placement.errors):
        unverified = _unverified(on, placement, freedom)
        notes = (*_plain_notes(table, placement, freedom), *_notes(on, unverified))
        return Comparison(True, placement, (), (), unverified, notes, SAMPLES)
    return _explained(on, table, freedom, placement)


def _explained(on: Subject, table: DhTable, freedom: Freedom, placement: Placement) -> Comparison:
    """Result for a table that matches the joints in number and type but does not describe the chain."""
    signs = placement.signs * on.senses if len(on.chain) == len(on.target) else on.senses
    found: list[Diagnosis] = []
    for senses in (on.senses, signs):
        found = diagnoses(on, table, freedom, senses)
        if found or (signs == on.senses).all():
            break
    differences = found[0].differences if found else tuple(first_wrong_row(on, table, freedom, signs))
    unverified = _unverified(on, placement, freedom)
    notes = list(_notes(on, unverified))
    if not found:
        notes.append("no one or two mistakes explain it; the difference listed is the first one from the base")
    elif len(found) > 1:
        notes.append("each of the diagnoses alone explains it; the first difference is that of the likeliest")
    shown = tuple(found[:_MOST_DIAGNOSES])
    return Comparison(False, placement, differences, shown, unverified, tuple(notes), SAMPLES)


def _refused(
    unlike: Difference,
    robot: RobotModel,
    chain: Chain,
    table: DhTable,
    freedom: Freedom,
    tolerances: tuple[float, float],
    seed: int,
) -> Comparison:
    """Result for a table whose rows do not match the joints, with mistakes that explain why."""
    joints, found = crossed_joints(robot.description, chain), list[Diagnosis]()
    if joints and len(chain) == len(joints) and not any(row.mimic for row in table.joints):
        found = diagnoses_of_rows(subject(robot, chain, tolerances, LOOKS, seed), table, freedom)
    ends = f"from {quoted(chain.base_frame)} to {quoted(chain.tip_frame)}"
    names = listed(tuple(each.name for each in joints))
    note = f"the chain {ends} has the {counted(len(joints), 'joint')} {names}"
    differences = found[0].differences if found else (unlike,)
    return Comparison(False, None, differences, tuple(found[:_MOST_DIAGNOSES]), (), (note,), 0)


def _unlike(chain: Chain, table: DhTable) -> Difference | None:
    """First row that cannot match its joint: the number of rows, the joint type or the mimicked joint differs."""
    flat = chain.flat
    rows, joints = len(table.joints), len(flat.joints)
    variables = {name: i for i, name in enumerate(table.variables)}
    for i, (row, (slides, variable)) in enumerate(zip(table.joints, flat.joints.tolist(), strict=False)):
        expected = "prismatic" if slides else "revolute"
        if row.type != expected:
            return Difference(i + 1, row.name, "type", row.type, expected)
        multiplier = 1.0 if row.mimic is None else row.mimic.multiplier
        leader = variables[row.name if row.mimic is None else row.mimic.joint]
        wanted = float(flat.drives[i, 0])
        same = abs(abs(multiplier) - abs(wanted)) <= _SAME_MULTIPLIER * max(1.0, abs(wanted))
        if rows == joints and not (leader == variable and same):
            return Difference(i + 1, row.name, "mimic", _following(row.mimic), _drive(chain, i, wanted, variable))
    if rows != joints:
        name = table.joints[joints].name if rows > joints else None
        return Difference(min(rows, joints) + 1, name, "joints", float(rows), float(joints))
    return None


def _following(mimic: Mimic | None) -> str:
    return "a variable of its own" if mimic is None else f"{mimic.multiplier:.9g} · {quoted(mimic.joint)}"


def _drive(chain: Chain, i: int, multiplier: float, variable: int) -> str:
    own = chain.flat.joints[:, 1].tolist().index(variable) == i and multiplier == 1.0
    return "a variable of its own" if own else f"{multiplier:.9g} · {quoted(chain.joint_names[variable])}"


def _senses(chain: Chain, table: DhTable) -> Array:
    """Sense of each row: 1, or -1 if its multiplier and the chain's have opposite signs; shape (n,)."""
    multipliers = np.array([1.0 if row.mimic is None else row.mimic.multiplier for row in table.joints])
    return np.where(multipliers * chain.flat.drives[:, 0] < 0.0, -1.0, 1.0)


def _unverified(on: Subject, placement: Placement, freedom: Freedom) -> tuple[Unverified, ...]:
    """Entries whose changes the found base, tool or zeros would compensate, to first order."""
    n = len(on.target)
    table = placement.table
    rows = parameters_of(table)
    signs = on.senses
    if len(on.chain) == n:
        rows[np.arange(n), variable_columns(on.target)] += placement.offsets
        signs = placement.signs * on.senses
    tables = Tables(table.convention, on.target.slides, signs[None], rows[None], table.base[None], table.tool)
    everything = np.arange(BASE_DIRECTIONS + 4 * n)[None]
    J = jacobians(table.convention, geometry(tables), everything, with_tip=not freedom.tool)[0]
    zeros = BASE_DIRECTIONS + 4 * np.arange(n) + variable_columns(on.target)
    none, changes = np.zeros((len(J), 0)), J[:, BASE_DIRECTIONS:]
    base = J[:, :BASE_DIRECTIONS] if freedom.base else none
    offsets = np.column_stack((base, J[:, zeros])) if freedom.offsets else none
    absorbed: dict[Literal["base", "tool", "offsets"], Flags] = {
        "tool": _lie_in(changes, none),
        "base": _lie_in(changes, base),
        "offsets": _lie_in(changes, offsets),
    }
    found = []
    for place in range(4 * n):
        by = next((name for name, lie in absorbed.items() if lie[place]), None)
        if by is not None:
            row, column = divmod(place, 4)
            found.append(Unverified(row + 1, table.joints[row].name, PARAMETERS[column], by))
    return tuple(found)


def _lie_in(changes: Array, span: Array) -> Flags:
    """Which columns of `changes` lie in the column space of `span`; shapes (m, k), (m, s) → (k,)."""
    rest = changes
    if span.shape[1]:
        U, sizes, _ = np.linalg.svd(span, full_matrices=False)
        U = U[:, sizes > 1e-9 * sizes.max()]
        rest = changes - U @ (U.T @ changes)
    lie: Flags = np.linalg.norm(rest, axis=0) <= _SPANNED * np.maximum(1.0, np.linalg.norm(changes, axis=0))
    return lie


def _plain_notes(table: DhTable, placement: Placement, freedom: Freedom) -> list[str]:
    """Notes on a base found that is not plain, which may hide an error in the first row."""
    base = placement.table.base
    if not freedom.base or np.array_equal(base, plain(base, (math.inf, 1e-9))):
        return []
    row = table.joints[0]
    along_axis = base[2, 2] > 1.0 - 1e-9 and max(abs(base[0, 3]), abs(base[1, 3])) <= POSITION_TOLERANCE
    starts_at_axis = table.convention == "standard" or (row.a == 0.0 and row.alpha == 0.0)
    if not (along_axis and starts_at_axis and row.type == "revolute"):
        return ["the base that was found is not plain: give `base` in `dh` to have the first row checked against it"]
    parts = []
    if base[2, 3] != 0.0:
        parts.append(f"d = {row.d + base[2, 3]:.9g} instead of {row.d:.9g}")
    turn = math.atan2(base[1, 0], base[0, 0])
    if min(abs(turn - k * math.pi / 2.0) for k in range(-2, 3)) > ORIENTATION_TOLERANCE:
        parts.append(f"theta = {row.theta + turn:.9g} instead of {row.theta:.9g}")
    if not parts:
        return []
    instead = " and ".join(parts)
    advice = "give `base` in `dh` to have row 1 checked"
    return [f"the base that was found compensates for row 1: with {instead} it would be plain; {advice}"]


def _notes(on: Subject, unverified: tuple[Unverified, ...]) -> list[str]:
    """Notes on parameters that the comparison cannot distinguish."""
    notes = []
    if unverified:
        by = {each.absorbed_by for each in unverified}
        which = ", ".join(name for name in ("base", "tool", "offsets") if name in by)
        notes.append(f"numbers listed in `unverified` are not checked: the {which} found would compensate for them")
    known = {each.row for each in unverified if each.parameter == "d"}
    for group in _parallel_groups(on):
        rows = [row for row in group if row not in known]
        if len(rows) > 1:
            names = ", ".join(str(row) for row in rows)
            notes.append(f"the axes of rows {names} are parallel: only the sum of their d is checked")
    return notes


def _parallel_groups(on: Subject) -> list[list[int]]:
    """Groups of rows (from 1) of consecutive revolute joints with parallel axes."""
    groups: list[list[int]] = []
    directions = on.target.directions
    for i, slides in enumerate(on.target.slides):
        if slides:
            continue
        follows = bool(groups) and groups[-1][-1] == i
        if follows and np.linalg.norm(np.cross(directions[i - 1], directions[i])) <= _PARALLEL:
            groups[-1].append(i + 1)
        else:
            groups.append([i + 1])
    return [group for group in groups if len(group) > 1]
