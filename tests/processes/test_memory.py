"""Freed memory that a process keeps."""

import ctypes
import subprocess
import sys

import pytest

PROGRAM = """
import resource, sys
import numpy as np
from gelenk.processes.memory import keep_freed_memory

if sys.argv[1] == "kept":
    keep_freed_memory()

def new_pages():
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt

def work():
    parts = [np.ones(n) for n in (700_000, 1_200_000, 400_000)]
    return sum(part[-1] for part in parts)

work()
before = new_pages()
for _ in range(10):
    work()
print(new_pages() - before)
"""


@pytest.mark.skipif(not hasattr(ctypes.CDLL(None), "mallopt"), reason="the C library has no such setting")
def test_large_arrays_come_again_from_the_same_pages() -> None:
    def pages(how: str) -> int:
        environment = {"NUMPY_MADVISE_HUGEPAGE": "0"}  # a huge page would count as one
        command = [sys.executable, "-c", PROGRAM, how]
        return int(subprocess.run(command, capture_output=True, check=True, timeout=120, env=environment).stdout)

    assert 10 * pages("kept") < pages("freed")
