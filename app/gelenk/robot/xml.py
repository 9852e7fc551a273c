"""Parses untrusted XML into a plain tree of elements with lines, within limits; nothing is expanded or fetched."""

import re
from dataclasses import dataclass, field
from io import BytesIO
from typing import Any
from xml.sax import SAXParseException
from xml.sax.handler import ContentHandler
from xml.sax.xmlreader import AttributesImpl, InputSource

from defusedxml.common import DefusedXmlException
from defusedxml.sax import make_parser

from gelenk.errors import InvalidUrdf, listed, quoted

MAX_BYTES = 2 * 1024 * 1024
MAX_DEPTH = 64
MAX_ELEMENTS = 50_000
MAX_ATTRIBUTES = 64
MAX_VALUE_LENGTH = 4096

_DECLARED_ENCODING = re.compile(r"<\?xml[^>]*?\bencoding\s*=\s*[\"']([^\"']*)[\"']")
_LATE_DECLARATION = re.compile(r"((?>[ \t\r\n\ufeff]|<!--.*?-->)++)(<\?xml\s.*?\?>)", re.DOTALL)
_EXPRESSION = re.compile(r"\$[({]")
_OLD_TAGS = frozenset({"arg", "if", "include", "insert_block", "macro", "property", "unless"})
"""Elements of older xacro versions, which used no prefix."""
_KNOWN_ENCODINGS = frozenset({"utf-8", "utf8", "us-ascii", "ascii"})


@dataclass(slots=True)
class Element:
    """A tag with its attributes, child elements, and the line (1-based) and file where it starts; text is dropped."""

    tag: str
    attributes: dict[str, str]
    line: int = field(compare=False)
    children: list["Element"] = field(default_factory=list)
    file: str = field(default="", compare=False)


def with_declaration_first(text: str) -> str:
    """Move an XML declaration that follows white space and comments to the beginning; lines keep their numbers."""
    text = text.removeprefix("\ufeff")
    late = _LATE_DECLARATION.match(text)
    return text if late is None else late[2] + late[1].replace("\ufeff", "") + text[late.end() :]


def read_xml(text: str, file: str = "") -> Element:
    """Parse a document strictly, and return its root element; if it declares an encoding, UTF-8 or ASCII.

    `file` is the name that each element gets.

    Raises:
        InvalidUrdf: The text is not well-formed, contains a DTD or an entity, or exceeds a limit of this module.
    """
    content = _checked_bytes(text)
    tree = _TreeBuilder(file)
    parser = make_parser()
    parser.forbid_dtd = True
    parser.setContentHandler(tree)
    source = InputSource()
    source.setByteStream(BytesIO(content))
    source.setEncoding("utf-8")
    try:
        parser.parse(source)
    except DefusedXmlException as error:
        raise InvalidUrdf("a DTD or entity is not allowed", None, tree.line) from error
    except SAXParseException as error:
        raise InvalidUrdf(f"not well-formed XML: {error.getMessage()}", None, error.getLineNumber()) from error
    if tree.root is None:
        raise InvalidUrdf("the document has no element")
    return tree.root


def _checked_bytes(text: str) -> bytes:
    if "\0" in text:
        raise InvalidUrdf("a NUL character is not allowed", None, text.count("\n", 0, text.index("\0")) + 1)
    try:
        content = text.removeprefix("\ufeff").encode("utf-8")
    except UnicodeEncodeError as error:
        raise InvalidUrdf("the text holds half of a surrogate pair, which no UTF-8 text can") from error
    if len(content) > MAX_BYTES:
        raise InvalidUrdf(f"the description has {len(content)} bytes; at most {MAX_BYTES} are allowed")
    declared = _DECLARED_ENCODING.match(text.removeprefix("\ufeff"))
    if declared and declared[1].lower() not in _KNOWN_ENCODINGS:
        raise InvalidUrdf(f"the encoding {quoted(declared[1])} is not allowed: write UTF-8", None, 1)
    return content


class _TreeBuilder(ContentHandler):
    """Builds the tree of elements, and stops at the first limit exceeded."""

    def __init__(self, file: str) -> None:
        super().__init__()
        self._file = file
        self.root: Element | None = None
        self._open: list[Element] = []
        self._count = 0
        self._locator: Any = None

    @property
    def line(self) -> int:
        return int(self._locator.getLineNumber())

    def setDocumentLocator(self, locator: Any) -> None:
        self._locator = locator

    def startElement(self, name: str, attrs: AttributesImpl) -> None:
        attributes = dict(attrs.items())
        self._count += 1
        self._check(name, attributes)
        element = Element(name, attributes, self.line, file=self._file)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def endElement(self, name: str) -> None:  # noqa: ARG002
        self._open.pop()

    def _check(self, name: str, attributes: dict[str, str]) -> None:
        if self._count > MAX_ELEMENTS:
            raise InvalidUrdf(f"more than {MAX_ELEMENTS} elements", None, self.line)
        if len(self._open) >= MAX_DEPTH:
            raise InvalidUrdf(f"elements nested deeper than {MAX_DEPTH}", None, self.line)
        if len(attributes) > MAX_ATTRIBUTES:
            reason = f"element {quoted(name)} has {len(attributes)} attributes; at most {MAX_ATTRIBUTES} are allowed"
            raise InvalidUrdf(reason, None, self.line)
        for key, value in attributes.items():
            if len(value) > MAX_VALUE_LENGTH:
                reason = f"attribute {quoted(key)} has {len(value)} characters; at most {MAX_VALUE_LENGTH} are allowed"
                raise InvalidUrdf(reason, None, self.line)


def left_of_xacro(root: Element, ignored: frozenset[str]) -> str | None:
    """Describe the first attribute or element that only xacro understands; return None if the description has none.

    Elements of the robot with the `ignored` tags are not searched.
    """
    waiting = [root]
    while waiting:
        element = waiting.pop()
        children = [child for child in element.children if element is not root or child.tag not in ignored]
        values = [value for value in element.attributes.values() if _EXPRESSION.search(value)]
        values += [child.tag for child in children if element is root and child.tag in _OLD_TAGS]
        if values:
            return f"{quoted(values[0])} (line {element.line}) is unexpanded xacro: expand the xacro before the upload"
        waiting += reversed(children)
    return None


def without_links(root: Element) -> str:
    """Explain why a description has no links."""
    names = tuple(child.attributes.get("name", "") for child in root.children if child.tag in {"macro", "xacro:macro"})
    if not names:
        return "the robot has no link"
    return f"the robot has no link: the xacro defines only the macros {listed(names)}; expand one that calls them"
