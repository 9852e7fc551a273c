"""The equations of motion of one table in symbols, as text and as values at samples.

Input and output are plain data, so that this can run in another process; the last results are cached. The values come
from the very polynomials that are written out.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import lru_cache

from gelenk.dh.derive.algebra import GRAVITY, LENGTH, MASS, RATE, Atom, Polynomial, TooManyTerms, symbol
from gelenk.dh.derive.legend import legend
from gelenk.dh.derive.table import Table, read_table
from gelenk.dh.derive.texts import Grid, SymbolEntry
from gelenk.dh.derive.typeset import MatrixText, Notation, Text
from gelenk.dh.lagrangian.bodies import Line, LinkBody
from gelenk.dh.lagrangian.equations import Equations, equations, rate
from gelenk.dh.lagrangian.plane import NotPlanar, one_group, planar_arm
from gelenk.dh.lagrangian.texts import (
    BodyText,
    ChristoffelText,
    MotionQuestion,
    MotionSample,
    MotionTexts,
    MotionValues,
    NoMotion,
)
from gelenk.dh.lagrangian.writing import (
    BY_ENERGY,
    BY_HEIGHT,
    BY_MASS,
    BY_WAVE,
    BY_WEIGHT,
    Manner,
    summed,
    written,
    written_matrix,
)

MAX_JOINTS = 3
"""Maximum number of joints: with more, the equations are too long to write out."""

_MOVING = {"m", "I", "g", "lc", "xc", "yc", "zc", "gammax", "gammay", "gammaz", "qd", "qdd"}
"""Names of the atoms that only equations of motion have."""


@lru_cache(maxsize=16)
def motion(question: MotionQuestion) -> MotionTexts | NoMotion:
    """Return the equations of motion, or why there are none."""
    table, values = read_table(question.table), dict[Atom, float]()
    if len(table.rows) > MAX_JOINTS:
        return NoMotion(f"the equations of motion are written out for up to {MAX_JOINTS} joints")
    try:
        arm = planar_arm(table, question.bodies, values)
        found = equations(arm, question.bodies, question.gravity, values)
    except NotPlanar as reason:
        return NoMotion(f"the equations of motion are written out for planar arms only, and this is not one: {reason}")
    except TooManyTerms:
        return NoMotion("the equations of motion have too many terms to be written out")
    known = {**table.values, **values}
    offset = {row.index for row in table.rows if row.angle and (row.offset or not row.is_revolute)}
    notation = Notation(question.style, one_group, offset, {} if question.keeps_symbols else known)
    needed = {atom for entry in _of_motion(found) for atom in entry.atoms if atom.name in _MOVING - {"qd"}}
    return MotionTexts(
        _legend(found, arm.lines, replace(table, values=known), notation),
        notation.vector(found.gravity),
        [_body(found, i, notation) for i in range(len(table.rows))],
        written_matrix(found.mass_matrix, notation, BY_MASS),
        _christoffel(found, notation),
        written_matrix(found.coriolis, notation, BY_WAVE),
        _column(found.coriolis_vector, notation, BY_WAVE),
        _column(found.gravity_vector, notation, BY_WEIGHT),
        written_matrix(found.skew, notation, BY_WAVE),
        [_row(found, i, notation) for i in range(len(table.rows))],
        tuple(notation.atom(atom).plain for atom in sorted(needed - known.keys())),
        [_values(found, table, values, sample) for sample in question.samples],
    )


def _of_motion(found: Equations) -> Iterable[Polynomial]:
    """Return the entries of M, C and g."""
    return [entry for row in (*found.mass_matrix, *found.coriolis, found.gravity_vector) for entry in row]


def _column(entries: Sequence[Polynomial], notation: Notation, manner: Manner) -> MatrixText:
    return written_matrix([[entry] for entry in entries], notation, manner)


def _body(found: Equations, i: int, notation: Notation) -> BodyText:
    return BodyText(
        notation.vector(found.centers[i]),
        _column(found.velocities[i], notation, BY_WAVE),
        notation.text(found.turns[i]),
        written(found.kinetic[i], notation, BY_ENERGY),
        written(found.potential[i], notation, BY_HEIGHT),
    )


def _christoffel(found: Equations, notation: Notation) -> list[ChristoffelText]:
    size = range(len(found.christoffel))
    return [
        ChristoffelText(i + 1, j + 1, k + 1, written(found.christoffel[i][j][k], notation, BY_WAVE))
        for i in size
        for j in size
        for k in size
        if j <= k and found.christoffel[i][j][k]
    ]


def _row(found: Equations, i: int, notation: Notation) -> Text:
    """Write a row of M q̈ + C q̇ + g = τ."""
    parts = [written(M * rate(j, 2), notation, BY_MASS) for j, M in enumerate(found.mass_matrix[i], start=1)]
    parts.append(written(found.coriolis_vector[i], notation, BY_WAVE))
    parts.append(written(found.gravity_vector[i], notation, BY_WEIGHT))
    left = summed(parts)
    return Text(rf"{left.latex} = \tau_{{{i + 1}}}", f"{left.plain} = tau{i + 1}")


def _legend(found: Equations, lines: Sequence[Line], table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return the legend: first the symbols of the table, then those of the equations of motion alone."""
    atoms = {atom for entry in found.all for atom in entry.atoms}
    entries = legend((symbol(atom) for atom in atoms if atom.name not in _MOVING), table, notation)
    for atom in sorted(atoms):
        if atom.name in _MOVING and atom not in notation.numbers:
            entries.append(SymbolEntry(notation.atom(atom), _meaning(_words(atom, lines)), table.values.get(atom)))
    for i in range(1, len(lines) + 1):
        words = f"torque of joint {i}, in N m" if lines[i - 1] != "own axis" else f"force of joint {i}, in N"
        entries.append(SymbolEntry(Text(rf"\tau_{{{i}}}", f"tau{i}"), _meaning(words), None))
    return entries


def _meaning(words: str) -> Text:
    """Write words; a squared unit at their end is not text in LaTeX."""
    square = "^{2}" if words.endswith("^2") else ""
    return Text(rf"\text{{{words.removesuffix('^2')}}}{square}", words)


def _words(atom: Atom, lines: Sequence[Line]) -> str:
    i = atom.indices[0]
    if atom.kind == MASS:
        about = "about its centre of mass, the axis normal to the plane, in kg m^2"
        return f"mass of link {i}, in kg" if atom.name == "m" else f"moment of inertia of link {i} {about}"
    if atom.kind == GRAVITY:
        return "acceleration of free fall, in m/s^2"
    if atom.kind == LENGTH and atom.name != "lc":
        return f"coordinate {atom.name[0]} of the centre of mass of link {i} in frame {i}, in m"
    if atom.kind == LENGTH:
        ways = {
            "x": f"the axis of joint {i}, along x of frame {i}",
            "next axis": f"the axis of joint {i}, along that of joint {i + 1}",
            "own axis": f"the origin of frame {i}, along the axis of joint {i}",
        }
        return f"where the centre of mass of link {i} is from {ways[lines[i - 1]]}, in m"
    if atom.kind == RATE:
        unit = "m/s" if lines[i - 1] == "own axis" else "rad/s"
        return f"velocity of joint {i}, in {unit}" if atom.name == "qd" else f"acceleration of joint {i}, in {unit}^2"
    return f"{atom.name[-1]} of the unit vector of gravity in frame 0"


def _values(found: Equations, table: Table, values: dict[Atom, float], sample: MotionSample) -> MotionValues:
    """Evaluate every formula at a sample."""
    known = {**table.values, **values, **_sampled(sample)}
    atoms = {atom for entry in found.all for atom in entry.atoms}
    known = replace(table, values=known).atom_values(sample.q, atoms)

    def row(entries: Iterable[Polynomial]) -> list[float]:
        return [entry.value(known) for entry in entries]

    def grid(rows: Iterable[Iterable[Polynomial]]) -> Grid:
        return [row(entries) for entries in rows]

    return MotionValues(
        grid(found.centers),
        grid(found.velocities),
        row(found.kinetic),
        row(found.potential),
        grid(found.mass_matrix),
        [grid(rows) for rows in found.christoffel],
        grid(found.coriolis),
        row(found.coriolis_vector),
        row(found.gravity_vector),
        grid(found.skew),
        row(found.torques),
    )


def _sampled(sample: MotionSample) -> dict[Atom, float]:
    """Return the values of the symbols that have none by themselves."""
    found: dict[Atom, float] = {}
    for i, (body, v, a) in enumerate(zip(sample.bodies, sample.v, sample.a, strict=True), start=1):
        found |= {Atom(RATE, (i,), "qd"): v, Atom(RATE, (i,), "qdd"): a}
        found |= _of_body(body, i)
    return found


def _of_body(body: LinkBody, i: int) -> dict[Atom, float]:
    center = body.center if isinstance(body.center, tuple) else (body.center,)
    names = ("xc", "yc", "zc") if isinstance(body.center, tuple) else ("lc",)
    given = [(MASS, "m", body.mass), (MASS, "I", body.inertia)]
    given += [(LENGTH, name, value) for name, value in zip(names, center, strict=True)]
    return {Atom(kind, (i,), name): value for kind, name, value in given if value is not None}
