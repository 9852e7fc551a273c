"""Assembly of a workspace from the parts of its samples, and its certification."""

import math
from dataclasses import asdict, dataclass, replace

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.collision.contact.words import ContactCertificate
from gelenk.kinematics.judge.judge import agreed, certify_jacobians, certify_poses
from gelenk.kinematics.judge.words import WorkspaceCertificate
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.kinematics.workspace.tip_motion import in_axes
from gelenk.kinematics.workspace.voxels import NO_VOXELS, Grid, VoxelTable, coarser, merged
from gelenk.kinematics.workspace.workspace import SampledPart, SamplingPlan
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

POINT_COLUMNS = ("x", "y", "z", "measure")
VOXEL_COLUMNS = ("x", "y", "z", "samples", "best_measure")

_PENDING = 500_000
"""Number of table rows that are collected before they are merged."""
_RARE = 0.02
"""Largest share of samples alone in their cell at which nearly all cells count as found [Good1953]."""
_LATE = 0.1
"""Share of the samples, the last ones, that shows whether more samples would find more cells."""


@dataclass(frozen=True, slots=True)
class Measures:
    """Yoshikawa's measure over the samples that count.

    The position, shape (3,), [m], and the joint positions, shape (n,), [rad or m], are those at the largest measure;
    None if all measures are zero.
    """

    min: float
    mean: float
    max: float
    position: Array | None
    joint_positions: Array | None


@dataclass(frozen=True, slots=True)
class Workspace:
    """The workspace of a chain as found by samples; bounds, reach, measures and late are None if no sample counts.

    Attributes:
        free: Number of samples that are not in contact; all where contacts do not matter.
        count: Number of samples that count.
        bounds: Smallest and largest coordinates; shape (2, 3), [m].
        reach: Smallest and largest distance of the tip from the base's origin, [m].
        inner: Number of cells with neighbours on every side, including edges and corners.
        volume: Lower and upper bound of the volume of the reachable region, [m³, m² or m].
        late: Share of the cells that only the last tenth of the samples found.
        points: Position and measure of each sample; shape (count, 4). None if not requested.
        contacts: How some verdicts about contacts were checked; None where these do not matter.
    """

    free: int
    count: int
    bounds: Array | None
    reach: tuple[float, float] | None
    measures: Measures | None
    voxels: VoxelTable
    inner: int
    volume: tuple[float, float]
    late: float | None
    points: Array | None
    certificate: WorkspaceCertificate
    contacts: ContactCertificate | None

    def voxel_rows(self, plan: SamplingPlan) -> Array:
        """Return one row per cell with the columns `VOXEL_COLUMNS`; shape (M, 5)."""
        table = self.voxels
        return np.column_stack((plan.grid.centres(table.keys), table.counts, table.best))


class Survey:
    """A workspace under construction: collects the parts of a plan one by one, in the order of the samples."""

    def __init__(self, plan: SamplingPlan) -> None:
        self._plan = plan
        self._points = np.empty((plan.sampling.count, 4)) if plan.keeps_points else None
        self._free = self._count = 0
        self._parts: list[SampledPart] = []
        self._voxels = NO_VOXELS
        self._waiting: list[VoxelTable] = []

    def add(self, part: SampledPart) -> None:
        """Add the next part; raises TooLarge if the samples fall into too many cells."""
        if self._points is not None and part.points is not None:
            self._points[self._count : self._count + part.count] = part.points
        self._free += part.free
        self._count += part.count
        self._parts.append(replace(part, points=None, voxels=NO_VOXELS))
        self._waiting.append(part.voxels)
        if sum(map(len, self._waiting)) > max(_PENDING, len(self._voxels)):
            self.merge()

    def merge(self) -> VoxelTable:
        """Merge and return the cells of all parts so far."""
        self._voxels, self._waiting = merged([self._voxels, *self._waiting]), []
        return self._voxels

    def result(self, robot: RobotModel, chain: Chain, cell: Cell | None = None) -> Workspace:
        """Return the workspace from all parts, certified; `cell` is that whose contacts matter."""
        voxels, count, plan = self.merge(), self._count, self._plan
        late = voxels.first >= round((1.0 - _LATE) * plan.sampling.count)
        bounds = np.array([(part.lower, part.upper) for part in self._parts])
        distances = np.array([part.distances for part in self._parts])
        qs = plan.sampling.chosen(self._checked())
        return Workspace(
            self._free,
            count,
            np.stack((bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0))) if count else None,
            (float(distances[:, 0].min()), float(distances[:, 1].max())) if count else None,
            self._statistics() if count else None,
            voxels,
            len(plan.grid.inner(voxels.keys)),
            volume_bounds(plan.grid, voxels, plan.extent),
            float(late.mean()) if count else None,
            None if self._points is None else self._points[:count],
            self._certificate(robot, chain, qs),
            None if cell is None else cell.certified(qs, cell.touching(qs)),
        )

    def _checked(self) -> Indices:
        """Return the numbers of some evenly spaced samples."""
        total = self._plan.sampling.count
        return np.unique(np.linspace(0, total - 1, min(total, 16)).astype(np.int64))

    def _statistics(self) -> Measures:
        best = max(self._parts, key=lambda part: part.measures[1])
        if best.measures[1] == 0.0:
            return Measures(0.0, 0.0, 0.0, None, None)
        q = self._plan.sampling.configurations(best.best, 1)
        return Measures(
            min(part.measures[0] for part in self._parts),
            sum(part.measures[2] for part in self._parts) / self._count,
            best.measures[1],
            self._plan.measured(q)[0][0],
            q[0],
        )

    def _certificate(self, robot: RobotModel, chain: Chain, qs: Array) -> WorkspaceCertificate:
        """Recompute samples, and compare them with the stored ones and with Pinocchio's."""
        plan, numbers = self._plan, self._checked()
        positions, measures = plan.measured(qs)
        poses = Poses(*chain_poses(chain.flat, qs))
        agreed("a position", poses.positions - positions, plan.extent)
        Js = chain_jacobians(chain.flat, qs)[2]
        products, scale = _products(plan, Js)
        error = agreed("the manipulability measure", measures - products, scale)
        if self._points is not None and self._count == plan.sampling.count:
            agreed("a sample's position", self._points[numbers, :3] - positions, plan.extent)
            agreed("a sample's measure", self._points[numbers, 3] - measures, scale)
        return WorkspaceCertificate(
            **asdict(certify_poses(robot, chain, qs, {chain.tip_frame: poses})),
            max_jacobian_error=certify_jacobians(robot, chain, qs, Js).max_error,
            max_measure_error=error,
        )


def volume_bounds(grid: Grid, table: VoxelTable, farthest: float) -> tuple[float, float]:
    """Return a lower and an upper bound of the volume of the region that the samples come from, [m³, m² or m].

    The region contains the inner cells, and lies within the cells it meets. If the samples are too few to find nearly
    all of these, cells of twice the size are used. The number of cells still missing is estimated from those with one
    or two samples [Chao1984]. Without samples the only bound is the ball that the tip cannot leave, of radius
    `farthest` [m].
    """
    d = grid.dimensions
    if d == 0:
        return 0.0, 0.0
    lower, upper = 0.0, math.pi ** (d / 2) / math.gamma(d / 2 + 1) * farthest**d
    while len(table):
        once, twice = (int(np.sum(table.counts == count)) for count in (1, 2))
        lower = max(lower, len(grid.inner(table.keys)) * grid.cell)
        if once <= _RARE * table.counts.sum():
            return lower, min(upper, (len(table) + 0.5 * once * max(0, once - 1) / (twice + 1)) * grid.cell)
        if len(table) <= 1 << d:
            break
        grid, table = coarser(grid, table)
    return lower, upper


def _products(plan: SamplingPlan, Js: Array) -> tuple[Array, float]:
    """Products (N,) of the singular values of the rows that count, from Jacobians in the base frame.

    Also return their scale, to which rounding is relative: the largest singular value to the power of their number.
    """
    if len(plan.rows) == 0 or Js.shape[2] == 0:
        return np.zeros(len(Js)), 0.0
    sigmas = np.linalg.svd(in_axes(Js, plan.turn)[:, plan.rows], compute_uv=False)
    products: Array = np.prod(sigmas, axis=1)
    return products, float(sigmas.max()) ** sigmas.shape[1]
