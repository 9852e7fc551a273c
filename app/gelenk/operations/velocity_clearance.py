"""How near a robot is to itself and its surroundings, and how fast its joints change that."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from gelenk.collision.cell import Cell, Nearest
from gelenk.contract.velocity import VelocityRequest
from gelenk.course.velocity.null_space_steps import NearestPair
from gelenk.errors import InvalidField
from gelenk.operations.cells import cell_of
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.store.records import LoadedRobot


@dataclass(frozen=True, slots=True, eq=False)
class Clearances:
    """The nearest pair at each of N configurations, and the gradient of its distance.

    Attributes:
        gradients: Of the clearance; shape (N, n), [m/rad or 1].
        about: What the answer says of all.
    """

    cell: Cell
    nearest: Nearest
    gradients: Array
    about: dict[str, Any]

    def result(self, row: int, speeds: Array) -> dict[str, Any]:
        """Return what is sent of a configuration at joint velocities, shape (n,)."""
        clearance, *pair = (column[row].tolist() for column in self.nearest)
        return {
            "value": clearance if clearance < np.inf else None,
            "in_collision": clearance <= self.cell.min_clearance,
            "pair": self.cell.pair(*pair),
            "gradient": self.gradients[row].tolist(),
            "rate": float(self.gradients[row] @ speeds),
        }

    def worked(self, row: int) -> NearestPair | None:
        """Return what the steps need of a configuration; None if nothing can touch anything."""
        clearance = float(self.nearest.clearances[row])
        for k, distance, points in zip(*self.nearest.contact(row), strict=True):
            return NearestPair(*self.cell.names(int(k)), float(distance), clearance, points[:3], points[3:])
        return None


def clearances_of(loaded: LoadedRobot, chain: Chain, call: VelocityRequest, qs: Array) -> Clearances | None:
    """Return how near the robot is to what it must not touch; None if that is not asked for.

    Raises InvalidField for the objective `clearance` without that, and as `cell_of` does.
    """
    found = cell_of(loaded, chain, call)
    if found is None:
        if call.null_space is not None and call.null_space.objective == "clearance":
            reason = "`clearance` needs a `scene`, or a `min_clearance` for the robot's distance from itself alone"
            raise InvalidField("null_space/objective", reason)
        return None
    cell, warnings = found
    nearest = cell.nearest(qs)
    gradients = cell.gradients(qs, nearest)
    about = {
        "root_frame": loaded.robot.description.root,
        "warnings": warnings,
        "clearance_certificate": cell.certified_gradients(qs, nearest, gradients),
    }
    return Clearances(cell, nearest, gradients, about)
