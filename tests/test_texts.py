"""Every message for people stands in every language, and the compiled catalogues are those of the sources."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import gelenk.language
import texts
from gelenk.language import language, marked, translated
from gelenk.operations.outcome import Outcome


def test_the_catalogues_are_complete(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["texts.py", "--check"])
    with pytest.raises(SystemExit) as ended:
        texts.main()
    assert ended.value.code is None


SOURCE = """
_("One link." if n == 1 else "{n} links.").format(n=n)
_NAMES = {"a": marked("the " "ground")}
_(_NAMES[key])
"""


def test_messages_are_found_where_they_are_marked(tmp_path: Path) -> None:
    (tmp_path / "page.py").write_text(SOURCE)
    found, faults = texts.extracted(tmp_path)
    assert (found, faults) == ({"One link.": "page.py:2", "{n} links.": "page.py:2", "the ground": "page.py:3"}, [])


@pytest.mark.parametrize("text", ['_(f"{n} links")', '_("Link " + name)', '_("Link %s" % name)'])
def test_a_message_that_is_no_constant_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "page.py").write_text(text)
    assert texts.extracted(tmp_path)[1] == [
        "page.py:1: a message is one constant string, filled in by .format() after translation"
    ]


PO = """
msgid ""
msgstr ""
"Content-Type: text/plain; charset=UTF-8\\n"

msgid "{n} links."
msgstr "{m} Glieder."

msgid "Gone."
msgstr "Weg."

#, fuzzy
msgid "Ground."
msgstr "Boden."
"""


def test_what_is_missing_dead_or_different_is_named(tmp_path: Path) -> None:
    (tmp_path / "one.po").write_text(PO)
    (tmp_path / "two.po").write_text(PO)
    entries, twice = texts.fragments(tmp_path)
    assert [fault.partition(":")[0] for fault in twice] == ["two.po", "two.po"]
    assert texts.differences({"{n} links.": "a.py:1", "Ground.": "a.py:2"}, entries, "de") == [
        "a.py:2: not in de: 'Ground.'",
        "de: no source has it: 'Gone.'",
        "de: other placeholders: '{n} links.'",
    ]


def test_what_is_compiled_is_read_back(tmp_path: Path) -> None:
    file = tmp_path / "de" / "LC_MESSAGES" / "gelenk.mo"
    file.parent.parent.mkdir()
    assert texts.compiled_entries(file) == {}
    texts.write(file, {"{n} links.": "{n} Glieder."})
    assert texts.compiled_entries(file) == {"{n} links.": "{n} Glieder."}


@pytest.fixture
def catalogue(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """German of one word."""
    (tmp_path / "de").mkdir()
    texts.write(tmp_path / "de" / "LC_MESSAGES" / "gelenk.mo", {"Links": "Glieder"})
    monkeypatch.setattr(gelenk.language, "texts", lambda: tmp_path)
    gelenk.language._catalogue.cache_clear()
    yield
    gelenk.language._catalogue.cache_clear()


@pytest.mark.usefixtures("catalogue")
def test_an_outcome_speaks_though_it_is_made_late() -> None:
    outcome = Outcome(
        lambda: translated(marked("Links")), picture=lambda kind: f"{translated('Links')} {kind}".encode()
    )
    german = outcome.spoken("de")
    assert german.picture is not None
    assert (outcome.content(), german.content(), german.picture("svg")) == ("Links", "Glieder", b"Glieder svg")
    with language("de"):
        assert translated("Links") == "Glieder"
    assert translated("Links") == "Links"


def unmarked(path: Path) -> list[str]:
    """Words in titles and texts of steps that stand in the source, and are not the translation of a message."""
    calls = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.Call)]
    steps = [call for call in calls if isinstance(call.func, ast.Name) and call.func.id == "step"]
    given = [one for call in steps for one in call.args[:2] if not isinstance(one, ast.Call)]
    words = [str(part.value) for one in given for part in ast.walk(one) if isinstance(part, ast.Constant)]
    return [text for text in words if re.search(r"[a-z]{3}", text)]


@pytest.mark.slow
def test_the_words_of_every_step_are_translated(tmp_path: Path) -> None:
    (tmp_path / "page.py").write_text('step("Links", _("All of them."), "n = 4")')
    assert unmarked(tmp_path / "page.py") == ["Links"]
    assert {path.name: found for path in texts.PACKAGE.rglob("*.py") if (found := unmarked(path))} == {}
