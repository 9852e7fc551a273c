"""Headers of every response. A header that the response already sets is kept: pages have their own policies."""

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
    """Return a response's own headers, further ones, and the common ones that it lacks."""
    headers = list(own)
    return [*headers, *further, *_lacking(tuple([name for name, _ in headers]))]


@lru_cache(256)
def _lacking(names: tuple[bytes, ...]) -> Headers:
    """Return the common headers that are not among `names`; responses have few sets of names."""
    return [header for header in COMMON if header[0] not in {name.lower() for name in names}]
