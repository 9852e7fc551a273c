"""Draws the workspace that a job has computed, with captions."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import numpy as np
import orjson


def picture(job: tuple[Path, Path, Literal["svg", "png", "pdf"]]) -> bytes:
    """Draw the result of a job, given as paths of array and summary and a format; for a process of its own."""
    from gelenk.plots.workspace import Picture, picture_bytes  # noqa: PLC0415 - takes a third of a second, and seldom needed

    array, summary, kind = job
    content = orjson.loads(summary.read_bytes())
    voxels = content["voxels"]
    drawn = Picture(
        np.load(array, mmap_mode="r", allow_pickle=False),
        tuple(content["array"]["columns"]),
        str(content.get("robot", "")),
        (content["base_frame"], content["tip_frame"]),
        tuple(captions(content)),
        np.array(voxels["origin"]),
        np.array(voxels["axes"]).T,
        voxels["dimensions"],
        voxels["size"],
    )
    return picture_bytes(drawn, kind)


def captions(content: dict[str, Any]) -> Iterator[str]:
    """Yield the lines of text beside the picture; results of earlier versions do not name their plane."""
    voxels, dexterity, plane = content["voxels"], content["dexterity"], content.get("plane")
    unit = {3: "m³", 2: "m²", 1: "m"}.get(voxels["dimensions"], "")
    if plane is not None:
        origin, normal = (", ".join(f"{value:.4g}" for value in plane[name]) for name in ("origin", "normal"))
        yield f"Slice {plane['thickness']:.4g} m thick, normal ({normal}), through ({origin}) m"
    if (free := content.get("samples_free")) is not None:
        yield f"{free:,} of {_number(content['samples'], 'sample')} without contact"
    yield _counted(content["samples_counted"], content["samples"], plane is not None)
    if content["reach"] is not None:
        yield f"Reach from the base {content['reach']['min']:.4g} m to {content['reach']['max']:.4g} m"
    if voxels["count"] and unit:
        yield f"{_number(voxels['count'], 'voxel')} of {voxels['size']:g} m: {voxels['volume']:.4g} {unit}"
    if dexterity is not None and voxels["count"]:
        yield f"{_number(dexterity['orientations'], 'orientation')} tested at each voxel"


def _counted(counted: int, samples: int, is_slice: bool) -> str:
    if not is_slice:
        return _number(counted, "sample")
    if counted == 0:
        return f"The slice is empty: 0 of {_number(samples, 'sample')}"
    return f"{counted:,} of {_number(samples, 'sample')} in the slice"


def _number(count: int, noun: str) -> str:
    return f"{count:,} {noun}" if count == 1 else f"{count:,} {noun}s"
