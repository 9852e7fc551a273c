"""Sphinx's settings. Nothing here may let a page load anything from another host."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

project = "Gelenk"
author = "the authors of Gelenk"
html_title = "Gelenk handbook"
language = "en"

extensions = [
    "myst_parser",
    "docs.handbook.directives",
    "docs.handbook.links",
    "docs.handbook.mathematics",
    "docs.handbook.reference_directives",
]
source_suffix = {".md": "markdown"}
exclude_patterns = ["handbook"]
myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["handbook.css"]
html_js_files = [("copy.js", {"defer": "defer"})]
html_favicon = str(ROOT / "app" / "studio" / "dist" / "icon.svg")
html_math_renderer = "glyphs"
html_copy_source = False
html_show_copyright = False
html_show_sourcelink = False
pygments_style = "tango"
pygments_dark_style = "github-dark"
