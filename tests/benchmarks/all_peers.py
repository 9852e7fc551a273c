"""Solvers that list all solutions of a target, behind one face: ours and those of others.

Each gets targets in the form that it takes them in, and is asked in the quickest way that it offers for many targets
as well as by single calls from Python. Joint limits count for none of them.
"""

import importlib.util
import re
import tempfile
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from gelenk.ik.closed.closed_form import closed_form, elimination
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.poses import Poses, transform
from tests.benchmarks.all_arms import CASES, ELBOW_ANGLE, LOCKED, arm_of, frames, placements, sliding

GENERAL_FAMILY = "ikgeo.general_6r"
"""What ssik calls an arm of six turning joints without special geometry."""
TABLES = Path(__file__).with_name("ssik_tables")
"""What ssik has derived of such arms; `keep_tables` writes them."""


class Lister(ABC):
    """A solver made ready for one arm and its targets.

    Attributes:
        name: What it is called in the tables.
        package: The distribution it comes from.
        one_core: Whether it is held on one core.
        angles: At how many elbow angles of its own choice it lists the solutions of a target; 1 where there is no
            choice.
    """

    name: ClassVar[str]
    package: ClassVar[str]
    one_core: ClassVar[bool] = True
    angles: int = 1

    @abstractmethod
    def __init__(self, arm: str, targets: Poses, qs: Array) -> None:
        """Make ready; whatever this raises, the arm is beyond the solver.

        Args:
            arm: Its name among the cases.
            targets: N of them.
            qs: The configurations they were drawn at; shape (N, n).
        """

    @abstractmethod
    def ask_some(self, part: slice) -> Callable[[], Any]:
        """The call that is measured: all solutions of some targets, one target after the other."""

    @abstractmethod
    def ask(self, i: int) -> Callable[[], Any]:
        """The call that is measured: all solutions of one target, as one calls it from Python."""

    def ask_for_verified(self, part: slice) -> Callable[[], Any] | None:
        """The same as `ask_some` with each solution recomputed by another library, where it offers that."""
        del part
        return None

    @abstractmethod
    def read(self, answer: Any) -> Sequence[Array]:
        """What `ask_some` returned, as a table of configurations for each target, shape (k, n)."""

    def marked(self, answer: Any) -> Flags | None:
        """Which of these, all targets together, it says itself to be no solutions; None where it says nothing."""
        del answer
        return None


class GelenkForms(Lister):
    """Ours: closed forms, elimination where there is none."""

    name = "Gelenk"
    package = "gelenk"

    def __init__(self, arm: str, targets: Poses, qs: Array) -> None:
        del qs
        self._robot, self._chain = arm_of(arm)
        form = closed_form(self._chain) or elimination(self._chain)
        if form is None:
            raise NotImplementedError("no closed form is known")
        self._form, self._seeds = form, np.zeros((1, len(self._chain)))
        self._angle = ELBOW_ANGLE if form.has_free_elbow else None
        self._targets = targets

    def ask_some(self, part: slice) -> Callable[[], Any]:
        angles = None if self._angle is None else np.array([self._angle])
        return partial(self._form.solve, self._part(part), self._seeds, respect_limits=False, elbow_angles=angles)

    def ask(self, i: int) -> Callable[[], Any]:
        return self.ask_some(slice(i, i + 1))

    def ask_for_verified(self, part: slice) -> Callable[[], Any]:
        options = Options(every=True, respect_limits=False, elbow_angle=self._angle)
        return partial(inverse_kinematics, self._robot, self._chain, self._part(part), self._seeds, options)

    def read(self, answer: Any) -> Sequence[Array]:
        return np.split(answer.qs, answer.firsts[1:-1])

    def _part(self, part: slice) -> Poses:
        return Poses(self._targets.positions[part], self._targets.rotations[part])


class EaikForms(Lister):
    """EAIK, in C++. It takes many targets in one call and is told to use one thread.

    Of a seven-joint arm it gets the third joint locked where the target was drawn with it, a robot for each target.
    """

    name = "EAIK"
    package = "eaik"

    def __init__(self, arm: str, targets: Poses, qs: Array) -> None:
        from eaik.IK_Homogeneous import HomogeneousRobot

        joints = frames(arm_of(arm)[1])
        locked = [[]] if qs.shape[1] < 7 else [[(LOCKED, float(q[LOCKED]))] for q in qs]
        self._robots = [HomogeneousRobot(joints, fixed_axes=fixed) for fixed in locked]
        if not self._robots[0].hasKnownDecomposition():
            raise NotImplementedError("no closed form is known")
        self._Ts, self._n = matrices(targets), qs.shape[1]

    def ask_some(self, part: slice) -> Callable[[], Any]:
        if len(self._robots) == 1:
            return partial(self._robots[0].IK_batched, self._Ts[part], 1)
        calls = [partial(robot.IK, T) for robot, T in zip(self._robots[part], self._Ts[part], strict=True)]
        return lambda: [call() for call in calls]

    def ask(self, i: int) -> Callable[[], Any]:
        return partial(self._robots[i % len(self._robots)].IK, self._Ts[i])

    def read(self, answer: Any) -> Sequence[Array]:
        return [np.array(one.Q).reshape(-1, self._n) for one in answer]

    def marked(self, answer: Any) -> Flags:
        return np.concatenate([np.array(one.is_LS, dtype=bool) for one in answer])


class Ssik(Lister):
    """ssik by the module that it builds for an arm, its C++ on one thread where it has some for the arm's class.

    Many targets are handed to the C++ one by one, without what Python does around it. Of a general arm no module is
    built, because that takes minutes: its C++ gets the table that would stand beside the module. Of an arm with a free
    elbow it lists the solutions at 16 elbow angles of its own.
    """

    name = "ssik"
    package = "ssik"

    def __init__(self, arm: str, targets: Poses, qs: Array) -> None:
        del qs
        from ssik import Manipulator, _native

        manipulator = Manipulator.from_transforms(placements(arm_of(arm)[1]))
        family, body, table = manipulator.solver_name, manipulator.kinbody, None
        if family == GENERAL_FAMILY:
            table = table_of(arm, body)
            self._solve: Callable[..., Any] = partial(_native.try_native_solve, family, body, rr_geometry=table)
        else:
            self._solve = built(manipulator)
        extension, self._compiled = _native._load_ext(), None
        if extension is not None and family in _native._NATIVE_SOLVERS:
            extension.set_max_threads(1)
            self._compiled = _native._solver(extension, body, family, table)
        self._Ts = matrices(targets)
        if family.startswith("seven_r"):
            self.angles = 16

    def ask_some(self, part: slice) -> Callable[[], Any]:
        Ts, solve = self._Ts[part], self._solve
        if self._compiled is None:
            return lambda: [solve(T, respect_limits=False) for T in Ts]
        quick = self._compiled.solve
        return lambda: [quick(T, 0)[0] for T in Ts]

    def ask(self, i: int) -> Callable[[], Any]:
        return partial(self._solve, self._Ts[i], respect_limits=False)

    def read(self, answer: Any) -> Sequence[Array]:
        if self._compiled is None:
            answer = [[solution.q for solution in one] for one in answer]
        return [np.array(one).reshape(len(one), -1) for one in answer]


LISTERS: tuple[type[Lister], ...] = (GelenkForms, EaikForms, Ssik)


def built(manipulator: Any) -> Callable[..., Any]:
    """The `solve` of the module that ssik builds for an arm."""
    from ssik.core.codegen import emit_artifact

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "arm_ik.py"
        plan, body = manipulator.dispatch_plan, manipulator.kinbody
        emit_artifact(kb=body, plan=plan, module_name=path.stem, output_path=str(path))
        spec = importlib.util.spec_from_file_location(path.stem, path)
        assert spec is not None and spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    solve: Callable[..., Any] = module.solve
    return solve


def table_of(arm: str, body: Any) -> Any:
    """What ssik derives of a general arm; kept here, because that is minutes of symbolic algebra."""
    from ssik._native import load_rr_native_geometry, rr_native_geometry
    from ssik.kinematics.poe_to_dh import poe_to_dh

    path = path_of(arm)
    if path.exists():
        table, dh = load_rr_native_geometry(str(path)), poe_to_dh(body)
        fresh = {"alpha": dh.alpha, "a": dh.a, "d": dh.d, "theta_offset": dh.theta_offset}
        if all(np.allclose(table[key], value, rtol=0.0, atol=1e-12) for key, value in fresh.items()):
            return table
    return rr_native_geometry(body)


def path_of(arm: str) -> Path:
    """Where the table of a general arm is kept."""
    return TABLES / ("_".join(re.findall(r"\w+", arm.lower())) + ".npz")


def keep_tables() -> None:
    """Have ssik derive the tables of all general arms anew, and keep them."""
    from ssik import Manipulator
    from ssik._native import bake_rr_tensor_npz

    TABLES.mkdir(exist_ok=True)
    for arm in CASES:
        chain = arm_of(arm)[1]
        if sliding(chain).any():
            continue
        manipulator = Manipulator.from_transforms(placements(chain))
        if manipulator.solver_name == GENERAL_FAMILY:
            bake_rr_tensor_npz(manipulator.kinbody, str(path_of(arm)))


def matrices(targets: Poses) -> list[Array]:
    """Homogeneous transforms; each of shape (4, 4)."""
    return [transform(p, R) for p, R in zip(targets.positions, targets.rotations, strict=True)]
