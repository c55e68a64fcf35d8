"""Work of many tabs takes turns."""

import asyncio
import threading
import time
from itertools import pairwise
from types import SimpleNamespace

import pytest
from lineseg_app.session import turns as turns_module
from lineseg_app.session.turns import MOST_REST, InOrder, Rounds, Turns
from waiting import SECONDS


def test_one_thread_works_at_a_time_and_each_turn_is_followed_by_a_rest():
    turns, spans = Turns(0.25), []

    def work() -> None:
        with turns.turn():
            begun = time.monotonic()
            time.sleep(0.01)
            spans.append((begun, time.monotonic()))

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    spans.sort()
    for (begun, ended), (following, _) in pairwise(spans):
        assert following - ended >= min(2.9 * (ended - begun), MOST_REST)


def test_a_turn_that_fails_ends():
    turns = Turns(0.9)
    for _ in range(2):
        with pytest.raises(ZeroDivisionError), turns.turn():
            raise ZeroDivisionError


def test_a_long_turn_is_followed_by_a_short_rest(monkeypatch: pytest.MonkeyPatch):
    turns, clock, slept = Turns(0.1), [0.0], []
    monkeypatch.setattr(turns_module, "time", SimpleNamespace(monotonic=lambda: clock[0], sleep=slept.append))
    with turns.turn():
        clock[0] = 20.0
    with turns.turn():
        pass
    assert slept == [0.0, MOST_REST]


def test_threads_are_let_in_in_the_order_in_which_they_came():
    gate, came = InOrder(), []

    def work(number: int) -> None:
        with gate:
            came.append(number)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(6)]
    with gate:
        for number, thread in enumerate(threads):
            thread.start()
            while len(gate._waiting) <= number:
                time.sleep(0.001)
    for thread in threads:
        thread.join()
    assert came == list(range(6))
    assert not gate._taken


def test_a_loop_hears_what_arrives_between_the_pieces_of_two_tabs():
    done = list[str]()

    async def tab(name: str, rounds: Rounds) -> None:
        for _ in range(2):
            async with rounds:
                done.append(name)
                asyncio.get_running_loop().call_soon(done.append, "heard")
            await asyncio.sleep(0)

    async def run() -> None:
        rounds = Rounds(asyncio.get_running_loop())
        for name in "abc":
            rounds.start(lambda name=name: tab(name, rounds))
        while len(done) < 12:
            await asyncio.sleep(0)

    asyncio.run(run())
    assert done == [each for name in "abcabc" for each in (name, "heard")]


def test_a_coroutine_is_started_from_another_thread_and_never_in_a_closed_loop():
    ran = threading.Event()

    async def work() -> None:
        ran.set()

    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever)
    thread.start()
    rounds = Rounds(loop)
    rounds.start(work)
    assert ran.wait(SECONDS)
    loop.call_soon_threadsafe(loop.stop)
    thread.join()
    loop.close()
    rounds.start(work)
