"""What must hold of the built pages: every link leads somewhere, every page is in the navigation, nothing from outside.

A link that a reader may follow to another host is fine; what the browser loads by itself must come with the pages.
"""

import re
from collections.abc import Iterable, Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

_LOADED = {("link", "href"), ("use", "href"), ("image", "href"), ("object", "data")}
"""What the browser loads beside every `src`, `srcset`, `poster` and `xlink:href`."""
_NOT_LOADED = {"next", "prev", "index", "search", "canonical", "author", "copyright"}
"""Relations of a `link` that a browser only notes."""
_IN_STYLE = re.compile(r"""url\(\s*['"]?([^'")\s]+)|@import\s+['"]([^'"]+)""")
_IN_SCRIPT = re.compile(r"""(?:fetch|import|importScripts|Worker)\(\s*['"`](?:https?:)?//""")


class Page(HTMLParser):
    """The links of a page, what it loads, and the places that can be linked to.

    Args:
        path: Of the file.
    """

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.places: set[str] = set()
        self.navigation: list[str] = []
        self._style = False
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take down what the tag names."""
        values = {name: value or "" for name, value in attrs}
        self.places |= {values[name] for name in ("id", "name") if name in values}
        self._style = tag == "style"
        self.loads += _in_style(values.get("style", ""))
        for name, value in values.items():
            is_noted = tag == "link" and set(values.get("rel", "").split()) <= _NOT_LOADED
            if name == "srcset":
                self.loads += [part.split()[0] for part in value.split(",") if part.strip()]
            elif (tag, name) == ("a", "href") or (is_noted and name == "href"):
                self.links.append(value)
                if "reference" in values.get("class", "").split():
                    self.navigation.append(value)
            elif name in {"src", "poster", "xlink:href"} or (tag, name) in _LOADED:
                self.loads.append(value)

    def handle_data(self, data: str) -> None:
        """Look into styles that stand in the page."""
        if self._style:
            self.loads += _in_style(data)


def page_names(sources: Path) -> list[str]:
    """The pages of a folder of sources, such as `course/statics`."""
    return sorted(path.relative_to(sources).with_suffix("").as_posix() for path in sources.rglob("*.md"))


def faults(site: Path, pages: Iterable[str]) -> list[str]:
    """What is wrong with a built handbook, in sentences.

    Args:
        site: Its folder.
        pages: What must be there, and be reached from the navigation of the first page.
    """
    found = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    return [*_dead_links(site, found), *_from_outside(site, found), *_unreachable(site, found, pages)]


def _dead_links(site: Path, pages: dict[Path, Page]) -> Iterator[str]:
    for path, page in pages.items():
        for link in sorted({*page.links, *page.loads}):
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            place = unquote(parts.fragment)
            if target == site.resolve().parent:
                continue  # the service, which shows the studio there
            if not target.is_file():
                yield f"{path.relative_to(site)}: {link} leads nowhere"
            elif place and target in pages and place not in pages[target].places:
                yield f"{path.relative_to(site)}: {link} leads to a place that {target.name} does not have"


def _from_outside(site: Path, pages: dict[Path, Page]) -> Iterator[str]:
    loads = [(path, load) for path, page in pages.items() for load in page.loads]
    loads += [(path, load) for path in site.rglob("*.css") for load in _in_style(path.read_text(encoding="utf-8"))]
    for path, load in loads:
        if urlsplit(load).netloc:
            yield f"{path.relative_to(site)}: {load} would be loaded from another host"
    for path in site.rglob("*.js"):
        if _IN_SCRIPT.search(path.read_text(encoding="utf-8")):
            yield f"{path.relative_to(site)}: the script loads from another host"


def _unreachable(site: Path, pages: dict[Path, Page], names: Iterable[str]) -> Iterator[str]:
    index = site / "index.html"
    reached = {(site / urlsplit(link).path).resolve() for link in pages[index].navigation if not urlsplit(link).netloc}
    for name in names:
        path = (site / f"{name}.html").resolve()
        if not path.is_file():
            yield f"{name}: the page is not built"
        elif path != index.resolve() and path not in reached:
            yield f"{name}: the page is not in the navigation"


def _in_style(text: str) -> list[str]:
    return [one or other for one, other in _IN_STYLE.findall(text)]
