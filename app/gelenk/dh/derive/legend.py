"""The meaning of every symbol in the formulas."""

from collections.abc import Iterable

from gelenk.dh.derive.algebra import CONSTANT, LENGTH, ROOT, TRIGONOMETRIC, Atom, Polynomial
from gelenk.dh.derive.table import Table
from gelenk.dh.derive.texts import SymbolEntry
from gelenk.dh.derive.typeset import Notation, Text, decimal, joined


def legend(entries: Iterable[Polynomial], table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return an entry for every symbol that occurs: parameters, then variables, then sines and cosines."""
    atoms = {atom for entry in entries for atom in entry.atoms}
    found, told = list[SymbolEntry](), set[tuple[object, ...]]()
    for atom in sorted(atoms):
        if atom in notation.numbers or atom.kind == ROOT:
            continue
        key = (atom.kind, atom.indices, atom.kind in {LENGTH, CONSTANT} and atom.name.replace("ca", "sa"))
        if key not in told:
            told.add(key)
            found += _entry(atom, table, notation)
    angles = {abs(index) for atom in atoms if atom.kind == TRIGONOMETRIC for index in atom.indices}
    for index in sorted(angles & set(notation.offset_angles)):
        row = table.rows[index - 1]
        own = decimal(row.offset)
        meaning = joined(Text(f"q_{{{index}}}", f"q{index}"), own) if row.is_revolute else own
        found.append(SymbolEntry(notation.angle_name(index), meaning, None))
    return found


def _entry(atom: Atom, table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return the entry of a symbol, or both entries of an angle."""
    value = table.values.get(atom)
    if atom.kind == TRIGONOMETRIC:
        if notation.style == "full" or len(set(atom.indices)) < len(atom.indices):
            return []
        angle = notation.angle(atom.indices)
        return [
            SymbolEntry(
                notation.atom(atom._replace(name=name[0])),
                Text(rf"\{name}\left({angle.latex}\right)", f"{name}({angle.plain})"),
                None,
            )
            for name in ("cos", "sin")
        ]
    if atom.kind == CONSTANT and atom.name in {"ca", "sa"}:
        return _twist_entries(atom.indices[0], table, notation)
    words = _words(atom, table)
    return [SymbolEntry(notation.atom(atom), Text(rf"\text{{{words}}}", words), value)]


def _twist_entries(index: int, table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return the entry of a twist that is no special angle, or in the short style its cosine and sine."""
    alpha = Text(rf"\alpha_{{{index}}}", f"alpha{index}")
    row = index if table.is_standard else index + 1
    if notation.style == "full":
        words = f"twist alpha of row {row}, in rad"
        return [SymbolEntry(alpha, Text(rf"\text{{{words}}}", words), table.as_read.rows[row - 1].alpha)]
    return [
        SymbolEntry(
            notation.atom(Atom(CONSTANT, (index,), f"{name[0]}a")),
            Text(rf"\{name}\left({alpha.latex}\right)", f"{name}({alpha.plain})"),
            table.values[Atom(CONSTANT, (index,), f"{name[0]}a")],
        )
        for name in ("cos", "sin")
    ]


def _words(atom: Atom, table: Table) -> str:
    index = atom.indices[0]
    row = index if table.is_standard or atom.name != "a" else index + 1
    named = {
        "a": f"length a of row {row}, in m",
        "d": f"length d of row {row}, in m",
        "q": f"variable of the prismatic joint {index}, in m",
        "pb": "position of frame 0 in the base, in m",
        "pt": "position of the tool in the last frame, in m",
        "rb": "entry of the base's rotation matrix",
        "rt": "entry of the tool's rotation matrix",
    }
    return named[atom.name]
