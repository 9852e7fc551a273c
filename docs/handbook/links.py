"""Names of the reference become links where a page first has them in code letters.

Settings (`GELENK_DATA_DIR`), kinds of problems (`unknown-frame`), objects (`InverseResult`), and operations by their
path: `POST /v1/dh/compare`, `/readyz`, or `…/velocity` behind a `POST /v1/robots/{robot}/…`. A page of the reference
is not linked to itself. Where pages are not built they stay what they are, code letters.
"""

import re
from collections.abc import Iterable
from functools import cache
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.nodes import make_refnode

from app.calls.call import Call
from docs.handbook.operations import Entry, entries
from docs.handbook.schema_words import anchor
from docs.handbook.session import service

_SETTING = re.compile(r"GELENK_([A-Z_]+)")
_KIND = re.compile(r"[a-z]+(?:-[a-z]+)+")
_OBJECT = re.compile(r"(?:[A-Z][a-z]+)+")
_PATH = re.compile(r"(?:(GET|POST|PUT|DELETE) )?(/[\w{}/-]+)")
_PREFIX = re.compile(r"(GET|POST|PUT|DELETE) (/[\w{}/-]+)/…")
_REST = re.compile(r"…(/[\w{}/-]+)")
_PARAMETER = re.compile(r"\{\w+\}")
_BELOW_A_CALL = "operations"


def setup(app: Sphinx) -> dict[str, Any]:
    """Add it to Sphinx."""
    app.add_post_transform(NamesBecomeLinks)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


class NamesBecomeLinks(SphinxPostTransform):
    """The first time that a page names something, the name leads to the reference, where there is one."""

    default_priority = 5

    def run(self, **_: Any) -> None:
        """Look through the page."""
        page = self.env.docname
        places, met, prefix = self.env.domaindata["std"]["anonlabels"], set[str](), ("", "")
        for literal in [*self.document.findall(nodes.literal)]:
            if opening := _PREFIX.fullmatch(literal.astext()):
                prefix = (opening[1], opening[2])
            place = place_of(literal.astext(), prefix)
            if place is None or place not in places or places[place][0] == page or _is_linked(literal):
                continue
            if place not in met:
                met.add(place)
                target, name = places[place]
                literal.replace_self(make_refnode(self.app.builder, page, target, name, literal.deepcopy()))
            elif _BELOW_A_CALL in literal.parent["classes"]:
                literal.parent.remove(literal)
        for line in [*self.document.findall(nodes.paragraph)]:
            if _BELOW_A_CALL in line["classes"] and not line.children:
                line.parent.remove(line)


def below_a_call(calls: Iterable[Call[Any]], refusal: str | None = None) -> nodes.paragraph:
    """What a page links to below a piece: the operations it has called, and the kind of problem that ended it."""
    names = [f"{entry.method} {entry.path}" for call in calls for entry in _operations() if _is(entry, call)]
    texts = dict.fromkeys([*names, *([refusal] if refusal else [])])
    return nodes.paragraph("", "", *(nodes.literal(text, text) for text in texts), classes=[_BELOW_A_CALL])


def place_of(text: str, prefix: tuple[str, str] = ("", "")) -> str | None:
    """Where the reference would have what a text in code letters names; None where it can be no such name.

    Args:
        text: The text.
        prefix: Method and beginning of the path that `…` stands for.
    """
    if setting := _SETTING.fullmatch(text):
        return anchor("setting", setting[1])
    if path := _PATH.fullmatch(text):
        return _operation(path[1] or "GET", path[2])
    if rest := _REST.fullmatch(text):
        return _operation(prefix[0], prefix[1] + rest[1])
    if _KIND.fullmatch(text):
        return anchor("problem", text)
    return anchor("object", text) if _OBJECT.fullmatch(text) else None


def _operation(method: str, path: str) -> str | None:
    """That of a method and a path, by whatever names its parameters go."""
    wanted = (method, _PARAMETER.sub("{}", path))
    found = (entry.id for entry in _operations() if (entry.method, _PARAMETER.sub("{}", entry.path)) == wanted)
    return next((anchor("operation", name) for name in found), None)


def _is(entry: Entry, call: Call[Any]) -> bool:
    return entry.method == call.method and bool(re.fullmatch(_PARAMETER.sub("[^/]+", entry.path), f"/{call.path}"))


def _is_linked(node: nodes.Node | None) -> bool:
    """Whether a node is in a link or a heading."""
    while node is not None:
        if isinstance(node, nodes.reference | nodes.title | addnodes.pending_xref):
            return True
        node = node.parent
    return False


@cache
def _operations() -> list[Entry]:
    return entries(service().schema())
