"""Turns go round the clients, and places are shared, whoever comes and goes in whatever order."""

from collections import Counter
from random import Random

import pytest

from gelenk.processes import turns
from gelenk.processes.turns import Turns

CLIENTS = "abcd"


class Clock:
    """A clock that stands still."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 1000.0
        monkeypatch.setattr(turns, "time", self)

    def monotonic(self) -> float:
        return self.now


def test_one_client_s_turns_come_in_their_order() -> None:
    queue: Turns[int] = Turns(1)
    for number in range(5):
        queue.add("a", number)
    order = []
    while (found := queue.take()) is not None:
        order.append(found[1])
        queue.give_back("a")
    assert order == list(range(5))


@pytest.mark.parametrize("seed", range(30))
def test_between_two_turns_of_a_client_each_other_that_waits_has_one(seed: int) -> None:
    """With one place, for any interleaving of those who come, leave, and have their turn."""
    random, queue = Random(seed), Turns[int](1)
    waiting: dict[str, list[int]] = {client: [] for client in CLIENTS}
    since: dict[str, Counter[str]] = {client: Counter() for client in CLIENTS}
    for number in range(400):
        client = random.choice(CLIENTS)
        if random.random() < 0.6:
            if not waiting[client]:
                since[client].clear()
            queue.add(client, number)
            waiting[client].append(number)
        elif random.random() < 0.2 and waiting[client]:
            gone = waiting[client].pop(random.randrange(len(waiting[client])))
            assert queue.remove(client, gone)
            assert not queue.remove(client, gone)
        elif (found := queue.take()) is not None:
            assert found[1] == waiting[found[0]].pop(0)
            queue.give_back(found[0])
            for other in set(CLIENTS) - {found[0]}:
                since[other][found[0]] += 1
                assert not waiting[other] or since[other][found[0]] == 1, "it had two turns while another one waited"
            since[found[0]].clear()
        assert len(queue) == sum(map(len, waiting.values())) == len(list(queue))


@pytest.mark.parametrize("size", [1, 2, 3, 8])
@pytest.mark.parametrize("seed", range(10))
def test_nobody_is_given_more_than_half_while_others_wait(
    size: int, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And who has no place gets one at once, up to half as many beyond their number."""
    clock, random, queue = Clock(monkeypatch), Random(seed), Turns[int](size)
    half, held, waiting = max(1, size // 2), Counter[str](), Counter[str]()
    for number in range(400):
        client = random.choice(CLIENTS)
        clock.now += random.choice([0.0, 0.1, 3.0])
        if random.random() < 0.6:
            queue.add(client, number)
            waiting[client] += 1
        elif held[client]:
            queue.give_back(client)
            held[client] -= 1
        while (found := queue.take()) is not None:
            one = found[0]
            held[one] += 1
            waiting[one] -= 1
            assert held[one] <= half or not any(waiting[other] for other in CLIENTS if other != one)
            assert held[one] <= size
        assert held.total() <= size + half
        if held.total() < size + half:
            assert not any(waiting[one] and not held[one] for one in CLIENTS)
        if held.total() < size:
            assert not any(waiting[one] and held[one] < half for one in CLIENTS), "a place is left to nobody"


def test_a_client_alone_has_all_places_and_keeps_one_free_for_others(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, queue = Clock(monkeypatch), Turns[int](4)
    for number in range(9):
        queue.add("heavy", number)
    assert [queue.take() for _ in range(5)] == [*(("heavy", number) for number in range(4)), None]
    queue.add("light", 0)
    assert queue.is_beyond("light")
    assert queue.take() == ("light", 0)
    for client in ("light", "heavy"):
        queue.give_back(client)
    assert queue.take() is None, "one is left for who may come again"
    queue.add("light", 1)
    assert not queue.is_beyond("light")
    assert queue.take() == ("light", 1)
    queue.give_back("light")
    clock.now += 10.0
    assert queue.take() == ("heavy", 4), "nobody else is there any more"
