"""Giving back the memory of libraries that only loading has needed."""

import subprocess
import sys

import pytest

PROGRAM = """
import numpy as np
import numba
from pathlib import Path
from gelenk.processes.fork_server import release_code

def of_files():
    lines = Path("/proc/self/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith("RssFile")).split()[1])

@numba.njit
def twice(x):
    return 2.0 * x

assert twice(1.5) == 3.0
before = of_files()
release_code()
after = of_files()
values = np.linalg.inv(np.array([[2.0, 1.0], [1.0, 2.0]]))
assert np.allclose(values, [[2 / 3, -1 / 3], [-1 / 3, 2 / 3]])
assert twice(2.5) == 5.0 and numba.njit(lambda x: x + 1)(1) == 2, "compiling goes on as before"
print(before, after)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no /proc")
def test_most_of_what_libraries_take_is_given_back_and_all_goes_on() -> None:
    run = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True, timeout=120)
    before, after = (int(kilobytes) for kilobytes in run.stdout.split())
    assert before > 50_000
    assert after < before / 4
