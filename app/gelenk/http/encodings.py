"""What a client says that it takes compressed, and what it has already."""

import re


def accepts(accepted: str, coding: str) -> bool:
    """Whether an `Accept-Encoding` names a coding such as gzip, with a weight above zero (RFC 9110)."""
    named = rf"(^|,){coding}(;q=(?!0(\.0*)?(,|$))|,|$)"
    return re.search(named, re.sub(r"\s", "", accepted.lower())) is not None


def is_known(etag: str, if_none_match: str) -> bool:
    """Whether an `If-None-Match` names an `ETag`, by the weak comparison that it calls for (RFC 9110)."""
    named = [tag.strip().removeprefix("W/") for tag in if_none_match.split(",")]
    return named == ["*"] or etag.removeprefix("W/") in named
