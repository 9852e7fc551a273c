"""Convex pieces: what the links of a robot and the objects around it are made of where contacts are computed."""

import math
from dataclasses import dataclass
from typing import Literal

from gelenk.robot.arrays import Array

PieceKind = Literal["sphere", "capsule", "cylinder", "box", "convex", "half_space"]


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """One convex piece, fixed to a link; objects of a scene are fixed to the link they are attached to, or to the root.

    Attributes:
        name: Of this piece alone: the link's or object's name, with a number where it has several pieces.
        link: The link in whose frame it is placed.
        kind: sphere (radius), capsule and cylinder (radius, length; along z, a capsule's length without its caps),
            box (x, y, z), convex (nothing; `points`), half_space (nothing; all z ≤ 0). In the frame of the piece.
        size: Numbers of that kind, [m].
        points: Vertices of a convex hull in the frame of the piece, shape (V, 3), [m]; (0, 3) for other kinds.
        T_link_body: Pose of the piece in its link, shape (4, 4).
        spheres: Centres in the link's frame and radii, shape (K, 4), [m]: each point of the piece is in one of them.
            None of a half-space.
        excess: Volume of the piece over that of the mesh it contains, less one; 0 for others, NaN where a mesh is not
            closed and so has no volume.
        cover_excess: Volume of all spheres over that of the piece, less one; NaN of a flat piece, and of objects.
        protrusion: Largest distance of a point of the spheres from the piece, [m]; NaN of objects.
    """

    name: str
    link: str
    kind: PieceKind
    size: tuple[float, ...]
    points: Array
    T_link_body: Array
    spheres: Array
    excess: float = 0.0
    cover_excess: float = math.nan
    protrusion: float = math.nan
