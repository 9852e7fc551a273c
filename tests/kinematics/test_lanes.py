"""Eight numbers at a time: the same results as NumPy's, in the widest registers that the processor has."""

import re
from typing import Any

import llvmlite.binding as llvm
import numba
import numpy as np
import pytest

from gelenk.ik.search import kernels as ik_kernels
from gelenk.kinematics.simd import kernels
from gelenk.kinematics.simd.kernels import cosine_sine
from gelenk.kinematics.simd.lanes import (
    LANES,
    abs_lanes,
    bits,
    floor_lanes,
    lanes,
    load,
    max_lanes,
    min_lanes,
    part,
    rint_lanes,
    sqrt_lanes,
    store,
    where,
)
from gelenk.kinematics.warm_up import warm_up
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import _OPTIONS, compiled, inlined, unmanaged

EXPRESSIONS: dict[str, tuple[Any, Any]] = {
    "sum": (lambda a, b: a + b, lambda a, b: a + b),
    "difference": (lambda a, b: a - 2.5 * b, lambda a, b: a - 2.5 * b),
    "quotient": (lambda a, b: (a * b) / (1.0 + b * b), lambda a, b: (a * b) / (1.0 + b * b)),
    "negation": (lambda a, b: -a + 3 * b, lambda a, b: -a + 3 * b),
    "root": (lambda a, b: sqrt_lanes(abs_lanes(a)) + b, lambda a, b: np.sqrt(np.abs(a)) + b),
    "rounding": (lambda a, b: rint_lanes(a) + floor_lanes(b), lambda a, b: np.rint(a) + np.floor(b)),
    "extremes": (
        lambda a, b: min_lanes(a, b) - max_lanes(a, 0.25),
        lambda a, b: np.minimum(a, b) - np.maximum(a, 0.25),
    ),
    "choice": (lambda a, b: where((a < b) & (b > 0.0), a, b), lambda a, b: np.where((a < b) & (b > 0.0), a, b)),
    "either": (lambda a, b: where((a >= b) | (b <= 0.0), 1.0, b), lambda a, b: np.where((a >= b) | (b <= 0.0), 1.0, b)),
    "broadcast": (lambda a, b: lanes(0.5) * a + b, lambda a, b: 0.5 * a + b),
}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", EXPRESSIONS)
def test_the_operators_agree_with_numpy(name: str) -> None:
    in_lanes, in_numpy = EXPRESSIONS[name]
    compute = inlined(in_lanes)

    @unmanaged
    def run(numbers: Array, result: Array) -> None:
        store(result, 0, compute(load(numbers, 0), load(numbers, 1)))

    numbers, result = np.random.default_rng(3).uniform(-4.0, 4.0, 2 * LANES), np.empty(LANES)
    run(numbers, result)
    np.testing.assert_allclose(result, in_numpy(numbers[:LANES], numbers[LANES:]), rtol=1e-15, atol=1e-15)


def test_a_mask_tells_its_lanes_as_bits() -> None:
    @unmanaged
    def negative(numbers: Array) -> int:
        mask: int = bits(load(numbers, 0) < 0.0)
        return mask

    numbers = np.array([-1.0, 2.0, 3.0, -4.0, 5.0, 6.0, np.nan, -8.0])
    assert negative(numbers) == 0b10001001


def test_a_part_of_a_flat_array_is_a_view_in_any_shape() -> None:
    @unmanaged
    def fill(numbers: Array, n: int) -> None:
        row, cube = part(numbers, 2, (n,)), part(numbers, 5, (2, n, 4))
        for i in range(n):
            row[i] = i + 1.0
            for j in range(4):
                cube[0, i, j], cube[1, i, j] = 10.0 * i + j, -10.0 * i - j

    numbers, expected = np.full(32, np.nan), np.full(32, np.nan)
    fill(numbers, 3)
    first = 10.0 * np.arange(3)[:, None] + np.arange(4)
    expected[2:5], expected[5:29] = [1.0, 2.0, 3.0], np.concatenate((first.ravel(), -first.ravel()))
    np.testing.assert_array_equal(numbers, expected)


@pytest.mark.parametrize("largest", [1.0, np.pi, 100.0, 1e4, 1e6])
def test_cosine_and_sine_are_right_to_rounding(largest: float) -> None:
    @unmanaged
    def run(angles: Array, cosines: Array, sines: Array) -> None:
        for row in range(len(angles) // LANES):
            c, s = cosine_sine(load(angles, row))
            store(cosines, row, c)
            store(sines, row, s)

    angles = np.random.default_rng(4).uniform(-largest, largest, 1000 * LANES)
    angles[:17] = np.arange(-8, 9) * (np.pi / 4)
    cosines, sines = np.empty_like(angles), np.empty_like(angles)
    run(angles, cosines, sines)
    np.testing.assert_allclose(cosines, np.cos(angles), rtol=0.0, atol=2.3e-16)
    np.testing.assert_allclose(sines, np.sin(angles), rtol=0.0, atol=2.3e-16)


@pytest.mark.slow
@pytest.mark.parametrize("kernel", [kernels.chain_poses, kernels.chain_jacobians, ik_kernels._search])
def test_a_kernel_computes_in_the_widest_registers(kernel: Any) -> None:
    """Compiled anew, because of code from the cache nothing can be told."""
    warm_up()
    fresh: Any = numba.njit(**{**_OPTIONS, "cache": False})(kernel.py_func)
    fresh.compile(kernel.signatures[0])
    (assembly,) = fresh.inspect_asm().values()
    features = llvm.get_host_cpu_features()
    register = next((name for name, feature in (("zmm", "avx512f"), ("ymm", "avx2")) if features[feature]), "xmm")
    packed = re.findall(rf"v?(?:fn?m\w+|mul|add)pd[^\n]*%{register}", assembly)
    single = re.findall(r"v?(?:fn?m\w+|mul|add)sd[^\n]*%xmm", assembly)
    assert len(packed) > 50
    assert len(single) < len(packed) / 10


def test_an_array_of_a_kernel_begins_at_a_register() -> None:
    """Else each of its registers may be in two lines of the cache."""

    @compiled
    def some() -> tuple[Array, Array, Array]:
        return np.empty(9), np.zeros((3, 5)), np.empty(200)

    assert all(array.ctypes.data % (LANES * 8) == 0 for _ in range(20) for array in some())
