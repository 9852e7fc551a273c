"""`./dev handbook`: compare the pages with what their calls give, build them, look through what was built."""

import argparse
import shutil
import sys
from pathlib import Path

from sphinx.cmd.build import build_main

from docs.handbook import site
from docs.handbook.committed import renew
from docs.handbook.examples import renew_examples
from docs.handbook.papers import print_papers
from docs.handbook.session import end_service

ROOT = Path(__file__).resolve().parents[2]
OUTPUT = ROOT / "build" / "handbook"


def main() -> None:
    """Exit with 0 only where every call is answered as its page says, and every page is sound."""
    parser = argparse.ArgumentParser(prog="./dev handbook", description=__doc__)
    parser.add_argument("pages", nargs="*", help="build these alone, such as docs/course/statics.md; all if left out")
    parser.add_argument("--write", action="store_true", help="write what the calls give into the pages")
    arguments = parser.parse_args()
    pages = arguments.pages
    found = [] if pages else list(renew_examples(arguments.write))  # which the pages of the reference show
    found += list(renew([Path(page) for page in pages] or sorted(Path("docs").rglob("*.md")), arguments.write))
    end_service()
    if found:
        sys.exit("\n".join(found))
    if not pages:
        shutil.rmtree(OUTPUT, ignore_errors=True)  # what an earlier page left behind would hide a dead link
    if build(ROOT / "docs", OUTPUT, pages) != 0:
        sys.exit("the handbook is not built: see above")
    if pages:
        return
    for left_out in print_papers(OUTPUT):
        print(left_out)
    if faults := site.faults(OUTPUT, site.page_names(ROOT / "docs")):
        sys.exit("\n".join([*faults, "the handbook is not sound: see above"]))
    print(f"{len(site.page_names(ROOT / 'docs'))} pages: {(OUTPUT / 'index.html').relative_to(ROOT)}")


def build(pages: Path, output: Path, only: list[str] | None = None) -> int:
    """Sphinx's exit code: not 0 where it has anything to warn of, which it says on standard error.

    Args:
        pages: The folder of the sources.
        output: The folder of what is built.
        only: Sources that are read and written; all if empty.
    """
    options = ["--fail-on-warning", "--nitpicky", "--quiet", "--conf-dir", str(Path(__file__).resolve().parent)]
    options += ["--doctree-dir", str(output.with_name("doctrees"))]  # not among what is served
    if not only:
        options += ["--fresh-env", "--write-all"]
    return build_main([*options, str(pages), str(output), *(only or [])])


if __name__ == "__main__":
    main()
