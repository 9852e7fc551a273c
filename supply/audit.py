"""`./dev audit`: known vulnerabilities of what the lock file pins, asked of the package index by pip-audit.

Where nobody can be asked, nothing is said to be safe: that is a failure of its own, unless `--if-reachable` stands
there, for machines without a network. Further options are pip-audit's own.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from supply.pinned import RUN_LOCK

_SECONDS = 300


def main() -> None:
    """Parse the arguments, ask, and report."""
    parser = argparse.ArgumentParser(prog="./dev audit", description=__doc__)
    parser.add_argument("--if-reachable", action="store_true", help="succeed where nobody can be asked")
    parser.add_argument("--lock", type=Path, default=RUN_LOCK, help="another lock file")
    arguments, options = parser.parse_known_args()
    packages = asked(arguments.lock, *options)
    for line in found_in(packages):
        print(line)
    audited = [package for package in packages if "skip_reason" not in package]
    if any(package["vulns"] for package in audited):
        sys.exit("there are known vulnerabilities: raise these versions with ./dev lock")
    if not audited:
        message = "NOT AUDITED: the advisory service cannot be reached, or knows none of the packages"
        if not arguments.if_reachable:
            sys.exit(message)
        print(message)
        return
    skipped = len(packages) - len(audited)
    print(f"{len(audited)} packages without known vulnerabilities" + (f", {skipped} NOT AUDITED" if skipped else ""))


def asked(lock: Path, *options: str) -> list[dict[str, Any]]:
    """What pip-audit says of each package of a lock file; nothing where it could not ask."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        command = [sys.executable, "-m", "pip_audit", "--requirement", str(lock), "--require-hashes", "--disable-pip"]
        command += ["--format", "json", "--output", str(report), "--progress-spinner", "off", *options]
        try:
            run = subprocess.run(command, capture_output=True, text=True, check=False, timeout=_SECONDS)  # noqa: S603
        except subprocess.TimeoutExpired:
            return []
        if not report.exists():
            print(*run.stderr.strip().splitlines()[-1:], file=sys.stderr)
            return []
        packages: list[dict[str, Any]] = json.loads(report.read_text(encoding="utf-8"))["dependencies"]
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
