"""The request log and the audit log of writes."""

import logging
import os
import threading
import time
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from gelenk.errors import StorageFailed
from gelenk.http.access.request_context import RequestContext
from gelenk.logs import line, moment
from gelenk.store import folders

_LONGEST_PATH = 256
_BUSY = 503
_LEFT = 499
"""Status logged if the client disconnected before the response."""

_MOST_CLIENTS = 8
"""Maximum number of client addresses in a line that sums up refusals."""

requests = logging.getLogger("gelenk.requests")
logger = logging.getLogger("gelenk")


def log_request(exchange: RequestContext) -> None:
    """Log a finished request: failures of the service as errors, refusals as warnings, the rest as information.

    A busy service (503) counts as information: it would be logged often, and the metrics count it.
    """
    if exchange.status >= 500 and exchange.status != _BUSY:
        level = logging.ERROR
    else:
        level = logging.INFO if exchange.was_let_in else logging.WARNING
    if requests.isEnabledFor(level):
        facts = _facts(exchange) | {"seconds": round(exchange.seconds, 6)}
        requests.log(level, "request", extra={"facts": facts})


def _facts(exchange: RequestContext) -> dict[str, Any]:
    return {
        "request_id": exchange.request_id,
        "key": exchange.key or None,
        "client": exchange.client,
        "method": exchange.scope["method"],
        "path": exchange.scope["path"][:_LONGEST_PATH],
        "operation": exchange.operation.id,
        "status": exchange.status or _LEFT,
    }


class AuditLog:
    """Audit log in a folder that all processes share: a line for each request that stores or removes something.

    A line is on disk before the write is acknowledged. Refusals of valid keys are summed up, and requests without a
    valid key appear only in the request log, so that callers cannot flood this file.
    A file of `most_bytes` becomes `audit.1.jsonl`, the one before that `audit.2.jsonl`; `kept` of them remain. Refused
    writes are summed up for `sum_seconds` after the first one, [s]. The first write creates the folder.
    """

    def __init__(
        self, folder: Path, most_bytes: int = 16 * 1024 * 1024, kept: int = 4, sum_seconds: float = 3600.0
    ) -> None:
        self._folder, self._most_bytes, self._kept, self._sum_seconds = folder, most_bytes, kept, sum_seconds
        self._refusals: dict[str, _Refusals] = {}
        self._lock = threading.Lock()

    def write(self, exchange: RequestContext, location: str | None) -> None:
        """Append a line, with the response's `Location`, or count a refusal; what the disk refuses goes to the log."""
        facts = _facts(exchange) | {"location": location}
        if exchange.was_let_in:
            self._append(facts)
            return
        with self._lock:
            if not self._refusals:
                timer = threading.Timer(self._sum_seconds, self.close)
                timer.daemon = True
                timer.start()
            is_first = exchange.key not in self._refusals
            refusals = self._refusals.setdefault(exchange.key, _Refusals())
            refusals.add(facts)
            entry = refusals.summed() if is_first else None
        if entry is not None:
            self._append(entry)

    def close(self) -> None:
        """Write lines for the refusals counted since the last ones."""
        with self._lock:
            entries = [refusals.summed() for refusals in self._refusals.values() if refusals.count]
            self._refusals.clear()
        for entry in entries:
            self._append(entry)

    def _append(self, facts: dict[str, Any]) -> None:
        entry = {"time": moment(time.time())} | facts
        content = (line(entry) + "\n").encode("ascii")
        try:
            with folders.exclusive(self._folder), folders.writing():
                self._make_room(len(content))
                with open(self._folder / "audit.jsonl", "ab", opener=partial(os.open, mode=0o600)) as stream:
                    stream.write(content)
                    stream.flush()
                    os.fsync(stream.fileno())
        except StorageFailed as error:
            logger.error("the audit log cannot be written: %s", error.reason, extra={"facts": entry})

    def _make_room(self, more: int) -> None:
        current = self._folder / "audit.jsonl"
        if not current.exists() or current.stat().st_size + more <= self._most_bytes:
            return
        files = [current, *(self._folder / f"audit.{i}.jsonl" for i in range(1, self._kept + 1))]
        for older, newer in zip(reversed(files), reversed(files[:-1]), strict=False):
            if newer.exists():
                newer.replace(older)


@dataclass(slots=True)
class _Refusals:
    """Writes refused to one key since its last line in the audit log, which sums them up.

    `last` is the entry of the last one, `since` the time of the first, [s] since 1970; `clients` are some addresses.
    """

    count: int = 0
    last: dict[str, Any] = field(default_factory=dict)
    since: float = 0.0
    clients: set[str] = field(default_factory=set)

    def add(self, facts: dict[str, Any]) -> None:
        self.since = self.since if self.count else time.time()
        self.count, self.last = self.count + 1, facts
        if len(self.clients) < _MOST_CLIENTS:
            self.clients.add(facts["client"])

    def summed(self) -> dict[str, Any]:
        """Return the entry that sums up the refusals, and restart the count."""
        entry = self.last | {"refused": self.count, "since": moment(self.since), "clients": sorted(self.clients)}
        self.count, self.clients = 0, set()
        return entry
