"""The reference has every operation, and every kind of problem."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.main import create_app
from app.model.errors import kinds
from app.settings import Settings
from handbook.reference import object_sections, operation_sections, problem_table

PAGES = {path.stem: path.read_text(encoding="utf-8") for path in Path("docs/reference").glob("*.md")}


@pytest.fixture(scope="module")
def schema(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    yield create_app(Settings(data_dir=tmp_path_factory.mktemp("data"))).openapi()


def test_every_operation_is_in_one_page(schema: Any) -> None:
    tags = [tag for page in PAGES.values() for tag in re.findall(r"```\{operations\} (.+)", page)]
    shown = [section for tag in tags for section in operation_sections(schema, tag)]
    calls = [f"`{method.upper()} {path}`" for path, methods in schema["paths"].items() for method in methods]
    assert sorted(re.findall(r"^`([A-Z]+ /.*)`$", "\n".join(shown), re.MULTILINE)) == sorted(
        call.strip("`") for call in calls
    )


def test_a_request_is_told_by_its_fields(schema: Any) -> None:
    (section,) = [each for each in operation_sections(schema, "Kinematics") if each.startswith("## Inverse kinematics")]
    assert "| `targets` | list (at most 1,000,000) of [Pose](#object-pose); required |" in section
    assert "| `position_tolerance` | number ≥ 1e-12, ≤ 1; `1e-06` if left out | \\[m\\]. |" in section
    assert '| `solutions` | `"one"` · `"all"`; `"one"` if left out |' in section
    assert "**Answer, 200** `application/json`" in section
    assert "| `closed_form` | text or `null`; required |" in section


def test_links_between_objects_lead_to_one_each(schema: Any) -> None:
    text = "\n\n".join(object_sections(schema))
    places = re.findall(r"^\((object-[a-z0-9-_]+)\)=$", text, re.MULTILINE)
    assert len(places) == len(set(places)) == len(schema["components"]["schemas"])
    assert set(re.findall(r"\]\(#(object-[^)]+)\)", text)) <= set(places)
    headings = re.findall(r"^## (.+)$", text, re.MULTILINE)
    assert len(headings) == len(set(headings))


def test_every_kind_of_problem_is_told() -> None:
    table = "\n".join(problem_table(kinds()))
    assert re.findall(r"^\| `([a-z-]+)` \| \d{3} \| \S", table, re.MULTILINE) == sorted(kinds())
    # A string of small words joined by hyphens that follows a status is the kind of a problem.
    sources = "\n".join(path.read_text(encoding="utf-8") for path in Path("app/api").rglob("*.py"))
    named = set(re.findall(r'(?:HTTPStatus\.[A-Z_]+|status), "([a-z]+(?:-[a-z]+)+)"', sources))
    assert {"malformed-json", "key-needed", "internal-error"} <= named
    assert [kind for kind in sorted(named) if f"`{kind}`" not in PAGES["errors"]] == []
