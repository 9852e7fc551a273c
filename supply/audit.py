"""`./dev audit`: known vulnerabilities of what the lock file pins, or of what is installed, found by pip-audit.

It asks the package index. Where nobody can be asked, nothing is said to be safe: that is a failure of its own, unless
`--if-reachable` stands there; a machine without a network can ask a folder of advisories. Further options are
pip-audit's own.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from supply import advisories
from supply.pinned import RUN_LOCK

_SECONDS = 300


def main() -> None:
    """Parse the arguments, ask, and report."""
    arguments, options = parser().parse_known_args()
    what = lock_file(arguments.lock) if arguments.installed is None else ["--path", str(arguments.installed)]
    if arguments.advisories is None:
        report(asked(*what, *options), arguments.if_reachable)
        return
    try:
        known = advisories.read(arguments.advisories)
    except ValueError as error:
        sys.exit(str(error))
    print(f"advisories on {len(known)} packages, the last one of {advisories.newest(known)}")
    with advisories.served(known) as url:
        report(asked(*what, "--vulnerability-service", "osv", "--osv-url", url, *options), arguments.if_reachable)


def parser() -> argparse.ArgumentParser:
    """Of what is told to `./dev audit`; what it does not know is for pip-audit."""
    made = argparse.ArgumentParser(prog="./dev audit", description=__doc__)
    made.add_argument("--if-reachable", action="store_true", help="succeed where nobody can be asked")
    audited = made.add_mutually_exclusive_group()
    audited.add_argument("--lock", type=Path, default=RUN_LOCK, help="another lock file")
    audited.add_argument("--installed", type=Path, metavar="FOLDER", help="a folder of packages, as in an image")
    made.add_argument("--advisories", type=Path, metavar="FOLDER", help="advisories as OSV writes them")
    return made


def report(packages: Sequence[dict[str, Any]], if_reachable: bool) -> None:
    """Say what was found, and fail where there is a vulnerability or nothing was audited."""
    for line in found_in(packages):
        print(line)
    audited = [package for package in packages if "skip_reason" not in package]
    if any(package["vulns"] for package in audited):
        sys.exit("there are known vulnerabilities: raise these versions with ./dev lock")
    if not audited:
        message = "NOT AUDITED: the advisory service cannot be reached, or knows none of the packages"
        if not if_reachable:
            sys.exit(message)
        print(message)
        return
    skipped = len(packages) - len(audited)
    print(f"{len(audited)} packages without known vulnerabilities" + (f", {skipped} NOT AUDITED" if skipped else ""))


def lock_file(lock: Path) -> list[str]:
    """What to tell pip-audit to read, so that it installs nothing."""
    return ["--requirement", str(lock), "--require-hashes", "--disable-pip"]


def asked(*options: str) -> list[dict[str, Any]]:
    """What pip-audit says of each package; nothing where it could not ask."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "report.json"
        command = [sys.executable, "-m", "pip_audit", *options]
        command += ["--format", "json", "--output", str(output), "--progress-spinner", "off"]
        try:
            run = subprocess.run(command, capture_output=True, text=True, check=False, timeout=_SECONDS)  # noqa: S603
        except subprocess.TimeoutExpired:
            return []
        if not output.exists():
            print(*run.stderr.strip().splitlines()[-1:], file=sys.stderr)
            return []
        packages: list[dict[str, Any]] = json.loads(output.read_text(encoding="utf-8"))["dependencies"]
        return packages


def found_in(packages: Sequence[dict[str, Any]]) -> list[str]:
    """A line for each vulnerability, with the versions that have it no more."""
    return [
        f"{package['name']} {package['version']}: {each['id']}, fixed in {', '.join(each['fix_versions']) or 'none'}"
        for package in packages
        for each in package.get("vulns", ())
    ]


if __name__ == "__main__":
    main()
