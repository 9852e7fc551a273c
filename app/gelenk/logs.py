"""The log: one JSON object per line on standard error, only printable ASCII, written by a separate thread.

Logging only queues a record, so a slow reader of the log blocks nothing. If lines come faster than they are read, some
are left out, and the log says how many.
"""

import json
import logging
import sys
import threading
from collections import deque
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Any, TextIO

LEVELS = ("debug", "info", "warning", "error")
REQUEST_ID: ContextVar[str] = ContextVar("request_id", default="")
"""Id of the request that is being answered; records logged meanwhile carry it."""

_MOST_WAITING = 10_000
_GATHER_SECONDS = 0.1
"""How long lines are collected before they are written together, [s]."""
_LONGEST = 16_384
"""Maximum number of characters of one text in a line; a traceback may be long."""


def configuration(level: str, at_once: bool = False) -> dict[str, Any]:
    """Return the configuration for `logging.config` and the server; see `LEVELS`, and `LineHandler` for `at_once`."""
    return {
        "version": 1,
        "disable_existing_loggers": False,
        "handlers": {"lines": {"()": "gelenk.logs.LineHandler", "at_once": at_once}},
        "loggers": {name: {"level": level.upper()} for name in ("gelenk", "uvicorn")},
        "root": {"handlers": ["lines"], "level": "WARNING"},
    }


def line(content: dict[str, Any]) -> str:
    """Return a JSON object as one line of printable ASCII."""
    return json.dumps({key: _bounded(value) for key, value in content.items()}, default=str).replace("\x7f", "\\u007f")


def moment(seconds: float) -> str:
    """Return a time as the logs write it: UTC, milliseconds."""
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


class LineHandler(logging.Handler):
    """Writes records as lines, soon and several together; to the current standard error stream if none is given.

    With `at_once` the caller writes the line, without a thread: for a process that is copied or may be killed.
    """

    def __init__(self, stream: TextIO | None = None, at_once: bool = False) -> None:
        super().__init__()
        self._stream, self._at_once = stream, at_once
        self._waiting: deque[logging.LogRecord] = deque()
        self._lost = 0
        self._woken = threading.Event()
        self._writing = threading.Lock()
        self._thread: threading.Thread | None = None

    def emit(self, record: logging.LogRecord) -> None:
        """Queue a record; the caller does not wait."""
        if len(self._waiting) >= _MOST_WAITING:
            self._lost += 1
            return
        record.request_id = REQUEST_ID.get()
        record.message = record.getMessage()
        self._waiting.append(record)
        if self._at_once:
            self._flush_if_taken()
            return
        if self._thread is None:
            self._thread = threading.Thread(target=self._write_on, name="log", daemon=True)
            self._thread.start()
        if not self._woken.is_set():
            self._woken.set()

    def flush(self) -> None:
        """Write all queued records now."""
        with self._writing:
            lines = []
            while self._waiting:
                lines.append(_line_of(self._waiting.popleft()))
            if self._lost:
                lost = "1 line was" if self._lost == 1 else f"{self._lost} lines were"
                lines.append(line({"level": "warning", "message": f"{lost} left out"}))
                self._lost = 0
            if lines:
                stream = self._stream or sys.stderr
                stream.write("\n".join(lines) + "\n")
                stream.flush()

    def _write_on(self) -> None:
        pause = threading.Event()
        while True:
            self._woken.wait()
            pause.wait(_GATHER_SECONDS)
            self._woken.clear()
            self._flush_if_taken()

    def _flush_if_taken(self) -> None:
        try:
            self.flush()
        except (OSError, ValueError):
            self._waiting.clear()  # the log has no reader any more


def _line_of(record: logging.LogRecord) -> str:
    content: dict[str, Any] = {
        "time": moment(record.created),
        "level": record.levelname.lower(),
        "logger": record.name,
        "message": record.message,
    }
    if request_id := getattr(record, "request_id", ""):
        content["request_id"] = request_id
    content.update(getattr(record, "facts", {}))
    if record.exc_info:
        content["exception"] = logging.Formatter().formatException(record.exc_info)
    return line(content)


def _bounded(value: Any) -> Any:
    return value[:_LONGEST] if isinstance(value, str) else value
