"""What the pages of the reference are written with: each directive stands for what it finds in the code.

- `operations`: all operations of a group of the schema, with their objects; the argument names the group.
- `objects`: the fields of objects that no operation takes or answers with; the argument names them.
- `problems`: all kinds of problems.
- `settings`, `bounds`: what an operator can set, and what nobody can.
"""

from collections.abc import Callable
from functools import cache
from typing import Any, ClassVar

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from docs.handbook.problem_kinds import problems
from docs.handbook.reference import Reference
from docs.handbook.session import service
from docs.handbook.settings_list import bounds, settings


def setup(app: Sphinx) -> dict[str, Any]:
    """Add them to Sphinx."""
    app.add_directive("operations", Operations)
    app.add_directive("objects", Objects)
    app.add_directive("problems", Problems)
    app.add_directive("settings", OfSettings)
    app.add_directive("bounds", Bounds)
    return {"version": "1", "parallel_read_safe": False, "parallel_write_safe": True}


@cache
def _reference() -> Reference:
    return Reference(service().schema())


class Operations(SphinxDirective):
    """The operations of a group."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """Sections."""
        return self.parse_text_to_nodes(_reference().group(self.arguments[0]), allow_section_headings=True)


class Objects(SphinxDirective):
    """The fields of objects."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """Sections."""
        text = "\n\n".join(_reference().object(name, level=2) for name in self.arguments[0].split())
        return self.parse_text_to_nodes(text, allow_section_headings=True)


class _Written(SphinxDirective):
    """A text without arguments."""

    text: ClassVar[Callable[[], str]]

    def run(self) -> list[nodes.Node]:
        """Its sections, or what it has instead."""
        return self.parse_text_to_nodes(type(self).text(), allow_section_headings=True)


class Problems(_Written):
    """All kinds of problems."""

    text = staticmethod(problems)


class OfSettings(_Written):
    """What an operator can set."""

    text = staticmethod(settings)


class Bounds(_Written):
    """What no setting changes."""

    text = staticmethod(bounds)
