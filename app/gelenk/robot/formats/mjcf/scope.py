"""What surrounds an element of an MJCF model: its compiler, the defaults of its class, its meshes, its faults."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from gelenk.errors import InvalidUrdf, quoted
from gelenk.robot.formats.mjcf.values import ORIENTATIONS, Compiler, Mesh
from gelenk.robot.formats.sources import Fault, Sources
from gelenk.robot.xml import MAX_ELEMENTS, Element

MAX_WARNINGS = 50
"""Largest number of warnings that are kept; one more says that there were others."""
MAX_COPIES = 1024
"""Largest number of copies, each a frame."""
MAX_COPIED = 10_000
"""Largest number of elements in copies."""
_NAMES = frozenset({"name", "joint1", "joint2"})
"""Attributes that name a part of the world."""


@dataclass(slots=True)
class Upload:
    """What a model shares with those that it attaches.

    Attributes:
        file: The outermost model's file; those of other files are named in warnings.
        warnings: What is not read, one sentence each.
        models: Models that have been attached, by path.
        roots: Their files.
        opened: Paths of the models that are being read, from the outermost one on.
    """

    sources: Sources
    file: str
    warnings: list[str] = field(default_factory=list)
    models: dict[str, "Model"] = field(default_factory=dict)
    roots: dict[str, Element] = field(default_factory=dict)
    opened: list[str] = field(default_factory=list)
    _count: int = 0
    _copies: int = 0
    _copied: int = 0

    def take(self, elements: int = 1) -> None:
        """Count elements that are read or copied; raises Fault."""
        self._count += elements
        if self._count > MAX_ELEMENTS:
            raise Fault(f"the files have more than {MAX_ELEMENTS} elements")

    def copy(self, copies: int, elements: int) -> None:
        """Count copies of so many elements each, before they are made; raises Fault."""
        self._copies += max(1, copies)
        self._copied += copies * elements
        if self._copies > MAX_COPIES:
            raise Fault(f"with {copies} more the model has more than {MAX_COPIES} copies")
        if self._copied > MAX_COPIED:
            raise Fault(f"with {copies} more the copies have more than {MAX_COPIED} elements")

    def root(self, path: str) -> Element:
        """Return the root element of a model's file, read once; raises Fault."""
        if path not in self.roots:
            self.roots[path] = self.sources.xml(path)
            self.take(sum(1 for _ in below(self.roots[path])))
        return self.roots[path]

    def warn(self, element: Element, oddity: str) -> None:
        """Note something that is not read."""
        file = f"file {quoted(element.file)}: " if element.file != self.file else ""
        if len(self.warnings) < MAX_WARNINGS:
            self.warnings.append(f"{file}line {element.line}: {oddity}")
        elif len(self.warnings) == MAX_WARNINGS:
            self.warnings.append("and more that is not read")


@dataclass(slots=True)
class Model:
    """A model with its includes and copies in place, before its bodies are read.

    Attributes:
        defaults: Attributes by tag, by class; "main" is that of elements without a class.
        equalities: What is in its sections `equality`, and in those of models that it attaches.
    """

    root: Element
    upload: Upload
    compiler: Compiler = field(default_factory=Compiler)
    defaults: dict[str, dict[str, dict[str, str]]] = field(default_factory=lambda: {"main": {}})
    meshes: dict[str, Mesh] = field(default_factory=dict)
    equalities: list[tuple[Element, "ModelScope"]] = field(default_factory=list)

    def sections(self, tag: str) -> Iterator[Element]:
        """Yield the sections of a kind: several count as one."""
        return (element for element in self.root.children if element.tag == tag)


@dataclass(frozen=True, slots=True)
class ModelScope:
    """The model that an element belongs to, and the class of defaults around it."""

    model: Model
    childclass: str = "main"

    def inside(self, element: Element) -> "ModelScope":
        """Return the scope of what is in an element."""
        if isinstance(element, Attached):
            return element.scope
        return replace(self, childclass=element.attributes.get("childclass", self.childclass))

    def given(self, element: Element) -> dict[str, str]:
        """Return an element's attributes with those of its class, else of the class around it; raises Fault."""
        name = element.attributes.get("class", self.childclass)
        if name not in self.model.defaults:
            raise Fault(f"there is no default class {quoted(name)}")
        inherited = self.model.defaults[name].get(element.tag, {})
        if any(key in element.attributes for key in ORIENTATIONS):
            inherited = {key: text for key, text in inherited.items() if key not in ORIENTATIONS}
        return {**inherited, **element.attributes}


@dataclass(slots=True, kw_only=True)
class Attached(Element):
    """A frame around a part of another model, which keeps that one's compiler, defaults and meshes."""

    scope: ModelScope = field(compare=False)


@contextmanager
def placed(element: Element) -> Iterator[None]:
    """Give faults the place of an element: raises InvalidUrdf for them."""
    try:
        yield
    except Fault as fault:
        name = element.attributes.get("name")
        what = element.tag if name is None else f"{element.tag} {quoted(name)}"
        raise InvalidUrdf(str(fault), what, element.line, element.file or None) from None


def below(element: Element) -> Iterator[Element]:
    """Yield an element and all below it."""
    waiting = [element]
    while waiting:
        found = waiting.pop()
        yield found
        waiting += reversed(found.children)


def renamed(element: Element, rename: Callable[[str], str]) -> Element:
    """Return a copy of an element and all below it under other names."""
    children = [renamed(child, rename) for child in element.children]
    attributes = {key: rename(text) if key in _NAMES else text for key, text in element.attributes.items()}
    return replace(element, attributes=attributes, children=children)
