"""The meaning of every symbol in the formulas."""

from collections.abc import Iterable

from gelenk.dh.derive.algebra import CONSTANT, LENGTH, ROOT, TRIGONOMETRIC, Atom
from gelenk.dh.derive.table import Table
from gelenk.dh.derive.texts import SymbolEntry, symbol_entry
from gelenk.dh.derive.typeset import Notation, decimal, function_of, indexed, summed


def legend(atoms: Iterable[Atom], table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return an entry for every symbol: parameters, then variables, then sines and cosines."""
    atoms, found, known = sorted(atoms), list[SymbolEntry](), set[tuple[object, ...]]()
    for atom in atoms:
        if atom in notation.numbers or atom.kind == ROOT:
            continue
        key = (atom.kind, atom.indices, atom.kind in {LENGTH, CONSTANT} and atom.name.replace("ca", "sa"))
        if key not in known:
            known.add(key)
            found += _entries(atom, table, notation)
    angles = {abs(index) for atom in atoms if atom.kind == TRIGONOMETRIC for index in atom.indices}
    for index in sorted(angles & set(notation.offset_angles)):
        row = table.rows[index - 1]
        own = decimal(row.offset)
        meaning = summed((indexed("q", "q", index), own)) if row.is_revolute else own
        found.append(symbol_entry(notation.angle_name(index), meaning))
    return found


def _entries(atom: Atom, table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return the entry of a symbol, or both entries of an angle."""
    if atom.kind == TRIGONOMETRIC:
        if notation.style == "full" or len(set(atom.indices)) < len(atom.indices):
            return []
        angle, names = notation.angle(atom.indices), ("c", "s")
    elif atom.name in {"ca", "sa"}:
        index = atom.indices[0]
        angle, names = indexed(r"\alpha", "alpha", index), ("ca", "sa")
        if notation.style == "full":
            row = index if table.is_standard else index + 1
            return [symbol_entry(angle, f"twist alpha of row {row}, in rad", table.as_read.rows[row - 1].alpha)]
    else:
        return [symbol_entry(notation.atom(atom), _words(atom, table), table.values.get(atom))]
    both = [atom._replace(name=name) for name in names]
    return [symbol_entry(notation.atom(one), function_of(one.name, angle), table.values.get(one)) for one in both]


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
