"""`./dev licences`: the licence of every part of the service; fails where one is not allowed.

What a package says of itself is read from its installed metadata: an SPDX expression, or in older ones the classifiers
or the first line of the licence.
"""

import sys
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from typing import Any, NamedTuple

from license_expression import ExpressionError, LicenseSymbol, LicenseWithExceptionSymbol, get_spdx_licensing

from supply.pinned import Pinned, bundled_packages, python_packages

NONE = "none stated"
ALLOWED = frozenset(
    {
        *("0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC0-1.0"),
        *("ISC", "MIT", "MIT-CMU", "MPL-2.0", "PSF-2.0", "Python-2.0", "Unlicense", "Zlib"),
    }
)
"""Licences under which a part may be used and passed on by anyone for anything, its own changes apart."""

OLDER_WORDS = {
    "Apache Software License": "Apache-2.0",
    "BSD": "BSD-3-Clause",
    "BSD License": "BSD-3-Clause",
    "ISC License": "ISC",
    "ISC License (ISCL)": "ISC",
    "MIT License": "MIT",
    "Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
    "Python Software Foundation License": "PSF-2.0",
}
"""What metadata said before there were expressions."""

SETTLED = {
    ("cmeel-qhull", NONE): "Qhull's own (COPYING.txt): free to use, change and pass on with its notice",
    ("xacro", "Copyright Robert Haschke, Bielefeld University"): "BSD-3-Clause, by the text of its licence",
    ("jrl-cmakemodules", "LGPL-3.0-or-later"): "scripts for building C++, which the service does not run",
}
"""Parts that were looked at by a person, as long as they state just this; and why they may stay."""


class Licence(NamedTuple):
    """The licence of a part, and whether it is allowed."""

    part: Pinned
    stated: str
    is_allowed: bool
    reason: str = ""


def main() -> None:
    """Print the report."""
    found = [judged(part) for part in (*python_packages(), *bundled_packages()) if part.is_for_here]
    for each in found:
        note = "" if each.is_allowed else "  NOT ALLOWED"
        print(f"{each.part.name:28} {each.part.version:12} {each.stated}{each.reason and '; ' + each.reason}{note}")
    if refused := [each.part.name for each in found if not each.is_allowed]:
        sys.exit(f"not allowed, or not known: {', '.join(refused)}; see supply/licences.py")
    print(f"{len(found)} parts, all allowed")


def judged(part: Pinned) -> Licence:
    """A part with its licence."""
    stated = (part.licence if part.ecosystem == "npm" else _of_installed(part)) or NONE
    reason = SETTLED.get((part.name, stated), "")
    return Licence(part, stated, bool(reason) or is_allowed(stated), reason)


def is_allowed(expression: str) -> bool:
    """Whether a licence may be used: of alternatives one must be allowed, of a conjunction all."""
    try:
        parsed = get_spdx_licensing().parse(expression, validate=True)
    except ExpressionError:
        return False
    return parsed is not None and _holds(parsed)


def _holds(node: Any) -> bool:
    if isinstance(node, LicenseSymbol | LicenseWithExceptionSymbol):
        return node.render() in ALLOWED
    return (any if isinstance(node, get_spdx_licensing().OR) else all)(_holds(part) for part in node.args)


def _of_installed(part: Pinned) -> str:
    try:
        found = distribution(part.name)
    except PackageNotFoundError:
        return ""
    return stated_by(found) if found.version == part.version else ""


def stated_by(package: Distribution) -> str:
    """What a package's metadata says, as an SPDX expression where it can be told."""
    (expression,) = package.metadata.get_all("License-Expression") or [""]
    if expression:
        return str(expression)
    classifiers = package.metadata.get_all("Classifier") or []
    words = [each.rpartition(" :: ")[2] for each in classifiers if each.startswith("License :: OSI Approved ::")]
    (text,) = package.metadata.get_all("License") or [""]
    return " AND ".join(OLDER_WORDS.get(word, word) for word in words or text.strip().splitlines()[:1])


if __name__ == "__main__":
    main()
