"""The DH table of a chain as a person can read it: axes nearly parallel taken as parallel where that costs little."""

from gelenk.kinematics.certify import Certificate, certify_table
from gelenk.kinematics.comparison.words import ORIENTATION_TOLERANCE, POSITION_TOLERANCE
from gelenk.model.chain import Chain
from gelenk.model.dh import Convention, DhTable
from gelenk.model.dh_from_chain import FAR, ChainTable, FarNormal, dh_from_chain
from gelenk.model.robot import Robot

_LIMITS = f"{POSITION_TOLERANCE:g} m and {ORIENTATION_TOLERANCE:g} rad"


def dh_of_chain(
    robot: Robot, chain: Chain, convention: Convention, snap_tolerance: float = 0.0
) -> tuple[DhTable, tuple[str, ...], Certificate]:
    """The table of a chain, notes on what was chosen, and how far it is from the chain.

    The most tilted axes come out again as they are until the rest, taken as parallel, cost little.

    Args:
        robot: The robot.
        chain: Of this robot.
        convention: Standard or modified.
        snap_tolerance: As `dh_from_chain` has it.

    Raises:
        InvalidField: As `dh_from_chain` does.
    """
    parallel_below = ORIENTATION_TOLERANCE  # what is tilted by more costs more
    while True:
        found = dh_from_chain(robot.description, chain, convention, snap_tolerance, parallel_below)
        exact = snap_tolerance == 0.0 and not found.rounded
        certificate = certify_table(robot, chain, found.table, exact=exact)
        if not found.rounded or _is_small(certificate):
            return found.table, (*_notes(found, certificate), *found.notes), certificate
        parallel_below = max(pair.tilt for pair in found.rounded)


def _is_small(cost: Certificate) -> bool:
    return cost.max_position_error < POSITION_TOLERANCE and cost.max_orientation_error < ORIENTATION_TOLERANCE


def _notes(found: ChainTable, certificate: Certificate) -> list[str]:
    """Which lengths are large, and which axes were taken as parallel lest there be more of them."""
    notes = []
    longest = max(abs(length) for row in found.table.joints for length in (row.a, row.d))
    if longest > FAR * found.reach and found.far:
        notes.append(
            f"exact, though long: a length of {longest:.4g} m, as axes are nearly parallel and meet their common "
            f"normal far away, which cannot be rounded within {_LIMITS}: {_listed(found.far)}"
        )
    if found.rounded:
        cost = f"{certificate.max_position_error:.2g} m and {certificate.max_orientation_error:.2g} rad"
        notes.append(
            f"taken as parallel, as their common normal is far away, which costs {cost} by the certificate: "
            f"{_listed(found.rounded)}"
        )
    return notes


def _listed(pairs: tuple[FarNormal, ...]) -> str:
    return "; ".join(f"{pair.joints} ({pair.tilt:.3g} rad, {pair.distance:.3g} m)" for pair in pairs)
