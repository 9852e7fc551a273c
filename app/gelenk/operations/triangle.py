"""POST /v1/course/triangle: a triangle from three of its parts."""

from typing import Any

from gelenk.contract.triangle import TriangleRequest
from gelenk.course.triangle.triangle import ANGLES, SIDES, Triangle, solved_triangle
from gelenk.course.triangle.triangle_steps import triangle_steps, triangle_warnings
from gelenk.operations.outcome import Outcome, PictureFormat


def run(call: TriangleRequest) -> Outcome:
    """Find the triangles with the given parts."""
    return Outcome(lambda: _triangles(call), picture=lambda kind: _picture(call, kind))


def _parts(call: TriangleRequest) -> dict[str, float]:
    return {name: value for name in (*SIDES, *ANGLES) if (value := getattr(call, name)) is not None}


def _picture(call: TriangleRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.course.triangle import triangle_picture  # noqa: PLC0415

    return triangle_picture(solved_triangle(_parts(call)), kind)


def _triangles(call: TriangleRequest) -> dict[str, Any]:
    parts = _parts(call)
    found = solved_triangle(parts)
    return {
        "case": found.case,
        "triangles": [_triangle(one) for one in found.triangles],
        "steps": triangle_steps(found, parts),
        "warnings": triangle_warnings(found),
        "certificate": found.check,
    }


def _triangle(one: Triangle) -> dict[str, Any]:
    named = dict(zip((*SIDES, *ANGLES), (*one.sides, *one.angles), strict=True))
    return {**named, "area": one.area, "corners": one.corners.tolist()}
