"""Contacts of the solutions of inverse kinematics in a cell."""

from typing import Any, NamedTuple

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.collision.contact.judge import TOLERANCE
from gelenk.collision.contact.words import ContactCertificate
from gelenk.errors import CertificationFailed
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.robot.arrays import Array


class FoundContacts(NamedTuple):
    """The fields about contacts, of each solution and by target of the nearest of all that are in contact."""

    of_solutions: list[dict[str, Any]]
    of_nearest: dict[int, dict[str, Any]]
    certificate: ContactCertificate


def contacts_of(cell: Cell | None, result: InverseKinematics) -> FoundContacts | None:
    """Return the contacts of an answer, checked by Coal; raises CertificationFailed."""
    if cell is None or result.touching is None:
        return None
    blocked = {i: one.nearest for i, one in result.failures.items() if one.status == "in_collision"}
    qs, count = np.concatenate((result.qs, *(q[None] for q in blocked.values()))), len(result.qs)
    nearest = cell.nearest(qs)
    certificate = cell.certified_nearest(qs, nearest)
    touching = np.append(result.touching, np.ones(len(blocked), dtype=bool))
    slacks = nearest.clearances - cell.min_clearance
    doubt = float(np.abs(slacks[(slacks <= 0.0) != touching]).max(initial=0.0))
    if not doubt <= TOLERANCE:
        raise CertificationFailed("a contact", doubt, TOLERANCE)
    every = [
        {"clearance": clearance if clearance < np.inf else None, "pair": cell.pair(*about)}
        for clearance, *about in zip(*(column.tolist() for column in nearest), strict=True)
    ]
    own = zip(result.touching.tolist(), every[:count], strict=True)
    of_solutions = [{"in_collision": is_touching, **contact} for is_touching, contact in own]
    return FoundContacts(of_solutions, dict(zip(blocked, every[count:], strict=True)), certificate)


def certify_table(cell: Cell | None, result: InverseKinematics, rows: Array) -> None:
    """Check by Coal the contacts of a table with a row for each target; raises CertificationFailed."""
    if cell is not None:
        blocked = [i for i, one in result.failures.items() if one.status == "in_collision"]
        known = np.ones(len(rows), dtype=bool)
        known[list(result.failures)] = False
        known[blocked] = True
        touching = np.zeros(len(rows), dtype=bool)
        touching[blocked] = True
        cell.certified(rows[known], touching[known])
