"""The decorators for compiled functions, and where these are stored. Numba takes a third of a second to load."""

import contextlib
import hashlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import llvmlite.binding
import numba

_Function = TypeVar("_Function", bound=Callable[..., Any])
_KERNEL = re.compile(rb"^@(compiled|unmanaged|inlined)$", re.MULTILINE)
_IMPORT = re.compile(rb"^\s*from app\.([\w.]+) import", re.MULTILINE)


def _kernel_digest() -> str:
    """What tells one state of the kernels' sources from another: those with kernels, and all that these import.

    The errors are left out: kernels raise none, and new ones are no reason to compile all anew.
    """
    package = Path(__file__).parents[1]
    texts = {path: path.read_bytes() for path in package.glob("[mk]*/**/*.py")}
    waiting = [path for path, text in texts.items() if _KERNEL.search(text)]
    sources: set[Path] = set()
    while waiting:
        path = waiting.pop()
        if path in texts and path not in sources and path.stem != "errors":
            sources.add(path)
            imported = (name.decode().replace(".", "/") for name in _IMPORT.findall(texts[path]))
            waiting += [package / f"{name}.py" for name in imported]
    digest = hashlib.sha256()
    for path in sorted(sources):
        digest.update(str(path.relative_to(package)).encode() + texts[path])
    return digest.hexdigest()[:16]


def _processor_digest() -> str:
    """What tells one kind of processor from another: what is compiled for one need not run on the other."""
    features = sorted(llvmlite.binding.get_host_cpu_features().items())
    words = (llvmlite.binding.get_host_cpu_name(), features, _SETTINGS.CPU_NAME, _SETTINGS.CPU_FEATURES)
    return hashlib.sha256(repr(words).encode()).hexdigest()[:8]


# Numba renews what it has stored of a function when the function's own file changes, but not when one does from which
# it took another function: so each state of the sources has a store of its own.
_SETTINGS: Any = numba.config
_STORE = Path(_SETTINGS.CACHE_DIR or Path(__file__).parents[1] / "__pycache__" / "kernels")
_STORE /= f"{_kernel_digest()}-{_processor_digest()}"
_SETTINGS.CACHE_DIR = str(_STORE)
_ALL_STORED = _STORE / "all"
_OPTIONS: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy", "fastmath": {"contract"}}
_UNMANAGED: dict[str, Any] = {**_OPTIONS, "_nrt": False}


def is_stored() -> bool:
    """Whether all kernels have been compiled for this kind of processor before, and only need to be read."""
    return _ALL_STORED.exists()


def note_stored() -> None:
    """Say that all of them have been; where nothing can be written none is stored either."""
    with contextlib.suppress(OSError):
        _ALL_STORED.touch()


def compiled(function: _Function) -> _Function:
    """Compile for the machine at the first call, without the GIL, cached on disk.

    Division follows IEEE 754 as NumPy's does: the functions guard their own denominators. A product and a sum may
    be contracted to one rounding, nothing else is reordered.
    """
    return cast(_Function, numba.njit(**_OPTIONS)(function))


def unmanaged(function: _Function) -> _Function:
    """Compile what neither makes nor returns an array, and then need not count references to those it is given.

    In a loop over many small functions the counting costs more than the arithmetic.
    """
    return cast(_Function, numba.njit(**_UNMANAGED)(function))


def inlined(function: _Function) -> _Function:
    """The same as a part of each function that calls it, so that numbers stay in registers between the two."""
    return cast(_Function, numba.njit(**_UNMANAGED, forceinline=True)(function))
