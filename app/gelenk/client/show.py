"""A robot as a picture in a notebook: the studio's page for frames, in a frame."""

import html
import math
from collections.abc import Sequence
from urllib.parse import quote

from gelenk.client.client import service_url
from gelenk.errors import InvalidField, quoted

MARKS = ("frames", "axes", "names", "dh", "bodies")
"""What can be drawn on a robot besides itself, by its name in the page's address."""


class ShownRobot:
    """A frame with a robot that one can turn; a notebook shows it, and `url` is the page in it."""

    def __init__(self, url: str, title: str, height: int) -> None:
        self.url, self._title, self._height = url, title, height

    def _repr_html_(self) -> str:
        src, title = html.escape(self.url), html.escape(self._title)
        return (
            f'<iframe src="{src}" title="{title}" width="100%" height="{self._height}" style="border: 0"></iframe>'
            f'<a href="{src}" target="_blank" rel="noopener">{title}</a>'
        )

    def __repr__(self) -> str:
        return f"ShownRobot({self.url!r})"


def show(
    robot: str,
    joint_positions: Sequence[float] | None = None,
    *,
    base_frame: str | None = None,
    tip_frame: str | None = None,
    marks: Sequence[str] = (),
    height: int = 420,
    server: str | None = None,
) -> ShownRobot:
    """Show a robot of the service in a notebook; its setting `GELENK_FRAME_ANCESTORS` must name the notebook's origin.

    Args:
        robot: Name of a robot that the service has.
        joint_positions: Of all joints of the robot, or of the chain alone, in their order, [rad or m]; else the middle
            of their ranges.
        base_frame, tip_frame: Ends of the chain; else the robot's own.
        marks: What else to draw: any of `MARKS`.
        height: Of the frame, [px].
        server: Address of the service; else `GELENK_SERVER`, else this machine's port 8000.

    Raises:
        InvalidField: A number is not finite, a mark is unknown, or the server is not an address.
    """
    numbers = [float(number) for number in joint_positions] if joint_positions is not None else []
    for place, number in enumerate(numbers):
        if not math.isfinite(number):
            raise InvalidField("joint_positions", f"number {place + 1} is not finite")
    if unknown := [mark for mark in marks if mark not in MARKS]:
        raise InvalidField("marks", f"{quoted(unknown[0])} is none of {', '.join(MARKS)}")
    parts = {
        "robot": robot,
        "base": base_frame,
        "tip": tip_frame,
        "q": ",".join(map(repr, numbers)) or None,
        "show": ",".join(marks) or None,
    }
    address = "&".join(f"{key}={quote(value, safe=',')}" for key, value in parts.items() if value is not None)
    return ShownRobot(f"{service_url(server)}/embed#{address}", robot, height)
