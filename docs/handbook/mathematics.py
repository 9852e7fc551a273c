"""Formulas, drawn while the handbook is built: SVG of the glyphs of STIX Two Math, without a script or a font file.

A glyph that a page has had already is not written again: formulas refer to it by its name.
"""

import re
from html import escape
from typing import Any

from docutils.nodes import SkipNode
from sphinx.application import Sphinx
from sphinx.util import logging
from ziamath.config import config
from ziamath.zmath import Latex

_SIZE = 16.0
"""Of a formula's letters in the drawing."""
_EM = 14.5
"""What becomes one em of the text around: the letters are a little larger, as those of the text are wide."""
_GLYPH = re.compile(r'<symbol id="([^"]+)"[^>]*?(?:/>|>.*?</symbol>)', re.DOTALL)
"""An empty one, of a space, closes itself."""
_ROOT = re.compile(r'<svg [^>]*width="([-.\d]+)" height="([-.\d]+)" viewBox="([^"]*)">')

_SIGN = re.compile(r"([=(\[,<>]|\\(?:in|le|ge|approx|to)\b)\s*([-+])")
"""A sign that is no difference and no sum; it stands next to its number, which ziamath must be told."""

_FUNCTION = re.compile(
    r"(?P<before>(?<=[A-Za-z0-9)}])\s*)?(?P<name>\\(?:sin|cos|tan|det|ker)\b(?:\^\w|\^\{\w+\})?)\s*"
    r"(?P<bare>(?=[A-Za-z]|\\(?!left|bigl|[^a-z])))?"
)
"""A function stands apart from a factor before it, and from an argument without parentheses."""

_MATRIX = re.compile(r"\\begin\{([bp]matrix|array)\}.*?\\end\{\1\}", re.DOTALL)
_COLUMN = re.compile(r"&\s*(-?)")
"""Columns of a matrix or table would stand too near to each other."""

_logger = logging.getLogger(__name__)

config.svg2 = True
config.precision = 2


def setup(app: Sphinx) -> dict[str, Any]:
    """Make it the renderer `glyphs`."""
    app.add_html_math_renderer("glyphs", inline_renderers=(_visit_inline, None), block_renderers=(_visit_block, None))
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


def drawn(latex: str, is_display: bool, known: set[str]) -> str:
    """A formula as SVG in the line, or of a line of its own.

    Args:
        latex: Without dollars.
        is_display: Whether it has a line of its own.
        known: Names of the glyphs that the page has had; those of this formula are added.

    Raises:
        ValueError: The formula cannot be read.
    """
    try:
        spaced = _MATRIX.sub(_spaced, _FUNCTION.sub(_apart, _SIGN.sub(r"\1{\2}", latex)))
        formula = Latex(spaced, size=_SIZE, color="currentColor", inline=not is_display)
        svg, below = formula.svg(), formula.getyofst()
    except Exception as error:
        raise ValueError(f"{latex!r} cannot be set: {error}") from error
    width, height, box = _ROOT.match(svg).groups()  # type: ignore[union-attr]
    shift = "" if is_display else f"vertical-align:{below / _EM:.3f}em;"
    style = f"width:{float(width) / _EM:.3f}em;height:{float(height) / _EM:.3f}em;{shift}"
    head = f'<svg role="img" aria-label="{escape(latex)}" viewBox="{box}" style="{style}">'
    return _GLYPH.sub(lambda glyph: _once(glyph, known), _ROOT.sub(lambda _: head, svg, count=1))


def _apart(function: re.Match[str]) -> str:
    before, after = (r"\," if function[side] is not None else "" for side in ("before", "bare"))
    return f"{before}{function['name']}{after} "


def _spaced(matrix: re.Match[str]) -> str:
    return _COLUMN.sub(lambda column: r"\;&\;{-}" if column[1] else r"\;&\;", matrix[0])


def _once(glyph: re.Match[str], known: set[str]) -> str:
    if glyph[1] in known:
        return ""
    known.add(glyph[1])
    return glyph[0]


def _written(translator: Any, node: Any, is_display: bool) -> str:
    if not hasattr(translator, "known_glyphs"):
        translator.known_glyphs = set()
    try:
        return drawn(node.astext(), is_display, translator.known_glyphs)
    except ValueError as error:
        _logger.warning(str(error), location=node)
        return escape(node.astext())


def _visit_inline(translator: Any, node: Any) -> None:
    translator.body.append(f'<span class="formula">{_written(translator, node, is_display=False)}</span>')
    raise SkipNode


def _visit_block(translator: Any, node: Any) -> None:
    translator.body.append(f'<div class="formula">{_written(translator, node, is_display=True)}</div>')
    raise SkipNode
