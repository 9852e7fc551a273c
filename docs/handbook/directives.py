"""What pages are written with beside plain Markdown; `docs/writing.md` tells how.

One service answers all pages of a build; each page is a session of its own.
"""

import re
from html import escape
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from matplotlib.figure import Figure
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective, SphinxRole

from app.calls.call import Call
from docs.handbook.figures import svg
from docs.handbook.links import below_a_call
from docs.handbook.session import Session, Unexpected, curl, end_service, service
from docs.handbook.written import DIGITS, disagreement

_PICTURES = "_pictures"
_SVG, _PNG = b"<?xml", b"\x89PNG"
_IS = re.compile(r"\{is\}`([^`]+)`")
_NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?!\w)")

_logger = logging.getLogger(__name__)
_sessions: dict[str, Session] = {}


def setup(app: Sphinx) -> dict[str, Any]:
    """Add them to Sphinx."""
    app.add_directive("run", Run)
    app.add_directive("formula", Formula)
    app.add_directive("picture", Picture)
    app.add_directive("exercise", Exercise)
    app.add_directive("answer", Answer)
    app.add_role("is", Is())
    app.connect("source-read", _begin)
    app.connect("doctree-read", _look_for_robots)
    app.connect("build-finished", _end)
    return {"version": "1", "parallel_read_safe": False, "parallel_write_safe": True}


def _begin(_: Sphinx, page: str, __: list[str]) -> None:
    _sessions.pop(page, None)


def _look_for_robots(app: Sphinx, _: nodes.document) -> None:
    """A page that leaves a robot behind would change what other pages see."""
    page = app.env.docname
    if page in _sessions:
        robots = service().robots().robots
        if left := [robot.name for robot in robots if robot.source == "uploaded"]:
            _logger.warning("it leaves robots behind: %s", ", ".join(left), location=page)


def _end(_: Sphinx, __: Exception | None) -> None:
    _sessions.clear()
    end_service()


def session_of(page: str) -> Session:
    """That of a page, begun where it is first needed."""
    if page not in _sessions:
        _sessions[page] = Session(service())
    return _sessions[page]


class Run(SphinxDirective):
    """Python that is shown, run, and followed by what it gives.

    Options:
        digits: Significant ones of the numbers shown.
        refused: The kind of problem that the service answers with; without it a problem breaks the build.
    """

    has_content = True
    option_spec: ClassVar = {"digits": directives.positive_int, "refused": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        """The piece and its answer."""
        code = "\n".join(self.content)
        try:
            ran = session_of(self.env.docname).run(
                code, self.options.get("digits", DIGITS), self.options.get("refused")
            )
        except Unexpected as error:
            raise self.error(str(error)) from error
        shown: list[nodes.Node] = [nodes.literal_block(code, code, language="python", classes=["call"])]
        if ran.output:
            shown.append(nodes.literal_block(ran.output, ran.output, language="text", classes=["given"]))
        return [*shown, _below(_as_curl(ran.calls), ran.calls, self.options.get("refused"))]


def _as_curl(calls: tuple[Call[Any], ...]) -> list[nodes.Node]:
    """The calls for a shell, folded."""
    if not calls:
        return []
    text = "\n".join(curl(call) for call in calls)
    block = nodes.literal_block(text, text, language="sh", force=True)
    return _folded("with curl", [block], "curl")


def _below(fold: list[nodes.Node], calls: tuple[Call[Any], ...], refusal: str | None = None) -> nodes.container:
    """What hangs below a piece: a fold, and beside it the way to what the reference says of the calls."""
    return nodes.container("", *fold, below_a_call(calls, refusal), classes=["below"])


def _folded(title: str, content: list[nodes.Node], kind: str) -> list[nodes.Node]:
    opening = f'<details class="{kind}"><summary>{escape(title)}</summary>'
    return [nodes.raw("", opening, format="html"), *content, nodes.raw("", "</details>", format="html")]


class Formula(SphinxDirective):
    """Formulas that a call gives: an expression for LaTeX, one text or several, each on a line of its own."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        """The formulas."""
        try:
            latex = session_of(self.env.docname).value("\n".join(self.content))
        except Unexpected as error:
            raise self.error(str(error)) from error
        lines = [latex] if isinstance(latex, str) else latex
        blocks = [nodes.math_block(line, line, nowrap=False, number=None, label=None) for line in lines]
        for block in blocks:
            self.set_source_info(block)
        return [*blocks]


class Picture(SphinxDirective):
    """A picture: the last value of the content, a figure of matplotlib, or what a call gives as SVG or PNG.

    Options:
        alt: What is to be seen, for whoever cannot see it; must be there.
        caption: A sentence below it.

    A number in either is one of the picture's own code, or stated and compared as in a sentence: {is}`2 = 1 + 1`.
    """

    has_content = True
    option_spec: ClassVar = {"alt": directives.unchanged_required, "caption": directives.unchanged}

    def run(self) -> list[nodes.Node]:
        """The picture, and the call folded below it."""
        if "alt" not in self.options:
            raise self.error("a picture needs :alt:, which says what is to be seen")
        code, session = "\n".join(self.content), session_of(self.env.docname)
        try:
            content, calls = session.recorded(code)
        except Unexpected as error:
            raise self.error(str(error)) from error
        title = "the call"
        if isinstance(content, Figure):
            content, title = svg(content), "how it is drawn"
        try:
            alt, caption = (_true(self.options.get(text, ""), code, session) for text in ("alt", "caption"))
        except Unexpected as error:
            raise self.error(str(error)) from error
        if not isinstance(content, bytes) or not content.startswith((_SVG, _PNG)):
            raise self.error("it gives no picture: a figure, or SVG or PNG as bytes")
        figure = (
            f'<figure class="picture"><img src="{self._saved(content)}" alt="{escape(alt)}">'
            f"{caption and f'<figcaption>{escape(caption)}</figcaption>'}</figure>"
        )
        call = nodes.literal_block(code, code, language="python")
        fold = _folded(title, [call, *_as_curl(calls)], "curl")
        return [nodes.raw("", figure, format="html"), _below(fold, calls)]

    def _saved(self, content: bytes) -> str:
        """Where the picture is, from the page."""
        page = self.env.docname
        name = f"{page.replace('/', '-')}-{self.env.new_serialno('picture')}.{'svg' if content[:5] == _SVG else 'png'}"
        folder = Path(self.env.app.outdir) / _PICTURES
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
        return f"{'../' * page.count('/')}{_PICTURES}/{name}"


class Exercise(SphinxDirective):
    """A numbered exercise; its answers stand in it."""

    has_content = True
    optional_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """The exercise in a frame."""
        number = self.env.new_serialno("exercise") + 1
        title = f"Exercise {number}" + (f": {self.arguments[0]}" if self.arguments else "")
        frame = nodes.container(classes=["exercise"])
        frame += nodes.rubric("", "", *self.state.inline_text(title, self.lineno)[0], classes=["exercise-title"])
        self.state.nested_parse(self.content, self.content_offset, frame)
        return [frame]


class Answer(SphinxDirective):
    """An answer, folded; what it states is compared with what an expression gives, and the way there is below it.

    Options:
        is: The expression. It may use what the content has run.
        unit: Written behind what is stated.
    """

    has_content = True
    required_arguments = 1
    final_argument_whitespace = True
    option_spec: ClassVar = {"is": directives.unchanged_required, "unit": directives.unchanged}

    def run(self) -> list[nodes.Node]:
        """The answer behind a fold."""
        (stated,) = self.arguments
        if "is" not in self.options:
            raise self.error("an answer needs :is:, an expression that gives it")
        way = nodes.container(classes=["way"])
        self.state.nested_parse(self.content, self.content_offset, way)
        try:
            difference = disagreement(stated, session_of(self.env.docname).value(self.options["is"]))
        except Unexpected as error:
            raise self.error(str(error)) from error
        if difference:
            raise self.error(difference)
        unit = self.options.get("unit", "")
        result = nodes.paragraph("", "", nodes.strong("", f"{stated} {unit}".rstrip()))
        return _folded("Answer", [result, way], "answer")


def _true(text: str, code: str, session: Session) -> str:
    """What a picture's text states, once it is found to be true.

    Raises:
        Unexpected: It is not, or a number is neither compared nor one of the picture's code.
    """
    known = set(_NUMBER.findall(code))
    if untold := [number for number in _NUMBER.findall(_IS.sub("", text)) if number not in known]:
        raise Unexpected(f"{', '.join(untold)} in the picture's text should be {{is}}`value = expression`")
    return _IS.sub(lambda found: _stated(found[1], session), text)


def _stated(text: str, session: Session) -> str:
    """A value that is stated, of `value = expression`.

    Raises:
        Unexpected: The expression gives another one.
    """
    stated, equals, expression = text.partition(" = ")
    if not equals:
        raise Unexpected(f"{text!r} should be a value, =, and an expression that gives it")
    if difference := disagreement(stated, session.value(expression)):
        raise Unexpected(difference)
    return stated


class Is(SphinxRole):
    """A value in a sentence: `0.5021 = det`, what is stated, and an expression that gives it."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """What is stated, once it is found to be true."""
        try:
            stated = _stated(self.text, session_of(self.env.docname))
        except Unexpected as error:
            return [], [self.inliner.reporter.error(str(error), line=self.lineno)]
        return [nodes.Text(stated)], []
