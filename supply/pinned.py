"""What the lock files pin: the packages of the service, and those that the studio is bundled from."""

import base64
import json
import re
from dataclasses import dataclass
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parent.parent
RUN_LOCK = ROOT / "requirements.lock"
STUDIO_LOCK = ROOT / "app" / "studio" / "package-lock.json"

_HASH = re.compile(r"--hash=sha256:([0-9a-f]{64})")


@dataclass(frozen=True, slots=True)
class Pinned:
    """A package at a version.

    Attributes:
        ecosystem: `pypi` or `npm`.
        name: As the ecosystem writes it.
        version: The one version.
        marker: On which systems it is installed; "" for all.
        algorithm: Of the hashes, as CycloneDX writes it.
        hashes: Of the files that it may come as, in hexadecimal digits.
        licence: What the lock file says of it, if it does.
    """

    ecosystem: str
    name: str
    version: str
    marker: str
    algorithm: str
    hashes: tuple[str, ...]
    licence: str | None = None

    @property
    def is_for_here(self) -> bool:
        """Whether it is installed on this system."""
        return not self.marker or Requirement(f"{self.name}; {self.marker}").marker.evaluate()  # type: ignore[union-attr]


def python_packages(lock: Path = RUN_LOCK) -> list[Pinned]:
    """The packages of a lock file, by name and version.

    Raises:
        ValueError: An entry is not pinned to one version with its hashes.
    """
    entries = re.sub(r"\\\n\s*", " ", lock.read_text(encoding="utf-8")).splitlines()
    return sorted((_python_package(entry) for entry in entries if entry), key=lambda each: (each.name, each.version))


def _python_package(entry: str) -> Pinned:
    requirement, hashes = Requirement(entry.partition(" --hash")[0].strip()), tuple(sorted(_HASH.findall(entry)))
    versions = [each.version for each in requirement.specifier if each.operator == "=="]
    if len(versions) != 1 or len(requirement.specifier) != 1 or not hashes:
        raise ValueError(f"{requirement.name} is not pinned to one version with its hashes")
    marker = "" if requirement.marker is None else str(requirement.marker)
    return Pinned("pypi", canonicalize_name(requirement.name), versions[0], marker, "SHA-256", hashes)


def bundled_packages(lock: Path = STUDIO_LOCK) -> list[Pinned]:
    """The packages whose code is in the studio's bundle, by name; tools that only made it are left out."""
    entries = json.loads(lock.read_text(encoding="utf-8"))["packages"]
    return [
        Pinned(
            "npm",
            path.rpartition("node_modules/")[2],
            entry["version"],
            "",
            "SHA-512",
            (base64.b64decode(entry["integrity"].removeprefix("sha512-")).hex(),),
            entry.get("license"),
        )
        for path, entry in sorted(entries.items())
        if path and not entry.get("dev")
    ]
