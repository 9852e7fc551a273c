"""The reference has every operation, object, field, kind of problem and setting, found here in another way."""

import ast
import dataclasses
import re
from collections import Counter
from collections.abc import Iterator
from http import HTTPStatus
from pathlib import Path
from types import SimpleNamespace

import pytest

from docs.handbook import committed
from docs.handbook.operations import compact
from docs.handbook.problem_kinds import OF_HTTP, all_kinds, problems
from docs.handbook.reference import GROUPS, Reference
from docs.handbook.settings_list import bounds, settings
from gelenk.errors import kinds
from gelenk.http.messages.problems import status_of
from gelenk.settings import Settings
from tests.openapi import document

ROOT = Path(__file__).resolve().parent.parent.parent
SCHEMA = document()
OPERATIONS = [content for operations in SCHEMA["paths"].values() for content in operations.values()]


def dashed(name: str) -> str:
    return (
        re.sub("([a-z0-9])([A-Z])", r"\1-\2", name.replace("app__schemas__", ""))
        .replace("__", "-")
        .replace("_", "-")
        .lower()
    )


def places() -> Iterator[str]:
    """Where something must stand in the reference."""
    for content in OPERATIONS:
        operation = dashed(content["operationId"])
        yield f"operation-{operation}"
        yield from (f"field-{operation}-{dashed(entry['name'])}" for entry in content.get("parameters", []))
        for body in content.get("requestBody", {}).get("content", {}).values():
            yield from (f"field-{operation}-form-{dashed(name)}" for name in body["schema"].get("properties", {}))
        yield from (f"status-{status}" for status in content["responses"] if status >= "400")
    for name, schema in SCHEMA["components"]["schemas"].items():
        yield f"object-{dashed(name)}"
        yield from (f"field-{dashed(name)}-{dashed(field)}" for field in schema.get("properties", ()))
    for kind, error in kinds().items():
        if error.template:
            yield f"problem-{kind}"
    yield from (f"problem-{kind}" for _, kind in kinds_of_http())
    yield from (f"setting-{dashed(field.name)}" for field in dataclasses.fields(Settings))


def kinds_of_http() -> set[tuple[HTTPStatus, str]]:
    """What the code answers with beside the errors of the core: every kind that it names, with the status before it."""
    found = {
        (HTTPStatus.NOT_FOUND, "not-found"),
        (HTTPStatus.METHOD_NOT_ALLOWED, "method-not-allowed"),
    }  # by the router
    for path in [*ROOT.glob("app/gelenk/http/**/*.py"), ROOT / "app/gelenk/connections.py"]:
        functions = (
            node
            for node in ast.walk(ast.parse(path.read_text()))
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        )
        found |= {named for function in functions for named in _named(function)}
    return found


def _named(tree: ast.FunctionDef | ast.AsyncFunctionDef) -> Iterator[tuple[HTTPStatus, str]]:
    statuses: dict[str, ast.expr] = {}
    for node in ast.walk(tree):
        match node:
            case ast.Assign([ast.Name(name)], value) | ast.Assign(
                [ast.Tuple([ast.Name(name), *_])], ast.Tuple([value, *_])
            ):
                statuses[name] = value
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and ast.unparse(call.func) in {"problem", "self._refuse", "_answer"}:
            for status, kind in zip(call.args, call.args[1:], strict=False):
                if isinstance(kind, ast.Constant) and re.fullmatch(r"[a-z]+(-[a-z]+)+", str(kind.value)):
                    told = statuses[status.id] if isinstance(status, ast.Name) else status
                    yield HTTPStatus[ast.unparse(told).removeprefix("HTTPStatus.")], str(kind.value)


def test_nothing_is_missing_and_nothing_stands_twice() -> None:
    found = Counter(
        name
        for page in (ROOT / "docs" / "reference").glob("*.md")
        for name in re.findall(r'<a id="([^"]+)">', page.read_text(encoding="utf-8"))
    )
    assert [place for place in sorted(set(places())) if found[place] != 1] == []


def test_the_committed_reference_is_current(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a service; `./dev handbook` compares the answers of calls too."""
    idle = SimpleNamespace(run=lambda *_: "", sent=[], robots=lambda: SimpleNamespace(robots=[]))
    for name, stand_in in (("schema", document), ("Session", lambda _: idle), ("service", lambda: idle)):
        monkeypatch.setattr(committed, name, stand_in)
    committed.reference.cache_clear()
    monkeypatch.chdir(ROOT)
    found = list(committed.renew(sorted(Path("docs/reference").glob("*.md")), write=False))
    # These have a call, and the robots of a service.
    behind = ("docs/reference/catalogue.md", "docs/reference/errors.md")
    assert found == [f"{page} is not current: ./dev handbook --write" for page in behind]
    assert problems() in Path("docs/reference/errors.md").read_text(encoding="utf-8")


def test_every_field_says_what_it_is() -> None:
    reference = Reference(SCHEMA)
    text = "\n".join([*map(reference.group, GROUPS), reference.object("Problem"), reference.object("FieldError")])
    entries = re.findall(r'^- <a id="(field-[^"]+)"></a>\*\*`([^`]+)`\*\* (.*)\\\n  (.*)$', text, re.MULTILINE)
    assert len(entries) == text.count('<a id="field-') > 1000
    assert [place for place, _, kind, meaning in entries if not kind or re.fullmatch(r"(\[[^]]*\])?\.?", meaning)] == []


def test_every_kind_has_its_status() -> None:
    found = {kind.name: kind for kind in all_kinds()}
    assert len(found) == len(all_kinds())
    for name, error in kinds().items():
        if name in found and error.template:
            assert found[name].status == status_of(error)
            assert found[name].exception == error.__name__
    own = {(kind.status, kind.name) for kind in OF_HTTP}
    assert own == kinds_of_http() - {(HTTPStatus.SERVICE_UNAVAILABLE, "service-busy")}


def test_kinds_say_which_facts_they_carry() -> None:
    facts = {kind.name: kind.facts for kind in all_kinds()}
    assert facts["wrong-joint-count"] == {
        "given": "whole number",
        "expected": "list of texts",
        "index": "whole number or `null`",
        "field": "text",
    }
    assert facts["unknown-robot"] == {"robot": "text", "close": "list of texts"}
    assert facts["service-stopping"] == {}


def test_settings_say_their_variable_and_default() -> None:
    entries = {entry.partition("\n")[0]: entry for entry in settings().split("\n\n")}
    assert '- <a id="setting-crew-waiting"></a>**`GELENK_CREW_WAITING`** default: `160`\\' in entries
    assert any(entry.endswith("**`GELENK_MAX_BODY_BYTES`** default: `67108864` (64 MiB)\\") for entry in entries)
    assert any(entry.endswith("**`GELENK_API_KEYS`** default: none\\") for entry in entries)
    assert all("GELENK" not in entry.partition("\n")[2] for entry in entries.values())
    assert all(entry.endswith(".") for entry in entries.values())


def test_bounds_are_those_of_the_code() -> None:
    assert "| links | 512 |" in bounds()
    assert "| zip, unpacked | 256 MiB |" in bounds()
    assert "| targets of a call by a method of the course, or with `trace` | 1,000 |" in bounds()


def test_examples_are_short_where_they_can_be() -> None:
    assert compact({"a": [1, 2], "b": "ü"}) == '{"a": [1, 2], "b": "ü"}'
    rows = [[float(i)] * 9 for i in range(2)]
    assert compact({"rows": rows}) == (
        '{\n  "rows": [\n    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],\n'
        "    [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]\n  ]\n}"
    )
