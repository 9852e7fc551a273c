"""Returns memory that libraries take in a process and no longer need."""

import ctypes
import re
from collections.abc import Iterator
from pathlib import Path

_DONT_NEED = 4
_MAPPING = re.compile(r"([0-9a-f]+)-([0-9a-f]+) (r-[x-]p) \S+ \S+ \S+ +/")


def release_code() -> None:
    """Return the memory of library code to the system; only loading the kernels needed 80 MB of it.

    Only pages equal to their file are returned: code that runs again is read from it. Only Linux supports this.
    """
    try:
        mappings = Path("/proc/self/smaps").read_text()
    except OSError:
        return
    advise = ctypes.CDLL(None).madvise
    for start, end in _unchanged_code(mappings):
        advise(ctypes.c_void_p(start), ctypes.c_size_t(end - start), _DONT_NEED)


def _unchanged_code(mappings: str) -> Iterator[tuple[int, int]]:
    """Yield the address ranges that are mapped read-only from files and contain no changed page."""
    found: tuple[int, int] | None = None
    for line in mappings.splitlines():
        if match := _MAPPING.match(line):
            found = int(match[1], 16), int(match[2], 16)
        elif line.startswith("Anonymous:"):
            if found is not None and line.split()[1] == "0":
                yield found
            found = None
