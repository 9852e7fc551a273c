"""The core as a library, without a service: `gelenk.Robot`. It needs `gelenk[engine]`.

    >>> arm = gelenk.Robot.load("panda", tip_frame="panda_link8")
    >>> arm.fk([0.2, -0.785, 0.1, -2.356, 0.3, 1.571, 0.785]).poses.positions
    array([[0.28308777, 0.13047247, 0.59139586]])

Results are the core's own: arrays and the certificate that the service sends. They have one row for each configuration
or target, also for a single one. Invalid input raises one of the classes of `gelenk.errors`. Metres, radians,
linear before angular.
"""

import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Self, TypeAlias, TypeVar, cast

import numpy as np
from pydantic import BaseModel, ValidationError

from gelenk.collision.cell import Cell, Contacts
from gelenk.contract.common import as_lists
from gelenk.contract.dh import DhTablePayload
from gelenk.contract.ik import InverseRequest
from gelenk.contract.scene import InCell
from gelenk.contract.trajectory_request import TrajectoryRequest
from gelenk.dh.tables.convert import describe_dh
from gelenk.errors import InvalidField, UnknownRobot, counted
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.ik.solve import solve
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.kinematics.ellipsoids.manipulability import Manipulability, manipulability
from gelenk.kinematics.judge.words import Reference
from gelenk.kinematics.poses.forward import ForwardKinematics, forward_kinematics
from gelenk.kinematics.velocity.jacobian import Jacobians, Representation, jacobians
from gelenk.operations import trajectory_request
from gelenk.operations.cells import cell_of
from gelenk.operations.ik_contacts import contacts_of
from gelenk.operations.ik_request import TargetLimits, parse
from gelenk.package_data import catalogue
from gelenk.robot import robot as core
from gelenk.robot.arrays import Array, Configuration
from gelenk.robot.configuration import configurations
from gelenk.robot.dh import Convention
from gelenk.robot.urdf import read_urdf
from gelenk.store.local import local_robot
from gelenk.store.records import LoadedRobot, describe, load, read_record
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Trajectory

Configurations: TypeAlias = Configuration | Sequence[Configuration] | Array
_Payload = TypeVar("_Payload", bound=BaseModel)
_UNBOUNDED = TargetLimits(targets=10**12, stepwise=10**12, numbers=None)


class Robot:
    """A chain of a robot, from its base to its tip.

    Attributes:
        joint_names: The variables, base to tip: the order of a configuration.
        chain: Chain as the functions of `gelenk.kinematics` take it, with its `base_frame`, its `tip_frame` and the
            limits `lower` and `upper`.
        core: The whole robot, as these functions take it.
    """

    def __init__(
        self,
        robot: core.RobotModel | LoadedRobot,
        base_frame: str | None = None,
        tip_frame: str | None = None,
    ) -> None:
        self._loaded = robot if isinstance(robot, LoadedRobot) else local_robot(robot)
        self.core = self._loaded.robot
        self.chain = self.core.chain(base_frame, tip_frame)
        self.joint_names = self.chain.joint_names

    def __repr__(self) -> str:
        name, chain = self.core.description.name, self.chain
        return f"<gelenk.Robot {name!r}: {chain.base_frame} to {chain.tip_frame}, {counted(len(chain), 'joint')}>"

    @staticmethod
    def names() -> list[str]:
        """Return the names of the catalogue's robots."""
        return sorted(folder.name for folder in catalogue().iterdir() if folder.is_dir())

    @classmethod
    def load(cls, name: str, base_frame: str | None = None, tip_frame: str | None = None) -> Self:
        """Load a robot of the catalogue; frames default to those of its default chain.

        Raises:
            UnknownRobot: The catalogue has no robot of this name.
            UnknownFrame: The robot has no such frame.
        """
        record = read_record(catalogue() / name, "catalogue") if name in cls.names() else None
        if record is None:
            raise UnknownRobot(name, tuple(get_close_matches(name, cls.names())))
        return cls(load(record), base_frame, tip_frame)

    @classmethod
    def from_urdf(
        cls,
        urdf: str | os.PathLike[str],
        base_frame: str | None = None,
        tip_frame: str | None = None,
        *,
        strict: bool = False,
    ) -> Self:
        """Read the robot that a URDF describes; frames default to those of the longest chain.

        Args:
            urdf: Path of a file, or the text itself. Meshes, which count in a scene, are found from the file's folder.
            base_frame: Base of the chain.
            tip_frame: Tip of the chain.
            strict: Whether to refuse faults that do not affect kinematics too.

        Raises:
            InvalidUrdf: It is not a valid URDF; the message names the element and the line.
            UnknownFrame: The robot has no such frame.
            OSError: The file cannot be read.
        """
        if isinstance(urdf, str) and urdf.lstrip("\ufeff \t\r\n").startswith("<"):
            return cls(core.RobotModel(read_urdf(urdf, strict)), base_frame, tip_frame)
        description, *_ = describe(Path(urdf).stem, "urdf", Path(urdf).read_bytes(), strict)
        return cls(local_robot(core.RobotModel(description), Path(urdf)), base_frame, tip_frame)

    @classmethod
    def from_dh(
        cls,
        joints: Sequence[Mapping[str, object]],
        convention: Convention = "standard",
        *,
        base: Array | None = None,
        tool: Array | None = None,
    ) -> Self:
        """Build the chain of a Denavit-Hartenberg table, from `base` to `tool`.

        Args:
            joints: Rows of the table, with the fields of the API: `type`, `a`, `alpha`, `d`, `theta`, and where known
                `name`, `lower`, `upper`, `velocity`, `effort`, `mimic`; [m], [rad].
            convention: `standard` or `modified`.
            base: T_base_0 as a matrix, shape (4, 4); the identity if left out.
            tool: T_n_tool as a matrix, shape (4, 4); the identity if left out.

        Raises:
            InvalidField: A row has a field that is unknown, missing or not a number.
            InvalidDhTable: The table does not describe a robot.
            InvalidPose: Base or tool is not a transform.
        """
        places = {name: {"matrix": T} for name, T in (("base", base), ("tool", tool)) if T is not None}
        table = _checked(DhTablePayload, {"convention": convention, "joints": joints, **places}).table()
        return cls(local_robot(core.RobotModel(describe_dh("robot", table)), table=table))

    def fk(self, q: Configurations, frames: Sequence[str] = ()) -> ForwardKinematics:
        """Compute poses of the tip, `poses`, and of other frames on the chain, `frames`, at each configuration.

        Args:
            q: One number per joint, base to tip, or values by name, [rad or m]; or several such, or an array (N, n).
            frames: Names of the other frames.

        Raises:
            WrongJointCount: A configuration does not have one number per joint; other classes report other faults.
            UnknownFrame: The robot has no such frame.
            CertificationFailed: Pinocchio's poses differ.
        """
        return forward_kinematics(self.core, self.chain, self._rows(q), frames)

    def jacobian(
        self,
        q: Configurations,
        *,
        reference: Reference = "local_world_aligned",
        representation: Representation = "geometric",
        derivatives: bool = False,
    ) -> Jacobians:
        """Compute Jacobians, `values` of shape (N, 6, n), and with `derivatives` their `hessians`.

        For the other arguments and the errors, see `gelenk.kinematics.velocity.jacobian.jacobians`; for `q` see `fk`.
        """
        options: dict[str, Any] = {"representation": representation, "derivatives": derivatives}
        return jacobians(self.core, self.chain, self._rows(q), reference=reference, **options)

    def manipulability(
        self,
        q: Configurations,
        *,
        task: Sequence[Direction] = DIRECTIONS,
        reference: Reference = "local_world_aligned",
        characteristic_length: float | None = None,
        gradient: bool = False,
    ) -> Manipulability:
        """Compute velocity and force ellipsoids; Yoshikawa's measure is `parts["translation"].measures`, shape (N,).

        For the other arguments and the errors, see `gelenk.kinematics.ellipsoids.manipulability.manipulability`; for
        `q` see `fk`.
        """
        options: dict[str, Any] = {"characteristic_length": characteristic_length, "gradient": gradient}
        return manipulability(self.core, self.chain, self._rows(q), task=task, reference=reference, **options)

    def ik(
        self,
        targets: Mapping[str, object] | Sequence[Mapping[str, object]] | Array,
        seed: Configurations | None = None,
        **options: Any,
    ) -> InverseKinematics:
        """Compute configurations that bring the tip to each target: `qs[firsts[i]:firsts[i + 1]]` for target i.

        If there is none, `statuses[i]` is not `solved`; `failures[i]` has the reason and the nearest configuration.

        Args:
            targets: One pose or several: matrices of shape (4, 4), rows `x y z qx qy qz qw`, or the API's poses such
                as `{"position": [0.4, 0.1, 0.5], "rpy": [3.0, 0.2, 0.4]}`.
            seed: Where to start, and what solutions should be near to: one configuration, or one per target.
            options: Options of the API, such as `solutions="all"`, `task`, `method`, `respect_limits`, `fixed_joints`,
                `scene`; in a scene `touching` flags solutions in contact, if all are requested.

        Raises:
            InvalidField: An option is unknown, or excluded by another one.
            InvalidPose: A target is not a pose.
            InvalidArray: The targets are an array of another shape.
            CertificationFailed: Coal contradicts a contact.
        """
        call = _checked(InverseRequest, {"targets": [], **self._ends(), **options})
        fields: dict[str, object] = {} if seed is None else {"seeds": _several(seed)}
        given = [targets] if isinstance(targets, Mapping) else targets
        if len(given) and isinstance(given[0], Mapping):
            fields["targets"] = _checked(InverseRequest, {"targets": given}).targets
        else:
            array = np.asarray(given, dtype=float)
            fields["targets"] = array[None] if array.shape in {(7,), (4, 4)} else array
        call = call.model_copy(update=fields)  # arrays do not go number by number through pydantic
        cell, problem = self._cell(call), parse(self.core, call, _UNBOUNDED, call.time_limit)
        found = solve(problem, cell)
        contacts_of(cell, found)  # refuses what Coal does not confirm
        return found

    def trajectory(self, start: Configuration, segments: Sequence[Mapping[str, object]], **options: Any) -> Trajectory:
        """Plan a motion from rest to rest: its polynomials are `motion`, and `audit` is the check that it passed.

        `motion.at(times)` are positions at times of shape (N,) up to `motion.duration`; `motion.rates_at(times)` are
        positions, velocities and accelerations; each of shape (N, n).

        Args:
            start: Configuration at the start.
            segments: As in the API, such as `{"type": "joint", "target": q}` or `{"type": "line", "target": pose}`.
            options: The API's options for the motion, such as `law`, `limits`, `duration`, `near_singularity`, `scene`.

        Raises:
            InvalidField: A segment or an option is unknown or contradicts another one, or its duration is too short.
            OutsideLimits: The start is beyond a joint's limits.
            AuditFailed: The motion does not pass its audit.
        """
        call = _checked(TrajectoryRequest, {**self._ends(), "start": start, "segments": segments, **options})
        problem = trajectory_request.parse(self.core, self.chain, call).problem
        return plan(self.core, self.chain, replace(problem, cell=self._cell(call)))

    def collisions(
        self,
        q: Configurations,
        scene: Mapping[str, object] | None = None,
        other_joints: Mapping[str, float] | None = None,
    ) -> Contacts:
        """Find the nearest pair at each configuration: of links, and of a link and an object of the scene.

        The first call finds the robot's bodies, which takes seconds if it has meshes.

        Args:
            q: See `fk`.
            scene: Objects as in the API: `{"objects": [{"name": "table", "shape": {...}, "pose": {...}}]}`.
            other_joints: Where joints stand that the chain does not move, by name, [rad or m]; else at 0.

        Raises:
            InvalidField: The scene, or a joint, is not what it should be.
            InvalidMesh: A mesh of the robot cannot be read.
            CertificationFailed: Coal's distances differ.
        """
        fields = {"scene": scene, "min_clearance": 0.0, "other_joints": other_joints}
        return cast(Cell, self._cell(_checked(InCell, fields))).contacts(self._rows(q))

    def _cell(self, call: InCell) -> Cell | None:
        """Return what is around the robot in a request, warning of what has no body; None if contacts do not count."""
        found = cell_of(self._loaded, self.chain, call)
        if found is None:
            return None
        for text in found[1]:
            warnings.warn(text, stacklevel=3)
        return found[0]

    def _ends(self) -> dict[str, str]:
        return {"base_frame": self.chain.base_frame, "tip_frame": self.chain.tip_frame}

    def _rows(self, q: Configurations) -> Array:
        """Return configurations in the chain's order; shape (N, n), [rad or m]."""
        return configurations(self.chain, _several(q))


def _several(q: Configurations) -> Sequence[Configuration] | Array:
    """Return one or several configurations as rows."""
    if isinstance(q, np.ndarray):
        return np.ascontiguousarray(np.atleast_2d(q), dtype=float)
    is_one = isinstance(q, Mapping) or not any(isinstance(entry, Sequence | Mapping | np.ndarray) for entry in q)
    return cast(Sequence[Configuration], [q] if is_one else q)


def _checked(model: type[_Payload], fields: Mapping[str, object]) -> _Payload:
    try:
        return model.model_validate(as_lists(fields))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        known = f"; known are {', '.join(model.model_fields)}" if first["loc"][1:] == () else ""
        place = ".".join(part for part in map(str, first["loc"]) if not part.startswith("<"))
        raise InvalidField(place, f"{first['msg']}{known}") from None
