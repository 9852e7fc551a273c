"""A folder of advisories as a service on this machine, in the protocol of OSV: what pip-audit asks without a network.

Such a folder is a checkout of the Python Packaging Authority's advisory database, or OSV's archive for PyPI, unpacked.
"""

import json
import threading
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import yaml
from packaging.utils import canonicalize_name
from packaging.version import InvalidVersion, Version

Advisory = dict[str, Any]
"""A record as the OSV schema describes it."""

_LOADER = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
"""Leaves everything a text, dates too, and is in C where it was built so: some thousand files are read."""


def read(folder: Path) -> dict[str, list[Advisory]]:
    """The advisories on packages of PyPI in a folder and those below it, by canonical name of the package.

    Raises:
        ValueError: There is none.
    """
    found: dict[str, list[Advisory]] = defaultdict(list)
    for file in sorted(path for path in folder.rglob("*") if path.suffix in {".json", ".yaml"}):
        text = file.read_text(encoding="utf-8")
        record = json.loads(text) if file.suffix == ".json" else yaml.load(text, _LOADER)  # noqa: S506
        for name in _packages_of(record):
            found[name].append(record)
    if not found:
        raise ValueError(f"{folder} holds no advisory on a package of PyPI")
    return dict(found)


def newest(advisories: Mapping[str, Sequence[Advisory]]) -> str:
    """The day on which the last of them was published, as `2026-11-22`: nothing later is known to them."""
    return max(str(record.get("published", ""))[:10] for records in advisories.values() for record in records)


def is_affected(advisory: Advisory, name: str, version: str) -> bool:
    """Whether a version of a package is listed in an advisory, or lies in one of its ranges of versions."""
    return any(
        version in affected.get("versions", ()) or any(_is_within(version, each) for each in affected.get("ranges", ()))
        for affected in advisory["affected"]
        if _name_of(affected) == name
    )


@contextmanager
def served(advisories: Mapping[str, Sequence[Advisory]]) -> Iterator[str]:
    """Answer OSV's queries on a port of this machine that is free; yields the address to ask at."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            query = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            name, version = canonicalize_name(query["package"]["name"]), query["version"]
            found = [record for record in advisories.get(name, ()) if is_affected(record, name, version)]
            body = json.dumps({"vulns": found} if found else {}).encode()
            self.send_response(200)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: Any) -> None:
            """Each query would be a line on the terminal."""

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/v1/query"
        finally:
            server.shutdown()


def _packages_of(record: Any) -> set[str]:
    affected = record.get("affected", ()) if isinstance(record, dict) else ()
    return {name for each in affected if (name := _name_of(each)) is not None}


def _name_of(affected: Mapping[str, Any]) -> str | None:
    package = affected.get("package", {})
    return canonicalize_name(package["name"]) if package.get("ecosystem") == "PyPI" else None


def _is_within(version: str, versions: Mapping[str, Any]) -> bool:
    """A range is a list of versions at which it begins or ends; the last one that is not above ours decides."""
    if versions["type"] != "ECOSYSTEM":
        return False
    try:
        ours = Version(version)
        is_inside = False
        for at, kind in sorted((_place(each), next(iter(each))) for each in versions["events"]):
            if at < ours or (at == ours and kind != "last_affected"):
                is_inside = kind == "introduced"
    except InvalidVersion:
        return True
    return is_inside


def _place(event: Mapping[str, Any]) -> Version:
    (version,) = event.values()
    return Version(str(version))
