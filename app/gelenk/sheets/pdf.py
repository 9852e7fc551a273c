"""A page printed by Chromium, within bounds of time and memory; it can reach no network."""

import shutil
import subprocess

from gelenk.errors import NotPrinted

_NAMES = ("chromium", "chromium-browser", "google-chrome")
_SECONDS = 50
"""Less than a request may take."""
_MEMORY_KB = 3 * 1024**2
_OUT_OF_TIME = (124, 137)
_PRINT = """
umask 077
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
ulimit -d "$1" 2>/dev/null
cat > "$folder/page.html"
shift
timeout -k 1 "$@" "--user-data-dir=$folder/profile" "--print-to-pdf=$folder/page.pdf" "file://$folder/page.html" \
  > /dev/null 2>&1 || exit $?
cat "$folder/page.pdf"
"""
"""Bounds and removes all by itself, even if the process that waits for it is ended."""
_ARGUMENTS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run"),
    *("--disable-extensions", "--disable-sync", "--disable-component-update", "--disable-background-networking"),
    *("--host-resolver-rules=MAP * ~NOTFOUND", "--no-pdf-header-footer"),
)
"""The page is ours, runs nothing and loads nothing, so that it needs no sandbox, which a container often forbids."""


def printed(page: str) -> bytes:
    """Return a page as PDF; raises NotPrinted."""
    program = next(filter(None, map(shutil.which, _NAMES)), None)
    if program is None:
        raise NotPrinted("there is no Chromium on the machine of the service")
    command = ["sh", "-c", _PRINT, "print", str(_MEMORY_KB), str(_SECONDS), program, *_ARGUMENTS]
    ended = subprocess.run(command, input=page.encode(), capture_output=True, check=False, start_new_session=True)  # noqa: S603
    if ended.returncode in _OUT_OF_TIME:
        raise NotPrinted(f"printing takes more than {_SECONDS} s or too much memory: ask for fewer participants")
    if ended.returncode or not ended.stdout.startswith(b"%PDF"):
        raise NotPrinted(f"Chromium ended with {ended.returncode}")
    return ended.stdout
