"""Sphinx's settings. Nothing here may let a page load anything from another host."""

import re
import sys
from pathlib import Path

from sphinx.application import Sphinx

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from docs.handbook.committed import SHOWN  # noqa: E402 - found by the path above

project = "Gelenk"
author = "the authors of Gelenk"
html_title = "Gelenk handbook"
language = "en"

extensions = [
    "myst_parser",
    "docs.handbook.mathematics",
]
source_suffix = {".md": "markdown"}
exclude_patterns = ["handbook"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
# Of a console block whose command has several lines; and of anchors in HTML, which `site` looks up.
suppress_warnings = ["misc.highlighting_failure", "myst.xref_missing"]

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["handbook.css"]
html_js_files = [("copy.js", {"defer": "defer"}), ("tabs.js", {"defer": "defer"})]
html_favicon = str(ROOT / "app" / "gelenk" / "studio" / "icon.svg")
html_math_renderer = "glyphs"
html_copy_source = False
html_show_copyright = False
html_show_sourcelink = False
pygments_style = "tango"
pygments_dark_style = "github-dark"


def setup(app: Sphinx) -> None:
    """Build pages with their calls in tabs; make the navigation of the first page's lists: a part for each heading."""
    app.connect("env-get-outdated", lambda app, env, *_: [page for page in env.found_docs if _shown(app, page)])
    app.connect("source-read", _tabs)
    app.connect("source-read", _navigation)


def _tabs(app: Sphinx, page: str, source: list[str]) -> None:
    source[0] = _shown(app, page) or source[0]


def _shown(app: Sphinx, page: str) -> str | None:
    return SHOWN.get(Path(app.env.doc2path(page)).resolve())


def _navigation(_: Sphinx, page: str, source: list[str]) -> None:
    if page == "index":
        for part in source[0].split("\n## ")[1:]:
            pages = "\n".join(re.findall(r"^- \[.*?\]\((.*?)\.md\)", part, re.MULTILINE))
            source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {part.splitlines()[0]}\n\n{pages}\n```\n"
