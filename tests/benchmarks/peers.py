"""Solvers of inverse kinematics behind one face: ours and those of others.

Each is told the tolerance in its own terms, so that what it accepts is within `TOLERANCE` in position and in
orientation, and gets targets in the form that it takes them in: only its own work is measured.
"""

import tempfile
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import accumulate
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.closed.nearest_branch import nearest_branch
from gelenk.ik.search import kernels
from gelenk.ik.search.bounds import make_goal, target_rows
from gelenk.ik.search.search import ITERATIONS_PER_START, MAX_ITERATIONS
from gelenk.ik.search.task import FULL_POSE
from gelenk.robot.arrays import Array
from gelenk.robot.description import UrdfLimits
from gelenk.robot.notations import placement, quaternions_xyzw_from_rotations
from gelenk.robot.poses import Poses
from gelenk.robot.urdf import write_urdf
from tests.benchmarks.arms import BASE, TIP, Arm, alone
from tests.ik.arms import search

TOLERANCE = 1e-5
"""In position [m] and in orientation [rad], each as a norm."""
TIMEOUT = 0.005
"""For one target, where a solver has such a thing, [s]."""


class Peer(ABC):
    """A solver made ready for one arm.

    Attributes:
        name: What it is called in the tables.
        package: The distribution it comes from.
        every: It is given every so many-th target; more than 1 where it is slow.
        one_core: Whether it is held on one core.
    """

    name: ClassVar[str]
    package: ClassVar[str]
    every: ClassVar[int] = 1
    one_core: ClassVar[bool] = False

    @abstractmethod
    def __init__(self, arm: Arm) -> None:
        """Whatever this raises, the arm is beyond the solver."""

    @abstractmethod
    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        """The call that is measured: a pose to be reached, shape (4, 4), from a configuration, shape (n,)."""

    @abstractmethod
    def read(self, answer: Any) -> Array | None:
        """What the call returned, as a configuration, shape (n,), or None where it found none."""


class BatchPeer(Peer):
    """One that also takes all targets in one call."""

    @abstractmethod
    def ask_again(self, T: Array, seed: Array, times: int) -> Callable[[], Any]:
        """One call that solves the same target so many times, one after the other: what a solve costs inside it."""

    @abstractmethod
    def ask_all(self, Ts: Array, seed: Array) -> Callable[[], Any]:
        """The call that is measured: poses to be reached, shape (N, 4, 4), from a configuration, shape (n,)."""

    @abstractmethod
    def read_all(self, answer: Any) -> Array:
        """What the call returned, as configurations, shape (N, n), NaN where it found none."""


class Gelenk(BatchPeer):
    """Ours: the search alone, on one thread."""

    name = "Gelenk"
    package = "gelenk"

    def __init__(self, arm: Arm) -> None:
        self._chain = arm.chain
        self._goal = make_goal(
            arm.chain, FULL_POSE, (TOLERANCE, TOLERANCE), True, MAX_ITERATIONS // ITERATIONS_PER_START
        )

    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        return self.ask_again(T, seed, 1)

    def read(self, answer: Any) -> Array | None:
        qs, winners, *_ = answer
        return np.array(qs[0]) if winners[0] >= 0 else None

    def ask_again(self, T: Array, seed: Array, times: int) -> Callable[[], Any]:
        rows = target_rows(Poses(T[None, :3, 3], T[None, :3, :3]))
        return partial(kernels.search, self._chain.flat, self._goal, np.repeat(rows, times, axis=0), seed[None])

    def ask_all(self, Ts: Array, seed: Array) -> Callable[[], Any]:
        targets = Poses(np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3]))
        return partial(
            search,
            self._chain,
            targets,
            seed[None],
            position_tolerance=TOLERANCE,
            orientation_tolerance=TOLERANCE,
            threads=1,
        )

    def read_all(self, answer: Any) -> Array:
        return np.where(answer.solved[:, None], answer.qs, np.nan)


class GelenkForm(Peer):
    """Ours where there is a closed form: the branch nearest to the seed, on one thread."""

    name = "Gelenk, closed form"
    package = "gelenk"

    def __init__(self, arm: Arm) -> None:
        form = closed_form(arm.chain)
        if form is None:
            raise NotImplementedError("no closed form is known")
        self._nearest = nearest_branch(form, (TOLERANCE, TOLERANCE))

    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        return partial(self._nearest, T, seed)

    def read(self, answer: Any) -> Array | None:
        return None if answer is None else np.asarray(answer)


class TracIk(Peer):
    """TRAC-IK as it comes: two threads, one on each core, the first to arrive wins.

    It compares component by component and reads limits from a URDF as single-precision numbers: hence √3, and the
    limits handed over once more.
    """

    name = "TRAC-IK"
    package = "pytracik"

    def __init__(self, arm: Arm) -> None:
        import pytracik

        urdf = write_urdf(alone(arm))
        speed = pytracik.SolveType.Speed
        self._solver = pytracik.TRAC_IK(BASE, TIP, urdf, TIMEOUT, TOLERANCE / np.sqrt(3.0), speed)
        self._ik = pytracik.ik
        no_limit = float(np.finfo(np.float32).max)
        limits = (np.clip(bound, -no_limit, no_limit).tolist() for bound in (arm.chain.lower, arm.chain.upper))
        pytracik.set_joint_limits(self._solver, *limits)

    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        ik, solver = self._ik, self._solver
        x, y, z = T[:3, 3].tolist()
        quaternion = quaternions_xyzw_from_rotations(np.ascontiguousarray(T[None, :3, :3]))[0].tolist()
        return lambda: ik(solver, seed, x, y, z, *quaternion)

    def read(self, answer: Any) -> Array | None:
        return np.array(answer[1:]) if answer[0] >= 0 else None


class TracIkOnOneCore(TracIk):
    """Both threads of TRAC-IK on the one core that all others make do with."""

    name = "TRAC-IK, one core"
    one_core = True


class IkLm(Peer):
    """The Levenberg-Marquardt solver of the Robotics Toolbox in C++, up to 100 searches of 30 steps as it comes.

    Its tolerance is of half the squared norm of all six components.
    """

    name = "ik_LM"
    package = "roboticstoolbox-python"
    gain: ClassVar[float] = 1.0
    """Of the damping; 1 if nothing is said."""

    def __init__(self, arm: Arm) -> None:
        import roboticstoolbox as rtb

        steps = []
        for i, joint in enumerate(alone(arm).joints):
            steps.append(rtb.ET.SE3(placement(joint.origin.xyz, joint.origin.rpy)))
            limits = joint.limits
            span = [-np.pi if limits.lower is None else limits.lower, np.pi if limits.upper is None else limits.upper]
            if joint.type != "fixed":
                motion = rtb.ET.tz if joint.type == "prismatic" else rtb.ET.Rz
                steps.append(motion(jindex=i, qlim=np.array(span)))
        self._ets = rtb.ETS(steps)

    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        ik, tolerance, gain = self._ets.ik_LM, TOLERANCE**2 / 2.0, self.gain
        return lambda: ik(T, q0=seed, tol=tolerance, k=gain)

    def read(self, answer: Any) -> Array | None:
        return np.array(answer.q) if answer.success else None


class IkLmTuned(IkLm):
    """The same with the gain that is quickest on most of our arms."""

    name = "ik_LM, k = 0.1"
    gain = 0.1


class Optik(Peer):
    """OptIK on one thread; held on one core, because handing each call to that thread is then quicker.

    Its tolerance is of the squared norm of all six components. It knows no continuous joints: two turns either way
    stand for them. It knows no prismatic joints either, and ends its process when it meets one.
    """

    name = "OptIK"
    package = "optik-py"
    one_core = True

    def __init__(self, arm: Arm) -> None:
        import optik

        description = alone(arm)
        if any(joint.type == "prismatic" for joint in description.joints):
            raise NotImplementedError("prismatic joints")
        turns = UrdfLimits(-4.0 * np.pi, 4.0 * np.pi)
        joints = tuple(
            replace(joint, type="revolute", limits=turns) if joint.type == "continuous" else joint
            for joint in description.joints
        )
        build = partial(optik.Robot.from_urdf_file, base_link=BASE, ee_link=TIP)
        self._robot = from_file(build, write_urdf(replace(description, joints=joints)))
        self._robot.set_parallelism(1)
        self._settings = optik.SolverConfig(max_time=TIMEOUT, tol_f=TOLERANCE**2)

    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        ik, settings, rows, start = self._robot.ik, self._settings, T.tolist(), seed.tolist()
        return lambda: ik(settings, rows, start)

    def read(self, answer: Any) -> Array | None:
        return None if answer is None else np.array(answer[0])


class Eaik(Peer):
    """EAIK: all solutions in closed form, for arms of up to six revolute joints whose axes allow of one."""

    name = "EAIK"
    package = "eaik"

    def __init__(self, arm: Arm) -> None:
        from eaik.IK_Homogeneous import HomogeneousRobot

        joints = alone(arm).joints
        if any(joint.type == "prismatic" for joint in joints):
            raise NotImplementedError("prismatic joints")
        placements = [placement(joint.origin.xyz, joint.origin.rpy) for joint in joints]
        self._robot = HomogeneousRobot(np.array(list(accumulate(placements, np.matmul))))
        if not self._robot.hasKnownDecomposition():
            raise NotImplementedError("no closed form is known")
        self._chain = arm.chain

    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        # It finds all solutions there are; that its answer makes an array of them when it is read is not counted.
        del seed
        ik = self._robot.IK
        return lambda: ik(T)

    def read(self, answer: Any) -> Array | None:
        """The first solution that whole turns bring within the limits, exact ones before approximate ones."""
        lower, upper = self._chain.lower, self._chain.upper
        qs = np.array(answer.Q).reshape(-1, len(self._chain))[np.argsort(answer.is_LS, kind="stable")]
        limited = np.isfinite(lower)
        turns = np.ceil((np.where(limited, lower, qs) - qs) / (2.0 * np.pi))
        inside = qs + 2.0 * np.pi * turns
        found = np.flatnonzero((inside <= upper).all(axis=1))
        return np.array(inside[found[0]]) if len(found) else None


class IkPy(Peer):
    """IKPy: one search by SciPy's least squares, no restarts."""

    name = "IKPy"
    package = "ikpy"
    every = 10

    def __init__(self, arm: Arm) -> None:
        from ikpy.chain import Chain

        active = [False, *[True] * len(arm.chain), False]
        build = partial(Chain.from_urdf_file, base_elements=[BASE], active_links_mask=active)
        self._chain = from_file(build, write_urdf(alone(arm)))

    def ask(self, T: Array, seed: Array) -> Callable[[], Any]:
        ik, start = self._chain.inverse_kinematics_frame, np.array([0.0, *seed, 0.0])
        return lambda: ik(T, initial_position=start, orientation_mode="all", tol=1e-12)

    def read(self, answer: Any) -> Array | None:
        return np.array(answer[1:-1])


PEERS: tuple[type[Peer], ...] = (Gelenk, GelenkForm, TracIk, TracIkOnOneCore, IkLm, IkLmTuned, Optik, Eaik, IkPy)


def from_file(build: Callable[[str], Any], urdf: str) -> Any:
    """What a function that wants a file makes of a URDF."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "arm.urdf"
        path.write_text(urdf, encoding="utf-8")
        return build(str(path))
