"""What `deploy` asks of the service's metrics: the panels of the dashboard, and the alerts."""

import json
import os
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

PROMETHEUS = Path("deploy/prometheus")
DASHBOARD = Path("deploy/grafana/dashboards/gelenk.json")
_VARIABLES = {"$__rate_interval": "1m", "$operation": ".*", "$robot": ".*"}
"""Of Grafana, with a value each."""


def read_yaml(path: Path) -> Any:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def program(name: str) -> str | None:
    """Where a program of Prometheus is: beside the service, or where Debian has it."""
    return shutil.which(name, path=f"{os.environ.get('PATH', os.defpath)}:/usr/bin")


def panels() -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(DASHBOARD.read_text(encoding="utf-8"))["panels"]
    return found


def dashboard_queries() -> Iterator[tuple[str, str]]:
    """Title and query, as Prometheus gets it."""
    for panel in panels():
        for target in panel["targets"]:
            query: str = target["expr"]
            for variable, value in _VARIABLES.items():
                query = query.replace(variable, value)
            yield panel["title"], query


def alerts() -> Iterator[tuple[str, str]]:
    """Name and query."""
    for group in read_yaml(PROMETHEUS / "alerts.yml")["groups"]:
        for rule in group["rules"]:
            yield rule["alert"], rule["expr"]


def selectors(query: str) -> Iterator[tuple[str, set[str]]]:
    """The metrics of ours that a query names, and the labels that it picks or groups them by."""
    grouped = {label for group in re.findall(r"by \(([^)]*)\)", query) for label in group.replace(" ", "").split(",")}
    for name, matchers in re.findall(r"(gelenk_\w+)(\{[^}]*\})?", query):
        yield name, set(re.findall(r"(\w+)=~?\"", matchers)) | grouped
