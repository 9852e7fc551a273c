"""Batches of joint motions of a robot: planned and audited, as JSON or npy."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.collision.contact.words import ContactCertificate
from gelenk.contract.trajectories import COLUMNS, MAX_MOTIONS, MotionsRequest
from gelenk.errors import InvalidArray, InvalidField, TooLarge, counted
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.operations.cells import cell_of, has_cell
from gelenk.operations.chains import check_numbers, head
from gelenk.operations.outcome import Limits, Outcome, always
from gelenk.operations.trajectory_limits import OwnVelocities, SourcedLimits, bounds_of, limit_notes, own_velocities
from gelenk.operations.trajectory_planned import limits_json
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot
from gelenk.trajectory.batch import BatchMotions, plan_batch
from gelenk.trajectory.problem.problem import Segment

is_heavy = always


@dataclass(frozen=True, slots=True)
class MotionBatch:
    """A batch of motions as the core takes it: starts (1 or N, n), targets (N, n), and limits with their sources."""

    chain: Chain
    starts: Array
    targets: Array
    own: OwnVelocities
    bounds: SourcedLimits
    move: Segment

    def planned(self, robot: RobotModel, cell: Cell | None = None) -> BatchMotions:
        """Plan and audit the motions."""
        return plan_batch(robot, self.chain, self.starts, self.targets, self.move, cell)

    def to_json(
        self,
        results: Any,
        certificate: PoseCertificate,
        warnings: Sequence[str] = (),
        contact_certificate: ContactCertificate | None = None,
    ) -> dict[str, Any]:
        """Return the answer with given results."""
        answer = {
            **head(self.chain),
            "results": results,
            "limits": limits_json(self.bounds.limits),
            "limit_sources": self.bounds.sources,
            "notes": [*limit_notes(self.chain, self.own, [self.bounds]), *warnings],
            "certificate": certificate,
        }
        return answer | ({"contact_certificate": contact_certificate} if contact_certificate else {})


def run(loaded: LoadedRobot, call: MotionsRequest, limits: Limits) -> Outcome:
    """Plan and audit the motions of a call."""
    batch = parse(loaded.robot, call, MAX_MOTIONS)
    check_numbers(len(batch.targets) * (len(COLUMNS) + has_cell(call)), limits)
    cell, warnings = cell_of(loaded, batch.chain, call) or (None, [])
    found = batch.planned(loaded.robot, cell)
    about = found.certificate, warnings, found.contact_certificate
    return Outcome(lambda: batch.to_json(results_json(found), *about), lambda: (table(found), {}))


def parse(robot: RobotModel, call: MotionsRequest, most: int) -> MotionBatch:
    """Convert a request for the core; raises InvalidInput, which names the field, or TooLarge."""
    if len(call.targets) > most:
        raise TooLarge("motions in one call", len(call.targets), most)
    if (given := call.own_limits()) is not None and given.joint_torque is not None:
        raise InvalidField("limits.joint_torque", "is of a single `trajectory`: motions of a batch have no torques")
    chain = robot.chain(call.base_frame, call.tip_frame)
    starts, targets = _ends(chain, call)
    own = own_velocities(robot, chain)
    bounds = bounds_of(chain, own, {"": call})
    stated = np.array([source == "request" for source in bounds.sources["joint_jerk"]])
    jerk = np.where(stated, bounds.limits.jerk, np.inf) if stated.any() else None
    return MotionBatch(chain, starts, targets, own, bounds, Segment("joint", call.law, bounds.limits, stated_jerk=jerk))


def _ends(chain: Chain, call: MotionsRequest) -> tuple[Array, Array]:
    """Return the starts, (1 or N, n), and the targets, (N, n), [rad or m]."""
    if isinstance(call.targets, np.ndarray):  # An npy body holds both.
        if call.targets.ndim != 3 or call.targets.shape[1] != 2:
            raise InvalidArray(
                f"starts and targets form an array of shape (N, 2, {len(chain)}); this one has {call.targets.shape}"
            )
        starts, targets = np.moveaxis(call.targets, 1, 0)
        return configurations(chain, starts, "starts"), configurations(chain, targets, "targets")
    if call.starts is None:
        raise InvalidField("starts", "is missing: give one configuration for each target, or a single one for all")
    starts, targets = (configurations(chain, getattr(call, name), name) for name in ("starts", "targets"))
    if len(starts) not in {1, len(targets)}:
        reason = f"{counted(len(starts), 'entry')} for {counted(len(targets), 'target')}: give one each, or one for all"
        raise InvalidField("starts", reason)
    return starts, targets


def table(found: BatchMotions) -> Array:
    """Return the motions as one array."""
    return found.rows if found.clearances is None else np.column_stack((found.rows, found.clearances))


def results_json(found: BatchMotions) -> list[dict[str, Any]]:
    """Return the results as JSON content; NaN and infinite numbers become null."""
    columns = COLUMNS if found.clearances is None else (*COLUMNS, "clearance")
    return [
        {**dict(zip(columns, row, strict=True)), "passed": i not in found.reasons, "reason": found.reasons.get(i)}
        for i, row in enumerate(table(found).tolist())
    ]
