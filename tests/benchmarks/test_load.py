"""The load benchmark, short: what it tells is told of a real crowd, and nothing breaks under it."""

import shutil

import pytest

from tests.benchmarks.load import FK, TRAJECTORY, Call, loaded, serving, slow_sockets

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(shutil.which("wrk") is None, reason="wrk is needed: apt-get install wrk"),
]


def test_a_crowd_gets_its_answers_and_too_large_a_crowd_gets_some() -> None:
    with serving(GELENK_CREW_WAITING="20", GELENK_REQUESTS_WAITING="40") as (url, pid):
        few, seen, growth = loaded(url, pid, Call(*FK), 20, 3.0)
        assert few.requests > 100
        assert (few.refused, few.broken, few.timeouts, seen.other) == (0, 0, 0, [])
        assert growth < 0.2
        assert seen.accepted
        assert seen.healthy
        assert not seen.refused
        for call in (Call(*FK), Call(*TRAJECTORY)):
            many, seen, _ = loaded(url, pid, call, 400, 4.0)
            assert many.requests > many.refused > 0
            assert (many.broken, many.timeouts, seen.other) == (0, 0, [])
            assert seen.healthy
        with slow_sockets(url, 300):
            few, seen, _ = loaded(url, pid, Call(*FK), 20, 3.0)
        assert few.requests > 100
        assert (few.refused, few.broken, few.timeouts, seen.other) == (0, 0, 0, [])
