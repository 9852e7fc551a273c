"""The parts of a page that are made from the code, and whether those that are committed are current.

A page is plain Markdown. Comments say what is to be run, compared or generated; `docs/writing.md` tells their use.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path, PurePosixPath
from posixpath import relpath
from typing import Any

from matplotlib.figure import Figure

from docs.handbook.beside import tabbed
from docs.handbook.figures import compact, svg
from docs.handbook.problem_kinds import problems
from docs.handbook.reference import Reference
from docs.handbook.session import Session, Unexpected, schema, service
from docs.handbook.settings_list import bounds, settings
from docs.handbook.written import DIGITS, disagreement, same
from gelenk.client.call import Call

_PART = re.compile(
    r"(?P<shown>^`{4,})\w+\n.*?^(?P=shown)$"
    r"|^<!-- run(?P<options>[^\n]*) -->\n```python\n(?P<code>.*?)^```\n(?P<answer>\n```text\n.*?^```\n)?"
    r"|^<!-- picture (?P<picture>\S+) -->\n```python\n(?P<drawing>.*?)^```\n"
    r"|^<!-- (?P<kind>formula|operations|objects|problems|settings|bounds)(?P<of>[^\n]*) -->\n.*?^<!-- end -->$"
    r"|<!-- (?P<stated>[^=\n]+) = (?P<expression>[^\n]+?) -->",
    re.MULTILINE | re.DOTALL,
)
SHOWN: dict[Path, str] = {}
"""The pages that this process has renewed, as they are built."""
_ANCHOR = re.compile(r'<a id="([^"]+)"></a>')
_HERE = re.compile(r"\]\(#([^)]+)\)")
_OPTION = re.compile(r"(\w+)=(\S+)")


@dataclass
class Page:
    """A page as it should be.

    Attributes:
        text: Markdown.
        pictures: By their path from the page.
        calls: What each of its pieces has sent.
        faults: What is wrong with it, in sentences.
    """

    text: str = ""
    calls: list[list[Call[Any]]] = field(default_factory=list)
    pictures: dict[str, str] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)


def made(text: str) -> Page:
    """A page with all its parts made anew, in one session, from top to bottom."""
    page, session = Page(), Session(service())

    def part(found: re.Match[str]) -> str:
        before = len(service().sent)
        try:
            return _part(found, text[: found.start()], session, page)
        except Unexpected as error:
            page.faults.append(f"line {text.count(chr(10), 0, found.start()) + 1}: {error}")
            return found[0]
        finally:
            if found["code"] or found["picture"]:
                page.calls.append(service().sent[before:])

    page.text = _PART.sub(part, text)
    if left := [robot.name for robot in service().robots().robots if robot.source == "uploaded"]:
        page.faults.append(f"it leaves robots behind: {', '.join(left)}")
    return page


def _part(found: re.Match[str], before: str, session: Session, page: Page) -> str:
    """A part as it should be.

    Raises:
        Unexpected: A call is answered in another way, or a value is another one.
    """
    if found["code"] is not None:
        options = dict(_OPTION.findall(found["options"]))
        output = session.run(found["code"], int(options.get("digits", DIGITS)), options.get("refused"))
        head = found[0].removesuffix(found["answer"] or "")
        return head + (f"\n```text\n{output}\n```\n" if output else "")
    if found["picture"]:
        page.pictures[found["picture"]] = _drawn(session.last(found["drawing"]))
    elif found["expression"]:
        section = before[max(0, before.rfind("\n##")) :]
        if found["stated"] not in _PART.sub("", section):
            raise Unexpected(f"{found['stated']} does not stand in the section above")
        if difference := disagreement(found["stated"], session.value(found["expression"])):
            raise Unexpected(difference)
    elif found["kind"]:
        name, of = found["kind"], found["of"].strip(" :")
        content = _formulas(session.value(of)) if name == "formula" else _GENERATED[name](of)
        return f"<!-- {name}{found['of']} -->\n\n{content}\n\n<!-- end -->"
    return found[0]


def _drawn(picture: object) -> str:
    if isinstance(picture, Figure):
        picture = svg(picture)
    if not isinstance(picture, bytes) or not picture.startswith(b"<?xml"):
        raise Unexpected("it gives no picture: a figure, or SVG as bytes")
    return compact(picture.decode())


def _formulas(latex: str | list[str]) -> str:
    return "\n\n".join(f"$$\n{line}\n$$" for line in ([latex] if isinstance(latex, str) else latex))


@cache
def reference() -> Reference:
    """That of the service's schema."""
    return Reference(schema())


_GENERATED: Mapping[str, Callable[[str], str]] = {
    "operations": lambda group: reference().group(group),
    "objects": lambda names: "\n\n".join(reference().object(name, level=2) for name in names.split()),
    "problems": lambda _: problems(),
    "settings": lambda _: settings(),
    "bounds": lambda _: bounds(),
}


def shown(page: Page, path: Path) -> str:
    """A page as it is built: each of its calls also with curl, and those of the course with the studio's calculator."""
    pieces = enumerate(page.calls)

    def beside(part: re.Match[str]) -> str:
        if not (part["code"] or part["picture"]):
            return part[0]
        number, calls = next(pieces)
        return tabbed(part[0], calls, f"call-{number}", _to_service(path))

    return _PART.sub(beside, page.text)


def _to_service(path: Path) -> str:
    """The way from a built page to the service, which has the handbook in a folder of its own."""
    pages, page = Path(__file__).resolve().parents[1], path.resolve()
    return "../" * (len(page.relative_to(pages).parts) if page.is_relative_to(pages) else 1)


def linked(pages: dict[Path, Page]) -> None:
    """Let links to places of other pages lead there."""
    homes = {place: path for path, page in pages.items() for place in _ANCHOR.findall(page.text)}

    for path, page in pages.items():

        def link(found: re.Match[str], here: Path = path) -> str:
            home = homes.get(found[1], here)
            to = "" if home == here else relpath(PurePosixPath(home), PurePosixPath(here.parent))
            return f"]({to}#{found[1]})"

        page.text = _PART.sub(lambda part: _HERE.sub(link, part[0]) if part["kind"] else part[0], page.text)


def renew(paths: list[Path], write: bool) -> Iterator[str]:
    """What is wrong with pages, in sentences; what is only out of date can be written.

    Args:
        paths: Of the pages.
        write: Whether to write what is out of date.
    """
    pages = {path: made(path.read_text(encoding="utf-8")) for path in paths}
    linked(pages)
    for path, page in pages.items():
        yield from (f"{path}: {fault}" for fault in page.faults)
        SHOWN[path.resolve()] = shown(page, path)
        files = {path: page.text, **{path.parent / name: text for name, text in page.pictures.items()}}
        for file, text in files.items():
            apart = 1e-9 if file == path else 0.2  # of a picture, a fifth of a point
            if file.exists() and same(file.read_text(encoding="utf-8"), text, apart):
                continue
            if write:
                file.parent.mkdir(exist_ok=True)
                file.write_text(text, encoding="utf-8")
            else:
                yield f"{file} is not current: ./dev handbook --write"
