"""Headers of every answer. A header already set is kept: pages have their own policies."""

from collections.abc import Iterable
from functools import lru_cache

Headers = list[tuple[bytes, bytes]]

COMMON: Headers = [
    (b"content-security-policy", b"default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-resource-policy", b"same-origin"),
]


def completed(own: Iterable[tuple[bytes, bytes]], further: Headers) -> Headers:
    """An answer's own headers, further ones, and those of the common ones that it lacks."""
    headers = list(own)
    return [*headers, *further, *_lacking(tuple([name for name, _ in headers]))]


@lru_cache(256)
def _lacking(names: tuple[bytes, ...]) -> Headers:
    """The common headers that are not among these names; the answers of the service have few sets of names."""
    return [header for header in COMMON if header[0] not in {name.lower() for name in names}]
