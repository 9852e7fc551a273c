"""Sentences that count say one joint, and not `1 joints`; readers meet plain English; docstrings say something."""

import ast
import re
from pathlib import Path
from typing import Any

import pytest
from typer.main import get_command

from gelenk.cli.main import cli
from gelenk.errors import counted
from tests.openapi import document

NOUN = re.compile(r" ([a-z]{3,}s)\b")
NO_NOUNS = {
    *("belongs", "comes", "follows", "gives", "holds", "keeps", "leads", "lies", "meets", "reaches", "slides", "stays"),
    *("stands", "takes", "this", "was", "has", "does", "names", "needs", "goes", "jumps", "misses", "lists", "answers"),
    *("vanishes", "bytes", "seconds", "counts", "attaches"),
}
NEVER_ONE = {
    *("len(keys) keys", "count coordinates", "pieces pieces", "count samples", "waypoints waypoints"),
    *("len(links) links", "len(links) - 1 pairs", "meeting links", "placed joints"),
    *("self._lost lines", "len(self.joints) joints", "len(joints) joints", "self.representation angles"),
    *("self.unfinished jobs", "self.allowed requests"),
    *("depth[deepest] joints", "len(found) elements", "len(name) characters", "len(attributes) attributes"),
    *("len(value) characters", "len(grounds) links", "peak.ratio times", "enforced.ratio times", "count waypoints"),
    *("factor times", "bound.ratio times", "jerk.ratio times", "ratios[k, j] times"),
    *("len(names) meshes", "len(parts) - 1 folders", "len(path.trace) configurations", "voxels voxels"),
    *("len(row) numbers", "tried solutions", "rotations orientations", "hard files", "10.0 ** abs(power) times"),
    *("moving bodies", "len(affix) characters"),
}
"""Numbers that are two or more, or a limit, or zero; and those whose sentence has a form for one."""


def counts(path: Path) -> set[str]:
    """The numbers that stand before the plural of a noun."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.JoinedStr):
            continue
        for value, text in zip(node.values, node.values[1:], strict=False):
            if isinstance(value, ast.FormattedValue) and isinstance(text, ast.Constant):
                noun, number = NOUN.match(str(text.value)), ast.unparse(value.value)
                is_limit = re.fullmatch(r"(\w+\.)?_?[A-Z_]+", number)
                if noun and noun[1] not in NO_NOUNS and not is_limit:
                    found.add(f"{number} {noun[1]}")
    return found


@pytest.mark.slow
def test_what_is_counted_has_a_form_for_one() -> None:
    assert (counted(1, "entry"), counted(0, "entry"), counted(2, "joint")) == ("1 entry", "0 entries", "2 joints")
    assert {one for path in Path("app/gelenk").rglob("*.py") for one in counts(path)} - NEVER_ONE == set()


@pytest.mark.parametrize("text", ["f'{len(x)} joints'", "f'the {n} parts, and'"])
def test_it_is_seen(text: str, tmp_path: Path) -> None:
    (tmp_path / "page.py").write_text(f"say({text})")
    assert len(counts(tmp_path / "page.py")) == 1


QUAINT = re.compile(
    r"\b(told|whoever|nought|lets? go|which is to say|what there is|stands? nowhere|who is let in|comes? of it|"
    r"as it was asked for|(is|are) asked for|(number|one|row|entry) a (configuration|target|joint|sample))\b",
    re.IGNORECASE,
)
"""What a native writer would say in other words."""


def descriptions(part: Any) -> list[str]:
    """All texts for readers in a part of the OpenAPI document."""
    if isinstance(part, list):
        return [text for item in part for text in descriptions(item)]
    if not isinstance(part, dict):
        return []
    own = [part[key] for key in ("summary", "description") if isinstance(part.get(key), str)]
    return own + [text for item in part.values() for text in descriptions(item)]


def helps(command: Any) -> list[str]:
    """The help of a command, of its options and of the commands below it."""
    own = [command.help or "", command.epilog or "", *(getattr(option, "help", "") or "" for option in command.params)]
    return own + [text for below in getattr(command, "commands", {}).values() for text in helps(below)]


def test_readers_meet_plain_english() -> None:
    texts = set(descriptions(document()) + helps(get_command(cli)))
    assert [text for text in sorted(texts) if QUAINT.search(text)] == []


def parroted(tree: ast.Module) -> list[str]:
    """Functions and classes whose docstring of up to four words has no word that is not in the name."""
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            words = set(re.findall(r"\w+", (ast.get_docstring(node) or "").lower())) - {"a", "an", "the", "of", "its"}
            name = set(re.findall(r"[A-Z]?[a-z]+", node.name))
            if 0 < len(words) <= 4 and {word.rstrip("s") for word in words} <= {
                word.lower().rstrip("s") for word in name
            }:
                found.append(node.name)
    return found


@pytest.mark.slow
def test_a_docstring_says_more_than_the_name() -> None:
    paths = Path("app/gelenk").rglob("*.py")
    found = {path.name: names for path in paths if (names := parroted(ast.parse(path.read_text(encoding="utf-8"))))}
    assert found == {}
