"""Decorators for compiled functions, and the cache of their code. Importing Numba takes a third of a second."""

import contextlib
import hashlib
import logging
import re
import threading
import time
import zlib
from collections.abc import Callable, Iterator
from itertools import chain
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any, TypeVar, cast

import llvmlite.binding
import numba
from numba.core import codegen, cpu, event
from numba.core.caching import UserProvidedCacheLocator
from platformdirs import user_cache_path

_Function = TypeVar("_Function", bound=Callable[..., Any])
_KERNEL = re.compile(rb"^@(compiled|unmanaged|inlined|exclusive)$", re.MULTILINE)
_ROOMS = ("robot", "kinematics", "collision", "ik", "trajectory")
"""Where kernels are."""
_IMPORT = re.compile(rb"^\s*from gelenk\.([\w.]+) import", re.MULTILINE)


def _sources() -> dict[str, bytes]:
    """Return the sources of the rooms of kernels, by their paths in the package.

    `errors` is excluded: kernels raise none of them, and a new error is no reason to recompile.
    """
    package = Path(__file__).parents[1]
    paths = sorted(path for room in _ROOMS for path in package.glob(f"{room}/**/*.py"))
    return {path.relative_to(package).as_posix(): path.read_bytes() for path in paths if path.stem != "errors"}


def kernel_digests() -> dict[str, str]:
    """Return a digest for each source that defines kernels: of itself and of all that it imports, directly or not."""
    sources = _sources()
    imports = {
        path: [f"{name.decode().replace('.', '/')}.py" for name in _IMPORT.findall(text)]
        for path, text in sources.items()
    }
    return {path: _digest(path, imports, sources) for path, text in sources.items() if _KERNEL.search(text)}


def _digest(path: str, imports: dict[str, list[str]], sources: dict[str, bytes]) -> str:
    found, waiting = set[str](), [path]
    while waiting:
        one = waiting.pop()
        if one in sources and one not in found:
            found.add(one)
            waiting += imports[one]
    digest = hashlib.sha256(path.encode())
    for one in sorted(found):
        digest.update(one.encode() + sources[one])
    return digest.hexdigest()[:16]


def _processor_digest() -> str:
    """Return a digest of the processor type, because code compiled for one type need not run on another."""
    features = sorted(llvmlite.binding.get_host_cpu_features().items())
    words = (llvmlite.binding.get_host_cpu_name(), features, _SETTINGS.CPU_NAME, _SETTINGS.CPU_FEATURES)
    return hashlib.sha256(repr(words).encode()).hexdigest()[:8]


def _store() -> Path | None:
    """Return the first writable folder: the configured one, else one in the source tree or the user's cache; or None.

    Each type of processor has a folder of its own in it.
    """
    given = _SETTINGS.CACHE_DIR
    own = (Path(__file__).parents[1] / "__pycache__" / "kernels", user_cache_path("gelenk") / "kernels")
    folders = (Path(given),) if given else own
    for store in (folder / _processor_digest() for folder in folders):
        with contextlib.suppress(OSError):
            store.mkdir(parents=True, exist_ok=True)
            TemporaryFile(dir=store).close()
            return store
    logging.getLogger("gelenk").warning(
        "the kernels are recompiled at each start, which takes about a minute, because nothing can be written to %s: "
        "set NUMBA_CACHE_DIR to a writable folder",
        " or ".join(map(str, folders)),
    )
    return None


class KernelLocator(UserProvidedCacheLocator):
    """The place of a kernel's code: a folder for each version of its source and of all that this imports.

    Numba's own looks at the file of a function alone, and not at the files of the functions that it inlines.
    """

    def __init__(self, function: Any, file: str) -> None:
        super().__init__(function, file)  # type: ignore[no-untyped-call]
        self._digest = _DIGESTS[Path(file).relative_to(_PACKAGE).as_posix()]
        self._cache_path = str(Path(_SETTINGS.CACHE_DIR, self._digest))

    def get_source_stamp(self) -> str:
        """Return what changes when the code in this place would no longer be the function's."""
        return self._digest

    @classmethod
    def from_function(cls, function: Any, file: str) -> Any:
        """Return the place of a function; None for one that is not the package's."""
        is_ours = Path(file).is_relative_to(_PACKAGE) and STORE is not None
        return super().from_function(function, file) if is_ours else None  # type: ignore[no-untyped-call]


_PACKED = "packed"


class _PackedLibrary(codegen.JITCodeLibrary):
    """A stored kernel, whose intermediate code stays packed: only compiling another kernel with it needs that.

    Numba parses it at each load for the names of the functions, which takes half of the service's start, and keeps a
    module of LLVM, which for all kernels takes 90 MB in each process. Here the names are stored beside it.
    """

    _packed: Any

    @property
    def _shared_module(self) -> Any:
        if isinstance(self._packed, bytes):
            self._packed = llvmlite.binding.parse_bitcode(zlib.decompress(self._packed))
        return self._packed

    @_shared_module.setter
    def _shared_module(self, module: Any) -> None:
        self._packed = module

    def serialize_using_object_code(self) -> tuple[str, str, Any]:
        """Return what is stored: the code, the intermediate code, packed, and the names that this defines."""
        name, _, (code, bitcode) = cast(Any, super()).serialize_using_object_code()
        module = cast(Any, self)._get_module_for_linking()
        values = chain(module.functions, module.global_variables)
        names = {value.name for value in values if not value.is_declaration}
        return name, _PACKED, (code, zlib.compress(bitcode), names)

    @classmethod
    def _unserialize(cls, generator: Any, state: Any) -> Any:
        name, kind, data = state
        if kind != _PACKED:
            return cast(Any, super())._unserialize(generator, state)
        code, packed, names = data
        library = generator.create_library(name)
        library.enable_object_caching()
        library._set_compiled_object(code)
        library._shared_module = packed
        library._finalize_final_module()
        generator._engine._defined_symbols |= names
        return library


codegen.JITCPUCodegen._library_class = _PackedLibrary
# Eight doubles from two lines of the cache take twice as long to load as from one.
cpu.CPUContext.get_preferred_array_alignment = lambda *_: 64  # type: ignore[method-assign]
_SETTINGS: Any = numba.config
_PACKAGE = Path(__file__).parents[1]
_DIGESTS = kernel_digests()
STORE = _store()
"""Folder of the compiled kernels; None if no folder is writable."""
_SETTINGS.CACHE_DIR = str(STORE or "")
_SETTINGS.CACHE_LOCATOR_CLASSES = f"{__name__}.KernelLocator,UserProvidedCacheLocator"
_ALL = f"all-{hashlib.sha256(repr(_DIGESTS).encode()).hexdigest()[:16]}"
"""Name of the file that says that each kernel of these versions is there."""
_OPTIONS: dict[str, Any] = {
    "cache": STORE is not None,
    "nogil": True,
    "error_model": "numpy",
    "fastmath": {"contract"},
    # Else that of the first caller: the code, and with it the roundings, would depend on what is called first.
    "forceinline": False,
}
_UNMANAGED: dict[str, Any] = {**_OPTIONS, "_nrt": False}


def is_stored() -> bool:
    """Return whether all kernels have already been compiled for this processor type and only need to be loaded."""
    return STORE is not None and (STORE / _ALL).exists()


def note_stored() -> None:
    """Record that all kernels have been compiled and stored."""
    if STORE is not None:
        with contextlib.suppress(OSError):
            (STORE / _ALL).touch()


_expects_others = False


def expect_others(does: bool) -> None:
    """Set whether another process compiles kernels that this process and its forks may need."""
    global _expects_others  # noqa: PLW0603
    _expects_others = does


def is_awaited() -> bool:
    """Return whether another process is still compiling the kernels; to compile them here too would waste a minute."""
    return _expects_others and not is_stored()


def wait_for_others() -> None:
    """Wait until no other process is still compiling the kernels."""
    while is_awaited():
        time.sleep(0.05)


class _Clock(event.Listener):
    """A clock that stops while any thread compiles, loads compiled code, or waits for another thread to do so."""

    def __init__(self) -> None:
        self._lock, self._depth = threading.Lock(), 0
        self._since = self._seconds = 0.0

    def on_start(self, _: Any) -> None:
        with self._lock:
            if not self._depth:
                self._since = time.monotonic()
            self._depth += 1

    def on_end(self, _: Any) -> None:
        with self._lock:
            self._depth -= 1
            if not self._depth:
                self._seconds += time.monotonic() - self._since

    def now(self) -> float:
        with self._lock:
            return (self._since if self._depth else time.monotonic()) - self._seconds


class _Teller(event.Listener):
    """Calls a function once, when something is compiled and not only loaded."""

    def __init__(self, tell: Callable[[], None]) -> None:
        self._tell, self._has_told = tell, False

    def on_start(self, _: Any) -> None:
        if not self._has_told:
            self._has_told = True
            self._tell()

    def on_end(self, _: Any) -> None:
        pass


_CLOCK = _Clock()
event.register("numba:compiler_lock", _CLOCK)  # type: ignore[no-untyped-call]


def clock() -> float:
    """Return the time [s] like `time.monotonic`, but without time spent compiling; time limits are measured with it."""
    return _CLOCK.now()


@contextlib.contextmanager
def when_compiling(tell: Callable[[], None]) -> Iterator[None]:
    """Call a function when the first kernel is compiled within this context; never if all of them are stored."""
    with event.install_listener("numba:compile", _Teller(tell)):
        yield


def compiled(function: _Function) -> _Function:
    """Compile for this machine at the first call, without the GIL, and cache the code on disk.

    Division follows IEEE 754 as in NumPy, so functions must guard their own denominators. A product and a sum may be
    contracted into one operation with a single rounding; nothing else is reordered.
    """
    return cast(_Function, numba.njit(**_OPTIONS)(function))


def unmanaged(function: _Function) -> _Function:
    """Compile a function that neither creates nor returns arrays, without reference counting of its arguments.

    In a loop over many small functions, the counting costs more than the arithmetic.
    """
    return cast(_Function, numba.njit(**_UNMANAGED)(function))


def inlined(function: _Function) -> _Function:
    """Compile like `unmanaged`, but inline the function into its callers, so that numbers stay in registers."""
    return cast(_Function, numba.njit(**{**_UNMANAGED, "forceinline": True})(function))


def exclusive(function: _Function) -> _Function:
    """Compile like `unmanaged`, but keep the GIL: calls from Python exclude each other and may share memory.

    For a function of a few microseconds, of which letting go of the GIL would take a tenth.
    """
    return cast(_Function, numba.njit(**{**_UNMANAGED, "nogil": False})(function))
