"""What a shell completes: the names of robots."""

import json
import os
import urllib.error
import urllib.request
from pathlib import Path

import typer

_CATALOGUE = Path(os.environ.get("GELENK_CATALOGUE_DIR") or Path(__file__).parents[2] / "robots")
_PATIENCE = 2.0
"""[s]; who has pressed a key waits."""


def robots_beginning_with(context: typer.Context, incomplete: str) -> list[str]:
    """Names of robots: the server's where one is meant, else those of the catalogue."""
    server = context.find_root().params.get("server") or os.environ.get("GELENK_SERVER")
    names = _names_at(server) if server else [folder.name for folder in _CATALOGUE.glob("*/")]
    return sorted(name for name in names if name.startswith(incomplete))


def _names_at(server: str) -> list[str]:
    """Those of a server; none where it does not answer. Without the client, which takes seconds to load."""
    key = os.environ.get("GELENK_KEY")
    headers = {"Authorization": f"Bearer {key}"} if key else {}
    try:
        request = urllib.request.Request(f"{server.rstrip('/')}/v1/robots", headers=headers)  # noqa: S310
        with urllib.request.urlopen(request, timeout=_PATIENCE) as answer:  # noqa: S310 - the user's own address
            return [str(robot["name"]) for robot in json.load(answer)["robots"]]
    except (OSError, ValueError):
        return []
