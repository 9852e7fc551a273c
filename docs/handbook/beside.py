"""What stands beside the calls of a page: the same with curl, and the studio's calculator with the same numbers.

Both are derived from what the page's session has sent. A page is written once, in Python; its tabs and these links are
only in the built handbook. They need no script.
"""

import json
import re
import shlex
from collections.abc import Sequence
from html import escape
from typing import Any
from urllib.parse import quote

from httpx2 import QueryParams

from docs.handbook.operations import compact
from gelenk.client.call import JSON, Call

_SERVICE = "http://127.0.0.1:8000/"
_MOST_CALLS = 3
"""Of a loop only the first are shown."""
_MOST_LETTERS = 1200
"""A longer body is not for people."""
_LINE = 96
CALCULATORS = frozenset(
    {"mobility", "dc-motor", "encoder", "orientation", "triangle", "time-law", "spline", "fly-over"}
)
"""Operations of the course that the studio has a page for."""
_COURSE = "v1/course/"
_USUAL = {JSON, "*/*"}
_PYTHON = re.compile(r"^```python\n.*?^```\n", re.MULTILINE | re.DOTALL)
_TAB = (
    '<input type="radio" name="{name}" id="{name}-{value}" value="{value}"{state}>'
    '<label for="{name}-{value}">{label}</label>'
)
_STUDIO = '<p class="studio"><a href="{href}">Change the numbers in the studio</a></p>'


def curl(call: Call[Any]) -> str | None:
    """A call as a command for a shell; None if it sends a file, an array or more than a reader wants to see."""
    if call.files or (call.body and call.media_type != JSON) or len(call.body) > _MOST_LETTERS:
        return None
    method = "" if call.method == ("POST" if call.body else "GET") else f"-X {call.method} "
    query = f"?{QueryParams(call.query)}" if call.query else ""
    parts = [f"curl -s {method}{shlex.quote(_SERVICE + call.path + query)}"]
    is_usual = call.accept in _USUAL
    headers = [f"{name}: {value}" for name, value in call.headers.items() if name != "Accept" or not is_usual]
    parts += [f"-H {shlex.quote(header)}" for header in headers]
    if not is_usual:
        parts.append(f"-o answer.{call.accept.rpartition('/')[2].removeprefix('x-').removesuffix('+xml')}")
    command = " ".join(parts)
    return f"{command} \\\n    -d {shlex.quote(compact(json.loads(call.body), 4, _LINE))}" if call.body else command


def calculator(call: Call[Any]) -> str | None:
    """The link of the studio's calculator with a call's numbers, from where the service is; None if there is none."""
    operation = call.path.removeprefix(_COURSE)
    if not call.path.startswith(_COURSE) or operation not in CALCULATORS or len(call.body) > _MOST_LETTERS:
        return None
    inputs = quote(json.dumps(json.loads(call.body), separators=(",", ":"), ensure_ascii=False), safe=",")
    return f"#robot=planar_2r&panel=course&course.task={operation}&course.inputs={inputs}"


def tabbed(part: str, calls: Sequence[Call[Any]], name: str, service: str = "../") -> str:
    """A part of a page, its Python in one tab and the calls that it has made in another.

    Args:
        part: Markdown with one block of Python.
        calls: What the block has sent.
        name: Of the tabs, another one for each part of a page.
        service: The way from the page to the service's address.
    """
    commands = list(dict.fromkeys(filter(None, map(curl, calls))))
    if not commands:
        return part
    more = ["# and so on"] if len(commands) > _MOST_CALLS else []
    shell = "\n\n".join([*commands[:_MOST_CALLS], *more])
    python = _TAB.format(name=name, value="python", label="Python", state=" checked")
    tabs = python + _TAB.format(name=name, value="curl", label="curl", state="")
    shown = _PYTHON.sub(
        lambda block: f'<div class="tabs">{tabs}\n\n{block[0]}\n```sh\n{shell}\n```\n\n</div>\n', part, count=1
    )
    link = next(filter(None, map(calculator, calls)), None)
    return f"{shown}\n{_STUDIO.format(href=escape(service + link))}\n" if link else shown
