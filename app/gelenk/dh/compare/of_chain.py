"""A readable DH table of a chain: nearly parallel axes become parallel where the error stays small."""

from gelenk.dh.compare.words import ORIENTATION_TOLERANCE, POSITION_TOLERANCE
from gelenk.dh.tables.from_chain import FAR, ChainTable, FarNormal, dh_from_chain
from gelenk.kinematics.judge.tables import certify_table
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.language import translated as _
from gelenk.robot.chain import Chain
from gelenk.robot.dh import Convention, DhTable
from gelenk.robot.robot import RobotModel

_LIMITS = f"{POSITION_TOLERANCE:g} m and {ORIENTATION_TOLERANCE:g} rad"


def dh_of_chain(
    robot: RobotModel, chain: Chain, convention: Convention, snap_tolerance: float = 0.0
) -> tuple[DhTable, tuple[str, ...], PoseCertificate]:
    """Compute the DH table of a chain, notes on the choices made, and a certificate of its errors.

    The most tilted pairs of axes are kept exact, one after another, until treating the rest as parallel costs little.
    Arguments and errors are those of `dh_from_chain`.
    """
    parallel_below = ORIENTATION_TOLERANCE  # a larger tilt causes a larger error
    while True:
        found = dh_from_chain(robot.description, chain, convention, snap_tolerance, parallel_below)
        exact = snap_tolerance == 0.0 and not found.rounded
        certificate = certify_table(robot, chain, found.table, exact=exact)
        is_near = certificate.max_position_error < POSITION_TOLERANCE
        if not found.rounded or (is_near and certificate.max_orientation_error < ORIENTATION_TOLERANCE):
            return found.table, (*_notes(found, certificate), *found.notes), certificate
        parallel_below = max(pair.tilt for pair in found.rounded)


def _notes(found: ChainTable, certificate: PoseCertificate) -> list[str]:
    """Notes on large lengths, and on axes treated as parallel to avoid more of them."""
    notes = []
    longest = max(abs(length) for row in found.table.joints for length in (row.a, row.d))
    if longest > FAR * found.reach and found.far:
        text = _(
            "exact, but with a length of {length:.4g} m: axes are nearly parallel and meet their common normal far "
            "away, which cannot be rounded within {limits}: {pairs}"
        )
        notes.append(text.format(length=longest, limits=_LIMITS, pairs=_listed(found.far)))
    if found.rounded:
        text = _(
            "treated as parallel, because their common normal is far away; the error is {position:.2g} m and "
            "{angle:.2g} rad by the certificate: {pairs}"
        )
        position, angle = certificate.max_position_error, certificate.max_orientation_error
        notes.append(text.format(position=position, angle=angle, pairs=_listed(found.rounded)))
    return notes


def _listed(pairs: tuple[FarNormal, ...]) -> str:
    return "; ".join(f"{pair.joints} ({pair.tilt:.3g} rad, {pair.distance:.3g} m)" for pair in pairs)
