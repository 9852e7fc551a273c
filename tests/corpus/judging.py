"""What every refusal must be, whoever sent what: a small problem with the right verdict that does not echo."""

import json
from collections.abc import Iterable

MAX_PROBLEM_BYTES = 16 * 1024
MAX_SECONDS = 2.0
"""Of processor time, for a request of whatever kind."""
_ECHO = 256
"""Bytes of a payload that no answer repeats: a name that is quoted is shorter."""
_SEARCHED = 1_000_000
_PROBLEM = {"type", "title", "status", "detail", "instance"}


def complaints(
    sent: bytes, statuses: Iterable[int], mentions: Iterable[str], status: int, media_type: str | None, content: bytes
) -> list[str]:
    """What is wrong with an answer; nothing where it is right.

    Args:
        sent: The body of the request.
        statuses: Those that are right.
        mentions: Lower-case words that a problem has to contain.
        status: The answer's.
        media_type: The answer's.
        content: The answer's body.
    """
    found = [] if status in set(statuses) else [f"status {status}: {content[:300]!r}"]
    if status >= 500 and not found:
        found.append(f"status {status}")
    if status < 400:
        return found
    if media_type != "application/problem+json":
        return [*found, f"media type {media_type}"]
    problem = json.loads(content)
    if not set(problem) >= _PROBLEM or problem["status"] != status:
        found.append(f"no problem: {sorted(problem)}")
    if not problem.get("detail", "\0").isprintable():
        found.append(f"not printable: {problem.get('detail')!r}")
    if len(content) >= MAX_PROBLEM_BYTES:
        found.append(f"{len(content)} bytes")
    if _echoes(sent, content):
        found.append("it echoes the payload")
    missing = [word for word in mentions if word not in json.dumps(problem, ensure_ascii=False).lower()]
    if missing and not found:
        found.append(f"it does not mention {missing}: {problem['detail']}")
    return found


def _echoes(sent: bytes, content: bytes) -> bool:
    """Whether an answer repeats a long piece of what was sent."""
    pieces = (sent[i : i + _ECHO] for i in range(0, min(len(sent), _SEARCHED) - _ECHO, _ECHO))
    return any(piece in content for piece in pieces)
