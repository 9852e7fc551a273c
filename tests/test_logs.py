"""The log: JSON lines of printable ASCII, whatever is logged, however fast, whether or not anyone takes it."""

import json
import logging
import logging.config
import threading
import time
from collections.abc import Callable
from io import StringIO
from typing import Any

import pytest

from gelenk.logs import REQUEST_ID, LineHandler, configuration

NASTY = "".join(map(chr, range(0xA1))) + "\u2028\u2029\u202e\ud800é\U0001f600"


def record(message: str, *arguments: object, level: int = logging.INFO, **more: Any) -> logging.LogRecord:
    made = logging.LogRecord("gelenk", level, __file__, 1, message, arguments, more.pop("exc_info", None))
    made.__dict__.update(more)
    return made


def written(*records: logging.LogRecord) -> list[str]:
    stream = StringIO()
    handler = LineHandler(stream)
    for each in records:
        handler.emit(each)
    handler.flush()
    return stream.getvalue().splitlines()


def wait_for(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 60.0
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_a_record_is_a_line_with_its_facts() -> None:
    token = REQUEST_ID.set("abc")
    (line,) = written(record("robot %s", "panda", level=logging.WARNING, facts={"status": 404}))
    REQUEST_ID.reset(token)
    content = json.loads(line)
    assert content.pop("time").endswith("Z")
    assert content == {
        "level": "warning",
        "logger": "gelenk",
        "message": "robot panda",
        "request_id": "abc",
        "status": 404,
    }


def test_whatever_is_logged_is_printable_and_comes_back() -> None:
    try:
        raise RuntimeError(NASTY)
    except RuntimeError as error:
        told = (type(error), error, error.__traceback__)
    stream = StringIO()
    handler = LineHandler(stream)
    handler.emit(record("at %s", NASTY, facts={"path": NASTY, "deep": [NASTY]}, exc_info=told))
    handler.flush()
    text = stream.getvalue()
    assert text.count("\n") == 1
    assert all(" " <= character <= "~" for character in text[:-1])
    content = json.loads(text)
    assert content["message"] == f"at {NASTY}"
    assert content["path"] == NASTY
    assert "RuntimeError: " in content["exception"]


def test_a_long_text_is_cut() -> None:
    (line,) = written(record("%s", "x" * 10_000_000))
    assert len(line) < 20_000


def test_lines_come_by_themselves_and_in_order() -> None:
    stream = StringIO()
    handler = LineHandler(stream)
    for i in range(1000):
        handler.emit(record("%d", i))
    wait_for(lambda: stream.getvalue().count("\n") == 1000)
    assert [json.loads(line)["message"] for line in stream.getvalue().splitlines()] == [str(i) for i in range(1000)]


class Blocked(StringIO):
    """A stream that nobody reads from until it is let go."""

    def __init__(self) -> None:
        super().__init__()
        self.is_asked, self.let_go = threading.Event(), threading.Event()

    def write(self, text: str) -> int:
        self.is_asked.set()
        assert self.let_go.wait(60.0)
        return super().write(text)


def test_a_slow_reader_holds_up_nobody_and_what_is_lost_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.logs._MOST_WAITING", 50)
    stream = Blocked()
    handler = LineHandler(stream)
    handler.emit(record("first"))
    assert stream.is_asked.wait(60.0)
    for i in range(80):
        handler.emit(record("%d", i))
    assert stream.getvalue() == "", "nobody has waited for it"
    stream.let_go.set()
    handler.flush()
    lines = [json.loads(line)["message"] for line in stream.getvalue().splitlines()]
    assert lines == ["first", *(str(i) for i in range(50)), "30 lines were left out"]


def test_a_closed_stream_costs_the_lines_alone() -> None:
    stream = StringIO()
    handler = LineHandler(stream)
    stream.close()
    for _ in range(3):
        handler.emit(record("nobody listens"))
        wait_for(lambda: not handler._waiting)
    assert handler._thread is not None
    assert handler._thread.is_alive()


@pytest.mark.parametrize(("level", "expected"), [("info", ["info", "error"]), ("error", ["error"])])
def test_the_level_is_that_of_the_settings(level: str, expected: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    root, ours = logging.getLogger(), logging.getLogger("gelenk")
    before = root.handlers[:], root.level, ours.level
    try:
        logging.config.dictConfig(configuration(level))
        ours.info("quiet")
        ours.error("loud")
        root.handlers[0].flush()
    finally:
        root.handlers[:], _, _ = before
        root.setLevel(before[1])
        ours.setLevel(before[2])
    assert [json.loads(line)["level"] for line in capsys.readouterr().err.splitlines()] == expected
