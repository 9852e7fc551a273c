"""The list of computations: its links lead somewhere, and its operations derive and draw where it says so."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.openapi import document

COURSE = Path(__file__).resolve().parents[2] / "docs" / "course"
ROWS = [
    [cell.strip() for cell in line.split("|")[1:-1]]
    for line in (COURSE / "contents.md").read_text(encoding="utf-8").splitlines()
    if re.match(r"\| \d", line)
]
SCHEMA = document()
OPERATIONS = {
    content["operationId"].replace("_", "-"): content
    for operations in SCHEMA["paths"].values()
    for content in operations.values()
}


def operations(row: list[str]) -> Iterator[dict[str, Any]]:
    for name in re.findall(r"#operation-([a-z-]+)\)", row[2]):
        yield OPERATIONS[name]


def media_types(operation: dict[str, Any]) -> dict[str, Any]:
    content: dict[str, Any] = operation["responses"]["200"]["content"]
    return content


def has_steps(operation: dict[str, Any]) -> bool:
    """Whether the answer, or an entry of its results, has a worked solution."""
    name = media_types(operation)["application/json"]["schema"]["$ref"].rpartition("/")[2]
    schemas = SCHEMA["components"]["schemas"]
    inner = re.findall(r"schemas/(\w+)", str(schemas[name]["properties"].get("results", "")))
    return any("steps" in schemas[each]["properties"] for each in (name, *inner))


def test_there_are_51() -> None:
    assert [row[0] for row in ROWS] == [str(number) for number in range(1, 52)]


def test_every_link_leads_somewhere() -> None:
    for row in ROWS:
        links = re.findall(r"\]\(([^)#]+)#?([^)]*)\)", " ".join(row))
        assert len(links) >= 2, row
        for page, anchor in links:
            text = (COURSE / page).read_text(encoding="utf-8")
            assert not anchor or f'<a id="{anchor}">' in text, row


def test_what_is_said_to_derive_and_to_draw_does() -> None:
    for row in ROWS:
        if row[3].startswith("yes"):
            assert all(map(has_steps, operations(row))), row
        if row[4] == "yes":
            assert any("image/png" in media_types(each) for each in operations(row)), row
