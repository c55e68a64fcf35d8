"""Scans that arrive faster than their segments can be published: the newest wins, and the others are counted."""

from __future__ import annotations

import re
import threading
import time

import pytest
from lineseg_app.bridges.address import Address
from lineseg_app.bridges.arrivals import arrivals
from lineseg_app.live.source import Spent
from lineseg_app.node.latency import latency
from lineseg_app.node.running import Running
from live import connect
from obeying import running, said
from robots import wall
from rosbridge_peer import RosBridgePeer, scan_message
from waiting import SECONDS, eventually
from websockets.sync.server import serve

from lineseg import Params


def test_messages_that_wait_come_together_and_in_order():
    sent = threading.Event()

    def send(socket):
        for number in range(12):
            socket.send(str(number))
        sent.set()

    with serve(send, "127.0.0.1", 0, open_timeout=SECONDS) as server:
        threading.Thread(target=server.serve_forever).start()
        with connect(f"ws://127.0.0.1:{server.socket.getsockname()[1]}") as socket:
            assert sent.wait(SECONDS)
            eventually(lambda: socket.recv_messages.frames.qsize() == 12, "all messages to wait")
            ((_, waiting),) = arrivals(socket)
        server.shutdown()
    assert waiting == [str(number) for number in range(12)]


def test_a_node_on_a_websocket_that_falls_behind_publishes_the_newest_scan_and_counts_the_others():
    peer, went_on, scans = RosBridgePeer(), threading.Event(), 12
    present = Running("region-growing", Params(), lambda: went_on.wait(SECONDS) and None)
    with running(Address(peer.url, "/scan"), "/scan", present) as told:
        assert peer.subscribed.wait(SECONDS)
        for second in range(scans):
            peer.publish("/scan", scan_message(wall(2.0), second))
        peer.wait_until_heard()
        went_on.set()
        seconds: list[int] = []
        while seconds[-1:] != [scans - 1]:
            _, message = peer.received.get(timeout=SECONDS)
            if "width" in message:  # the cloud, which is sent last
                seconds.append(message["header"]["stamp"]["sec"])
    peer.close()
    assert len(seconds) < scans
    assert re.match(rf"ended after {len(seconds)} scans?, {scans - len(seconds)} left out; published in ", told[-1])


def test_a_node_whose_scans_stop_says_so_long_before_the_connection_ends():
    peer = RosBridgePeer()
    with running(Address(peer.url, "/scan"), "/scan") as told:
        assert peer.subscribed.wait(SECONDS)
        peer.publish("/scan", scan_message(wall(2.0)))
        said(told, "no scan for 2 s; is its publisher still running?")
    peer.close()


def test_messages_that_are_no_scans_are_told_once_a_second_and_counted():
    peer = RosBridgePeer()
    with running(Address(peer.url, "/scan"), "/scan") as told:
        assert peer.subscribed.wait(SECONDS)
        begun = time.monotonic()
        for number in range(40):
            peer.publish("/scan", {"ranges": [1.0], "angle_min": f"wrong {number}"})
            peer.publish("/scan", scan_message(wall(2.0)))
            time.sleep(0.02)
        said(told, ", 40 refused")
        took = time.monotonic() - begun
    peer.close()
    assert 1 <= sum("is not a scan: angle_min is 'wrong" in line for line in told) <= 1 + took


@pytest.mark.parametrize(
    ("spent", "words"),
    [
        ([Spent(None, 0.001)] * 3, "published in 1.0 ms (95 %: 1.0 ms)"),
        ([Spent(0.0004, 0.001 * n) for n in range(101)], "delay 0.4 ms, published in 50.0 ms (95 %: 95.0 ms)"),
        ([Spent(-2.0, 0.5)], "delay -2000 ms, published in 500 ms (95 %: 500 ms)"),
    ],
)
def test_times_are_told_as_medians_and_what_95_percent_stay_within(spent: list[Spent], words: str):
    assert latency(spent) == words
    assert re.fullmatch(r"[ -~]+", words)
