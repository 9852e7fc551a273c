"""The systemd unit of `deploy`, read as systemd reads it."""

import shlex
from dataclasses import dataclass
from pathlib import Path

UNIT = Path("deploy/systemd/gelenk.service")
FOLDER = "/opt/gelenk"
"""Where it has the service."""


@dataclass(frozen=True, slots=True)
class Unit:
    """What the unit runs.

    Attributes:
        command: Program and arguments.
        environment: Specifiers are put in.
    """

    command: list[str]
    environment: dict[str, str]


def read(credentials: Path, state: Path, cache: Path) -> Unit:
    """The unit, with the folders that systemd would make."""
    settings: dict[str, list[str]] = {}
    for line in UNIT.read_text(encoding="utf-8").splitlines():
        name, is_setting, value = line.partition("=")
        if is_setting and not line.startswith("#"):
            settings.setdefault(name, []).append(value)
    text = " ".join(settings["Environment"])
    for specifier, folder in (("%d", credentials), ("%S", state), ("%C", cache)):
        text = text.replace(specifier, str(folder))
    assert "%" not in text
    (command,) = settings["ExecStart"]
    return Unit(shlex.split(command), dict(pair.split("=", 1) for pair in shlex.split(text)))


def as_here(folder: Path, python: str) -> str:
    """The unit's text for another place, so that the programs it names are there."""
    text = UNIT.read_text(encoding="utf-8")
    return text.replace(f"{FOLDER}/.venv/bin/python", python).replace(FOLDER, str(folder))
