"""How the handbook is built: `./dev handbook` turns the pages of `docs/` into `build/handbook`, with Sphinx.

- `committed`: makes the parts of a page that come from the code, and says which pages are not current;
  `docs/writing.md` tells how a page asks for them.
- `session`: runs the calls of a page against the service in this process. `written`: values as a reader sees them;
  whether a stated value is what a call gives. `figures`: what a page draws of its own numbers.
- `reference`, `operations`, `schema_words`: the service's own schema as Markdown; `problem_kinds` and `settings_list`
  add what it does not tell.
- `beside`: the calls of a page with curl, in tabs. `papers`: pages that are also a PDF.
- `conf`: Sphinx's settings, and the navigation. `mathematics`: formulas as pictures of glyphs, drawn while building.
- `site`: what must hold of the built pages: links, navigation, nothing from another host.
"""
