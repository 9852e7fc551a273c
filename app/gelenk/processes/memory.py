"""Memory that a process keeps for its next request."""

import ctypes

KEPT_BYTES = 64 * 1024 * 1024
"""Free memory at the end of the heap that stays with the process, [bytes]."""
_LARGEST_BYTES = 32 * 1024 * 1024
"""Size from which a block is memory of its own, which always goes back; the C library allows no larger one, [bytes]."""
_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
"""Names of these settings in `malloc.h`."""


def keep_freed_memory() -> None:
    """Let the C library keep freed memory, up to `KEPT_BYTES`, where it has a setting for that.

    Otherwise each large array comes as fresh pages, which the system clears one by one: a quarter of the time that the
    poses of a large batch take.
    """
    set_option = getattr(ctypes.CDLL(None), "mallopt", None)
    if set_option is not None:
        set_option(_TRIM_THRESHOLD, KEPT_BYTES)
        set_option(_MMAP_THRESHOLD, _LARGEST_BYTES)
