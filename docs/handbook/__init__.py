"""How the handbook is built: `./dev handbook` turns the pages of `docs/` into `build/handbook`, with Sphinx.

- `conf`: Sphinx's settings. `mathematics`: formulas as pictures of glyphs, drawn while building.
- `session`: runs the calls of a page against the service in this process. `written`: values as a reader sees them;
  whether a stated value is what a call gives.
- `directives`: `run`, `formula`, `picture`, `exercise`, `answer` and the role `is`; `docs/writing.md` tells their use.
- `figures`: what a page draws of its own numbers.
- `links`: names of the reference in a page become links to it.
- `reference`, `operations`, `schema_words`: the service's own schema as Markdown; `problem_kinds` and `settings_list`
  add what it does not tell. `reference_directives`: the directives that stand for them.
- `site`: what must hold of the built pages: links, navigation, nothing from another host.
"""
