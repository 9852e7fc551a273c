"""The fenced blocks of a page, and the commands in them."""

import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

README = Path("README.md")
PAGES = (README, Path("CONTRIBUTING.md"), Path("CHANGELOG.md"), *sorted(Path("docs").rglob("*.md")))
_BLOCK = re.compile(r"^```(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Command(NamedTuple):
    """A command for a shell, and what the page says that it prints."""

    line: str
    printed: str


def blocks(page: Path, language: str) -> list[str]:
    """The blocks of a language."""
    found = _BLOCK.findall(page.read_text(encoding="utf-8"))
    return [text for name, text in found if name == language]


def with_blocks(language: str) -> list[Path]:
    """The pages that have some."""
    return [page for page in PAGES if blocks(page, language)]


def console(page: Path) -> Iterator[Command]:
    """What follows `$`, with the lines that belong to it, and what it prints."""
    for block in blocks(page, "console"):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            lines = part.splitlines()
            length = next(n for n in range(1, len(lines) + 1) if is_whole("\n".join(lines[:n])))
            yield Command("\n".join(lines[:length]), "\n".join(lines[length:]))


def shell(page: Path) -> Iterator[str]:
    """The commands of blocks that show no output."""
    for block in blocks(page, "sh"):
        yield from (line for line in block.replace("\\\n", " ").splitlines() if line.strip())


def is_whole(text: str) -> bool:
    """Whether a shell would not ask for a further line."""
    try:
        shlex.split(text)
    except ValueError:
        return False
    return not text.endswith("\\")
