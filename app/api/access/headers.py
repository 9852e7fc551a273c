"""What every answer carries. A header that an answer has of its own stands: pages have policies of their own."""

from collections.abc import Iterable

Headers = list[tuple[bytes, bytes]]

COMMON: Headers = [
    (b"content-security-policy", b"default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-resource-policy", b"same-origin"),
]


def completed(own: Iterable[tuple[bytes, bytes]], further: Headers) -> Headers:
    """An answer's own headers, and those of the common and further ones that it lacks."""
    headers = list(own)
    names = {name.lower() for name, _ in headers}
    headers += [header for header in further if header[0] not in names]
    headers += [header for header in COMMON if header[0] not in names]
    return headers
