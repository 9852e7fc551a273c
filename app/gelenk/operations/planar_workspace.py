"""POST /v1/course/workspace: the two workspaces of a planar arm."""

import math
from collections.abc import Sequence
from typing import Any

from gelenk.contract.planar_workspace import PlanarWorkspaceRequest
from gelenk.course import planar
from gelenk.operations.outcome import Outcome, PictureFormat


def run(call: PlanarWorkspaceRequest) -> Outcome:
    """Compute the primary and secondary workspaces of a planar arm, and where a point lies in them."""
    return Outcome(lambda: _workspace(call), picture=lambda kind: _picture(call, kind))


def _picture(call: PlanarWorkspaceRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.planar_workspace import planar_workspace_picture  # noqa: PLC0415

    arm = planar.planar_workspace(call.links)
    planar.tried(arm)
    return planar_workspace_picture(arm, call.point, kind)


def _workspace(call: PlanarWorkspaceRequest) -> dict[str, Any]:
    arm = planar.planar_workspace(call.links)
    return {
        "primary": _region(arm.primary),
        "secondary": _region(arm.secondary),
        "point": None if call.point is None else _point(arm, call.point, call.tolerance),
        "steps": planar.workspace_steps(arm),
        "certificate": planar.tried(arm),
    }


def _region(rings: Sequence[planar.Interval]) -> dict[str, Any]:
    return {"intervals": rings, "area": planar.area(rings)}


def _point(arm: planar.PlanarWorkspace, point: Sequence[float], tolerance: float) -> dict[str, Any]:
    radius, found = math.hypot(*point), planar.orientations(arm, *point)
    return {
        "radius": radius,
        "primary": planar.place(arm.primary, radius, tolerance),
        "secondary": planar.place(arm.secondary, radius, tolerance),
        "orientations": found,
        "orientation_share": planar.share(found),
    }
