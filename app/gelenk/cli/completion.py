"""Completion in a shell: names of robots and frames, and the words that an option accepts."""

import json
import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, get_args
from urllib.parse import quote

import typer

from gelenk.package_data import catalogue
from gelenk.trajectory.audit.words import Law

METHODS = ("auto", "analytic", "newton", "gradient", "gradient_then_newton", "damped_least_squares")
LAWS = sorted(get_args(Law), key=lambda law: law != "trapezoidal")
"""Time laws of a trajectory, the default first."""
REFERENCES = ("local_world_aligned", "local", "world", "space_screws", "body_screws")
REPRESENTATIONS = ("geometric", "zyz", "rpy")
CONVENTIONS = ("standard", "modified")
WORKSPACES = ("cloud", "grid", "dexterity")

_CATALOGUE = Path(os.environ.get("GELENK_CATALOGUE_DIR") or catalogue())
_PATIENCE = 2.0
"""Time limit, [s]; the user waits for the completion."""
_LINK = re.compile(r"<link\s[^>]*?name\s*=\s*[\"']([^\"']+)")


def robots_beginning_with(context: typer.Context, incomplete: str) -> list[str]:
    """Complete names of robots: the server's if one is given, else those of the catalogue."""
    server = _server(context)
    robots = _asked(server, "robots").get("robots", []) if server else []
    names = [str(robot["name"]) for robot in robots] if server else [folder.name for folder in _CATALOGUE.glob("*/")]
    return sorted(name for name in names if name.startswith(incomplete))


def scenes_beginning_with(context: typer.Context, incomplete: str) -> list[str]:
    """Complete names of the server's scenes."""
    server = _server(context)
    scenes = _asked(server, "scenes").get("scenes", []) if server else []
    return sorted(name for scene in scenes if (name := str(scene["name"])).startswith(incomplete))


def frames_beginning_with(context: typer.Context, incomplete: str) -> list[str]:
    """Complete frames of the robot named before: all of them, or without a server the ends of its chains."""
    # While an option waits for its value, arguments are not yet parsed: the robot is the last of them.
    words = [word for word in context.args if not word.startswith("-")]
    robot, server = str(context.params.get("robot") or (words or [""])[-1]), _server(context)
    if robot.lower().endswith(".urdf"):
        names = _LINK.findall(_text_of(Path(robot)))
    elif server:
        names = [str(frame) for frame in _asked(server, f"robots/{quote(robot, safe='')}").get("frames", [])]
    else:
        record = json.loads(_text_of(_CATALOGUE / robot / "robot.json") or "{}")
        chains = [record.get("default_chain", {}), *record.get("chains", {}).values()]
        names = [str(frame) for chain in chains for frame in chain.values()]
    return sorted({name for name in names if name.startswith(incomplete)})


def one_of(words: Sequence[str]) -> Callable[[str], list[str]]:
    """Return a function that completes these words."""
    return lambda incomplete: [word for word in words if word.startswith(incomplete)]


def _server(context: typer.Context) -> str | None:
    server = context.find_root().params.get("server") or os.environ.get("GELENK_SERVER")
    return str(server) if server else None


def _text_of(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return ""


def _asked(server: str, path: str) -> dict[str, Any]:
    """Return a server's answer, or {} without one. It avoids the client, which takes a second to load."""
    import urllib.request  # noqa: PLC0415 - only completion needs it

    key = os.environ.get("GELENK_KEY")
    headers = {"Authorization": f"Bearer {key}"} if key else {}
    try:
        request = urllib.request.Request(f"{server.rstrip('/')}/v1/{path}", headers=headers)  # noqa: S310
        with urllib.request.urlopen(request, timeout=_PATIENCE) as answer:  # noqa: S310 - the user's own address
            content = json.load(answer)
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}
