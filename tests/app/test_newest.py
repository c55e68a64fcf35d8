"""Newest wins: a newer piece of work replaces the one that waits, and the last is always done."""

import threading
import time

import pytest
from lineseg_app.newest import Newest
from waiting import SECONDS, eventually


class Bench:
    """Work that takes until it is let go."""

    def __init__(self):
        self.begun, self.done = [], []
        self.go, self.started = threading.Event(), threading.Event()
        self.newest = Newest("bench", self._work)

    def _work(self, piece):
        self.begun.append(piece)
        self.started.set()
        assert self.go.wait(SECONDS)
        self.done.append(piece)

    def until_done(self, number):
        eventually(lambda: len(self.done) == number, f"{number} pieces to be done", lambda: self.done)


@pytest.fixture
def bench():
    bench = Bench()
    yield bench
    bench.go.set()
    bench.newest.close()


def test_what_waits_is_replaced_and_the_last_is_done(bench):
    bench.newest.put("first")
    assert bench.started.wait(SECONDS)
    for piece in ("second", "third", "last"):
        bench.newest.put(piece)
    bench.go.set()
    bench.until_done(2)
    assert bench.done == ["first", "last"]


def test_a_piece_that_is_due_later_waits_and_gives_way_to_a_newer_one(bench):
    bench.go.set()
    bench.newest.put("late", due=time.monotonic() + 10 * SECONDS)
    bench.newest.put("now")
    bench.until_done(1)
    assert bench.done == ["now"]


def test_a_piece_is_not_begun_before_it_is_due(bench):
    bench.go.set()
    due = time.monotonic() + 0.05
    bench.newest.put("piece", due=due)
    bench.until_done(1)
    assert time.monotonic() >= due


def test_what_waits_can_be_dropped(bench):
    bench.newest.put("first")
    assert bench.started.wait(SECONDS)
    bench.newest.put("second")
    bench.newest.drop()
    bench.newest.put("third")
    bench.go.set()
    bench.until_done(2)
    assert bench.begun == ["first", "third"]


def test_closing_waits_for_what_is_under_way_and_forgets_the_rest(bench):
    bench.newest.put("first")
    assert bench.started.wait(SECONDS)
    bench.newest.put("second")
    threading.Timer(0.05, bench.go.set).start()
    bench.newest.close()
    assert bench.done == ["first"]
    bench.newest.put("third")
    assert bench.begun == ["first"]


def test_a_place_where_nothing_was_put_closes_at_once():
    Newest("idle", lambda piece: None).close()
