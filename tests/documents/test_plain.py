"""Pages are plain Markdown, so that a git host shows all of them: CommonMark, tables, formulas between dollars."""

import re
from itertools import pairwise
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from tests.documents.blocks import PAGES

MARKDOWN = MarkdownIt("commonmark").enable("table")
NAME = r"\{[a-zA-Z][\w:-]*\}"


def directives(text: str) -> list[str]:
    """What only the handbook's build, or none, would understand."""
    found = []
    for token in MARKDOWN.parse(text):
        if token.type == "fence" and token.info.startswith("{"):
            found.append(token.info)
        if token.type == "inline":
            parts = token.children or []
            found += re.findall(r"^:{3,}.*|^\([\w-]+\)=$", token.content, re.MULTILINE)
            for before, after in pairwise(parts):
                if before.type == "text" and after.type == "code_inline":
                    found += re.findall(f"{NAME}$", before.content)
            found += [
                mark for part in parts if part.type == "text" for mark in re.findall(r"\]\{[#.].*?\}", part.content)
            ]
    return found


@pytest.mark.quick(17)
@pytest.mark.parametrize("page", PAGES, ids=str)
def test_a_page_has_no_directives(page: Path) -> None:
    assert directives(page.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    "text",
    [
        "```{run}\n1\n```",
        ":::{answer} 5\n:::",
        "It is {is}`2 = 1 + 1`.",
        "(status-422)=\n## 422",
        "[`x`]{#field-x} text",
    ],
)
def test_what_is_a_directive(text: str) -> None:
    assert directives(text)
