"""POST /v1/course/workspace: the two workspaces of a planar arm."""

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, Literal

from gelenk.api.course import Picture, course_route
from gelenk.api.remote import Remote
from gelenk.api.routes import DocumentedRoute
from gelenk.contract.course_workspace import EXAMPLE_WORKSPACE, PlanarWorkspaceAnswer, PlanarWorkspaceRequest
from gelenk.course import planar


def workspace_route(remote: Remote, max_body_bytes: int) -> DocumentedRoute:
    """The calculator of planar workspaces."""

    def planar_workspace(call: PlanarWorkspaceRequest) -> PlanarWorkspaceAnswer:
        """Primary and secondary workspace of a planar arm of two or three revolute joints, exactly.

        WS₁ is the set of points reached with at least one orientation, WS₂ the set reached with all. Both are rings
        around the base, given as intervals of the distance r. With three links WS₂ is where the circle of the wrist, of
        radius l_3, lies within the ring of the first two: r + l_3 ≤ l_1 + l_2, and r ≥ l_3 + |l_1 - l_2| or r ≤ l_3 -
        |l_1 - l_2|: up to two pieces. Known solutions of this exercise give the outer ring alone, from l_1 - l_2 + l_3
        to l_1 + l_2 - l_3; they miss the disc around the base that the second condition adds. With two links WS₂ is
        empty, or the base alone where both are of the same length.

        For a `point`: where it lies relative to both, and with which orientations it is reached. The joints turn
        without limits; with limits the boundaries differ, and the workspace of a robot has to be sampled. As a picture
        with `Accept: image/svg+xml` or `image/png`.
        """
        raise NotImplementedError

    return course_route(
        "workspace",
        planar_workspace,
        PlanarWorkspaceRequest,
        _workspace,
        remote,
        max_body_bytes,
        example=EXAMPLE_WORKSPACE,
        picture=Picture("Both workspaces, and the arm with its tip at `point`.", _picture),
        operation_id="planar_workspace",
        summary="Workspaces of a planar arm",
    )


def _picture(call: PlanarWorkspaceRequest, kind: Literal["svg", "png"]) -> bytes:
    # Matplotlib takes a third of a second to load.
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
        "steps": [asdict(step) for step in planar.workspace_steps(arm)],
        "certificate": asdict(planar.tried(arm)),
    }


def _region(rings: Sequence[planar.Interval]) -> dict[str, Any]:
    return {"intervals": rings, "area": planar.area(rings)}


def _point(arm: planar.PlanarWorkspace, point: Sequence[float], tolerance: float) -> dict[str, Any]:
    radius, found = math.hypot(*point), planar.orientations(arm, *point)
    return {
        "radius": radius,
        "primary": asdict(planar.place(arm.primary, radius, tolerance)),
        "secondary": asdict(planar.place(arm.secondary, radius, tolerance)),
        "orientations": found,
        "orientation_share": planar.share(found),
    }
