"""Which place of the reference a name in a page leads to."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.calls.call import Call
from app.main import create_app
from app.settings import Settings
from docs.handbook import links
from docs.handbook.operations import entries

ROOT = Path(__file__).resolve().parents[2]
ROBOT = ("POST", "/v1/robots/{robot}")


@pytest.fixture(scope="module", autouse=True)
def schema() -> Iterator[None]:
    """As the service has it, without a service."""
    found = entries(create_app(Settings(data_dir=Path("unused"))).openapi())
    patch = pytest.MonkeyPatch()
    patch.setattr(links, "_operations", lambda: found)
    yield
    patch.undo()


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("GELENK_CREW_WAITING", "setting-crew-waiting"),
        ("unknown-frame", "problem-unknown-frame"),
        ("InverseResult", "object-inverse-result"),
        ("/readyz", "operation-readiness"),
        ("POST /v1/dh/compare", "operation-compare-dh"),
        ("GET /v1/robots/{name}/dh", "operation-get-robot-dh"),
        ("DELETE /v1/jobs/{id}", "operation-cancel-job"),
        ("…/velocity", "operation-velocity"),
        ("/v1/dh/compare", None),  # there is no GET
        ("…/nothing", None),
        ("joint_positions", None),
        ("./dev serve", None),
    ],
)
def test_a_name_has_its_place(text: str, place: str | None) -> None:
    assert links.place_of(text, ROBOT) == place


@pytest.mark.parametrize(
    ("method", "path", "operation"),
    [
        ("POST", "v1/robots/ur5/fk", "POST /v1/robots/{robot}/fk"),
        ("GET", "v1/robots/ur5", "GET /v1/robots/{robot}"),
        ("GET", "v1/jobs/a1/result", "GET /v1/jobs/{job}/result"),
    ],
)
def test_a_call_is_of_an_operation(method: Any, path: str, operation: str) -> None:
    call: Call[Any] = Call(method, path, lambda reply: reply)
    assert links.below_a_call([call, call], "unknown-robot").astext() == f"{operation}unknown-robot"


def test_the_page_on_writing_tells_of_every_directive() -> None:
    code = "".join(path.read_text() for path in (ROOT / "docs" / "handbook").glob("*.py"))
    names = re.findall(r'add_(?:directive|role)\("(\w+)"', code)
    assert len(names) == len(set(names)) >= 11
    told = (ROOT / "docs" / "writing.md").read_text()
    assert [name for name in names if f"{{{name}}}" not in told] == []
