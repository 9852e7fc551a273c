"""The equations of motion of one table in symbols, as text and as values at samples.

Input and output are plain data, so that this can run in another process; the last results are cached. The values come
from the very polynomials that are written out.
"""

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from functools import lru_cache
from typing import Any

from gelenk.dh.derive.algebra import LENGTH, MASS, RATE, Atom, Polynomial, TooManyTerms
from gelenk.dh.derive.symbolic import legend, notation_of
from gelenk.dh.derive.table import Table, read_table
from gelenk.dh.derive.texts import SymbolEntry, symbol_entry
from gelenk.dh.derive.typeset import Formula, MatrixFormula, Notation, indexed, matrix_of, summed
from gelenk.dh.lagrangian.bodies import Line, LinkBody
from gelenk.dh.lagrangian.equations import Equations, NotPlanar, equations, one_group, planar_arm, rate
from gelenk.dh.lagrangian.texts import (
    ChristoffelSymbol,
    LinkFormulas,
    MotionQuestion,
    MotionSample,
    MotionTexts,
    NoMotion,
)
from gelenk.dh.lagrangian.writing import BY_ENERGY, BY_HEIGHT, BY_MASS, BY_WAVE, BY_WEIGHT, Manner, written
from gelenk.language import marked, translated as _

MAX_JOINTS = 3
"""Maximum number of joints: with more, the equations are too long to write out."""

_MOVING = {"m", "I", "g", "lc", "xc", "yc", "zc", "gammax", "gammay", "gammaz", "qd", "qdd"}
"""Names of the atoms that only equations of motion have."""


@lru_cache(maxsize=16)
def motion(question: MotionQuestion) -> MotionTexts | NoMotion:
    """Return the equations of motion, or why there are none."""
    request = question.formulas
    table, values = read_table(request.table), dict[Atom, float]()
    if len(table.rows) > MAX_JOINTS:
        return NoMotion(_("the equations of motion are written out for up to {most} joints").format(most=MAX_JOINTS))
    try:
        arm = planar_arm(table, question.bodies, values)
        found = equations(arm, question.bodies, question.gravity, values)
    except NotPlanar as reason:
        text = _("the equations of motion are written out for planar arms only, and this is not one: {reason}")
        return NoMotion(text.format(reason=reason))
    except TooManyTerms:
        return NoMotion(_("the equations of motion have too many terms to be written out"))
    known = {**table.values, **values}
    notation = notation_of(table, one_group, request, known)
    of_motion = [entry for row in (*found.mass_matrix, *found.coriolis, found.gravity_vector) for entry in row]
    needed = {atom for entry in of_motion for atom in entry.atoms if atom.name in _MOVING - {"qd"}}

    def matrix(name: str, rows: Sequence[Sequence[Polynomial]], manner: Manner) -> MatrixFormula:
        return matrix_of(name, rows, lambda entry: written(entry, notation, manner))

    def column(name: str, entries: Sequence[Polynomial], manner: Manner) -> MatrixFormula:
        return matrix(name, [[entry] for entry in entries], manner)

    links = [
        LinkFormulas(
            row.name,
            notation.vector(f"p_c{i + 1}", found.centers[i]),
            column(f"v_c{i + 1}", found.velocities[i], BY_WAVE),
            notation.text(found.turns[i]),
            written(found.kinetic[i], notation, BY_ENERGY),
            written(found.potential[i], notation, BY_HEIGHT),
        )
        for i, row in enumerate(request.table.rows)
    ]
    return MotionTexts(
        _legend(found, arm.lines, replace(table, values=known), notation),
        notation.vector("g", found.gravity),
        links,
        matrix("M", found.mass_matrix, BY_MASS),
        _christoffel(found, notation),
        matrix("C", found.coriolis, BY_WAVE),
        column("C qd", found.coriolis_vector, BY_WAVE),
        column("g", found.gravity_vector, BY_WEIGHT),
        matrix("Md - 2 C", found.skew, BY_WAVE),
        [_row(found, i, notation) for i in range(len(links))],
        tuple(notation.atom(atom).plain for atom in sorted(needed - known.keys())),
        [_values(found, table, values, sample) for sample in question.samples],
    )


def _christoffel(found: Equations, notation: Notation) -> list[ChristoffelSymbol]:
    symbols = []
    for i, rows in enumerate(found.christoffel, start=1):
        for j, row in enumerate(rows, start=1):
            for k, entry in enumerate(row, start=1):
                if j <= k and entry:
                    text = written(entry, notation, BY_WAVE)
                    symbols.append(ChristoffelSymbol(i, j, k, text.latex, text.plain))
    return symbols


def _row(found: Equations, i: int, notation: Notation) -> Formula:
    """Write a row of M q̈ + C q̇ + g = τ."""
    parts = [written(M * rate(j, 2), notation, BY_MASS) for j, M in enumerate(found.mass_matrix[i], start=1)]
    parts.append(written(found.coriolis_vector[i], notation, BY_WAVE))
    parts.append(written(found.gravity_vector[i], notation, BY_WEIGHT))
    left, right = summed(parts), indexed(r"\tau", "tau", i + 1)
    return Formula(f"{left.latex} = {right.latex}", f"{left.plain} = {right.plain}")


def _legend(found: Equations, lines: Sequence[Line], table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return the legend: first the symbols of the table, then those of the equations of motion alone."""
    atoms = {atom for entry in found.all for atom in entry.atoms}
    entries = legend((atom for atom in atoms if atom.name not in _MOVING), table, notation)
    for atom in sorted(atoms):
        if atom.name in _MOVING and atom not in notation.numbers:
            entries.append(symbol_entry(notation.atom(atom), _words(atom, lines), table.values.get(atom)))
    for i, line in enumerate(lines, start=1):
        words = _("torque of joint {i}, in N m" if line != "own axis" else "force of joint {i}, in N")
        entries.append(symbol_entry(indexed(r"\tau", "tau", i), words.format(i=i)))
    return entries


def _words(atom: Atom, lines: Sequence[Line]) -> str:
    if atom.name == "g":
        return _("acceleration of free fall, in m/s^2")
    if atom.name.startswith("gamma"):
        return _("{axis} of the unit vector of gravity in frame 0").format(axis=atom.name[-1])
    i = atom.indices[0]
    slides = lines[i - 1] == "own axis"
    words = {
        "m": _("mass of link {i}, in kg"),
        "I": _("moment of inertia of link {i} about its centre of mass, the axis normal to the plane, in kg m^2"),
        "qd": _("velocity of joint {i}, in m/s" if slides else "velocity of joint {i}, in rad/s"),
        "qdd": _("acceleration of joint {i}, in m/s^2" if slides else "acceleration of joint {i}, in rad/s^2"),
        "lc": _(_CENTERS[lines[i - 1]]),
    }
    text = words.get(atom.name) or _("coordinate {axis} of the centre of mass of link {i} in frame {i}, in m")
    return text.format(i=i, next=i + 1, axis=atom.name[0])


_CENTERS: dict[Line, str] = {
    "x": marked("where the centre of mass of link {i} is from the axis of joint {i}, along x of frame {i}, in m"),
    "next axis": marked(
        "where the centre of mass of link {i} is from the axis of joint {i}, along that of joint {next}, in m"
    ),
    "own axis": marked(
        "where the centre of mass of link {i} is from the origin of frame {i}, along the axis of joint {i}, in m"
    ),
}


def _values(found: Equations, table: Table, values: dict[Atom, float], sample: MotionSample) -> dict[str, Any]:
    known = {**table.values, **values, **_sampled(sample)}
    atoms = {atom for entry in found.all for atom in entry.atoms}
    known = replace(table, values=known).atom_values(sample.q, atoms)
    return {field.name: _evaluated(getattr(found, field.name), known) for field in fields(found)}


def _evaluated(entries: Any, known: Mapping[Atom, float]) -> Any:
    if isinstance(entries, Polynomial):
        return entries.value(known)
    return [_evaluated(entry, known) for entry in entries]


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
