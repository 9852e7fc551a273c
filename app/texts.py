"""Translations: `python app/texts.py` compiles the fragments in `app/gelenk/texts`, with `--check` it only looks.

Every message that the sources mark with `_("…")` or `marked("…")` stands in one fragment of each language, with the
same placeholders, and no fragment holds another one.
"""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from babel.messages.catalog import Catalog
from babel.messages.mofile import read_mo, write_mo
from babel.messages.pofile import read_po

PACKAGE = Path(__file__).parent / "gelenk"
TEXTS = PACKAGE / "texts"
_MARKS = frozenset({"_", "translated", "marked"})
_PLACEHOLDER = re.compile(r"\{\w[^{}]*\}|\{\}")


def main() -> None:
    """Report what is wrong; compile what can be, or without the right to write report that too."""
    messages, faults = extracted(PACKAGE)
    for folder in sorted(path for path in TEXTS.iterdir() if path.is_dir()):
        entries, more = fragments(folder)
        faults += more + differences(messages, entries, folder.name)
        compiled = folder / "LC_MESSAGES" / "gelenk.mo"
        if compiled_entries(compiled) != entries:
            if "--check" in sys.argv:
                faults.append(f"{compiled.relative_to(PACKAGE)}: stale: run ./dev texts")
            else:
                write(compiled, entries)
    sys.exit("\n".join(faults) or None)


def extracted(package: Path) -> tuple[dict[str, str], list[str]]:
    """Return each message of the sources with the place that has it first, and what cannot be translated."""
    found: dict[str, str] = {}
    faults = []
    for file in sorted(package.rglob("*.py")):
        for line, argument in _marked(ast.parse(file.read_text(encoding="utf-8"))):
            place = f"{file.relative_to(package)}:{line}"
            if isinstance(argument, ast.Constant):
                found.setdefault(str(argument.value), place)
            elif isinstance(argument, ast.JoinedStr | ast.BinOp):
                faults.append(f"{place}: a message is one constant string, filled in by .format() after translation")
    return found, faults


def _marked(tree: ast.AST) -> Iterator[tuple[int, ast.expr]]:
    """Yield the arguments of the marks, both of `a if n == 1 else b`; a variable is marked where it is set."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _MARKS and node.args:
            message = node.args[0]
            chosen = [message.body, message.orelse] if isinstance(message, ast.IfExp) else [message]
            yield from ((node.lineno, one) for one in chosen)


def fragments(folder: Path) -> tuple[dict[str, str], list[str]]:
    """Return the translations that are done, of all fragments of a language, and what two of them have."""
    entries: dict[str, str] = {}
    faults = []
    for file in sorted(folder.glob("*.po")):
        with file.open("rb") as stream:
            for message in read_po(stream, abort_invalid=True):
                if not message.id or not message.string or message.fuzzy:
                    continue
                if str(message.id) in entries:
                    faults.append(f"{file.name}: another fragment, or this one, has it already: {message.id!r}")
                entries[str(message.id)] = str(message.string)
    return entries, faults


def differences(messages: dict[str, str], entries: dict[str, str], language: str) -> list[str]:
    """Return messages without translation, translations without message, and those with other placeholders."""
    missing = [f"{messages[one]}: not in {language}: {one!r}" for one in messages if one not in entries]
    dead = [f"{language}: no source has it: {one!r}" for one in entries if one not in messages]
    other = [
        f"{language}: other placeholders: {one!r}" for one, text in entries.items() if _fields(one) != _fields(text)
    ]
    return missing + dead + other


def _fields(text: str) -> set[str]:
    return set(_PLACEHOLDER.findall(text))


def compiled_entries(file: Path) -> dict[str, str]:
    """Return what a compiled catalogue holds; nothing if it is not there."""
    if not file.exists():
        return {}
    with file.open("rb") as stream:
        return {str(message.id): str(message.string) for message in read_mo(stream) if message.id}


def write(file: Path, entries: dict[str, str]) -> None:
    """Compile a catalogue for `gettext`."""
    catalog = Catalog(locale=file.parents[1].name)
    for message, text in entries.items():
        catalog.add(message, text)
    file.parent.mkdir(exist_ok=True)
    with file.open("wb") as stream:
        write_mo(stream, catalog)


if __name__ == "__main__":
    main()
