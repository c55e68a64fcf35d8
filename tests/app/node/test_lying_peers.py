"""Servers that lie: a node says in a sentence what they sent, goes on, and ends when it is told to."""

from __future__ import annotations

import contextlib
import gc
import json
import os
import socketserver
import struct
import threading
import time
import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from lineseg_app.bridges.address import Address
from lineseg_app.bridges.arrivals import arrivals
from lineseg_app.bridges.bridge import LARGEST_MESSAGE, why_not
from lineseg_app.bridges.foxglove import MOST_BYTES
from lineseg_app.bridges.node_params import send_params
from lineseg_app.bridges.rosbridge import RobotError, RosBridge
from lineseg_app.bridges.websocket import connected
from lineseg_app.live.source import Publishing
from lineseg_app.node import offers
from lineseg_app.node.node import OWNER, Node
from lineseg_app.node.offers import Offer, send_to_node
from lineseg_app.node.running import Running
from obeying import running, said
from robots import wall
from rosbridge_peer import scan_message
from waiting import SECONDS, eventually
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import ServerConnection, serve
from websockets.typing import Subprotocol

from lineseg import Params
from lineseg.readers.laser_scan import decode_cdr

SCAN = "sensor_msgs/msg/LaserScan"
RUNNING = Running("region-growing", Params())
CDR = bytes([0, 1, 0, 0])
HEADER = CDR + struct.pack("<iII", 1, 2, 6) + b"laser\0\0\0"
CHANNEL = {"id": 1, "topic": "/scan", "encoding": "cdr", "schemaName": SCAN, "schema": ""}


@contextmanager
def lying(talk: Callable[[ServerConnection], Any], foxglove: bool) -> Iterator[tuple[Address, threading.Event]]:
    """A server that says what `talk` says to each connection, and keeps it open until the event."""
    over = threading.Event()

    def serve_one(socket: ServerConnection) -> None:
        try:
            talk(socket)
            over.wait(SECONDS)
        except ConnectionClosed:
            pass

    protocols = [Subprotocol("foxglove.sdk.v1")] if foxglove else None
    limits = {"max_size": None, "open_timeout": SECONDS, "ping_interval": None}
    with serve(serve_one, "127.0.0.1", 0, subprotocols=protocols, **limits) as server:
        threading.Thread(target=server.serve_forever).start()
        yield Address(f"ws://127.0.0.1:{server.socket.getsockname()[1]}", "/scan"), over
        over.set()
        server.shutdown()


def heard(socket: ServerConnection, op: str) -> dict[str, Any]:
    while True:
        message = json.loads(socket.recv(timeout=SECONDS))
        if message["op"] == op:
            return message


def says(**message: Any) -> Callable[[ServerConnection], None]:
    return lambda socket: socket.send(json.dumps(message))


def lists(topics: Any, types: Any) -> Callable[[ServerConnection], None]:
    """Answers rosapi with these values."""

    def talk(socket: ServerConnection) -> None:
        answer = {"op": "service_response", "result": True, "values": {"topics": topics, "types": types}}
        socket.send(json.dumps(answer | {"id": heard(socket, "call_service")["id"]}))

    return talk


def scans(*messages: bytes) -> Callable[[ServerConnection], None]:
    """Foxglove messages of a channel of laser scans."""

    def talk(socket: ServerConnection) -> None:
        socket.send(json.dumps({"op": "advertise", "channels": [CHANNEL]}))
        heard(socket, "subscribe")
        for message in messages:
            socket.send(struct.pack("<BIQ", 1, 1, 0) + message)

    return talk


@pytest.mark.parametrize(
    ("talk", "sentence"),
    [
        (lists(3, [1]), "the robot has no topic /scan; its laser topics: none"),
        (lists([[1], {}, "/scan"], [SCAN, {}, 3]), "/scan is of no type; choose a sensor_msgs/LaserScan topic"),
        (lambda socket: socket.send("x" * (LARGEST_MESSAGE + 1)), "sent a message of more than 4 MB"),
        (lambda socket: socket.send(b"\xff" * 9, text=True), "sent a message that is not one of WebSocket"),
    ],
)
def test_what_a_rosbridge_sends_is_told_in_a_sentence(talk: Any, sentence: str, caplog: pytest.LogCaptureFixture):
    with lying(talk, foxglove=False) as (address, _), running(address, "/scan") as told:
        said(told, sentence)
    assert not caplog.records


@pytest.mark.parametrize(
    ("talk", "sentence"),
    [
        (lambda socket: socket.send("nonsense"), "sends messages that are not those of Foxglove"),
        (lambda socket: socket.send("[" * 100_000), "sends messages that are not those of Foxglove"),
        (says(op="advertise", channels=3), "has no topic /scan yet; it has no topic at all"),
        (says(op="advertise", channels=[3, {}, CHANNEL | {"id": [1]}, CHANNEL | {"topic": 1}]), "it has no topic"),
        (says(op="unadvertise", channelIds=[{}, 3]), "it has no topic at all"),
        (scans(b""), "/scan is not a scan: its 0 bytes end in the middle of a LaserScan"),
        (scans(HEADER[:9]), "its 9 bytes end in the middle of a LaserScan"),
        (scans(HEADER + struct.pack("<7fI", 0, 1, 0.1, 0, 0, 0, 9, 10**9)), "announces 1000000000 ranges"),
    ],
)
def test_what_a_foxglove_server_sends_is_told_in_a_sentence(talk: Any, sentence: str, caplog: pytest.LogCaptureFixture):
    with lying(talk, foxglove=True) as (address, _), running(address, "/scan") as told:
        said(told, sentence)
    assert not caplog.records


@pytest.mark.parametrize("offered", [{"capabilities": 3, "supportedEncodings": 7}, {"supportedEncodings": [{}, 3]}])
def test_a_foxglove_server_that_describes_itself_wrongly_accepts_no_messages(offered: dict[str, Any]):
    def talk(socket: ServerConnection) -> None:
        socket.send(json.dumps({"op": "serverInfo", "capabilities": ["clientPublish"]} | offered))
        scans(HEADER + struct.pack("<7f4I", -1, 1, 0.5, 0, 0, 0, 9, 2, 0, 0, 0))(socket)

    refused = pytest.raises(ValueError, match=r"the robot accepts (no messages|messages as)")
    with lying(talk, foxglove=True) as (address, _), refused:
        Node(address, Publishing(OWNER, "/walls", "region-growing", Params()), RUNNING, [].append).run()


def test_a_node_ends_in_the_middle_of_a_flood_of_scans():
    flood = json.dumps({"op": "publish", "topic": "/scan", "msg": scan_message(wall(2.0))})

    def talk(socket: ServerConnection) -> None:
        lists(["/scan"], [SCAN])(socket)
        heard(socket, "subscribe")
        while True:
            socket.send(flood)

    # At its end it waits for the node, into which scans flood on.
    with lying(talk, foxglove=False) as (address, _), running(address, "/scan") as told:
        said(told, " left out")


def test_a_robot_that_takes_nothing_is_given_up():
    with lying(lambda socket: None, foxglove=False) as (address, _), connected(address.url) as socket:
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                socket.send(os.urandom(1_000_000))
        assert why_not("robot", closed.value) == "robot takes no messages any more"


def test_an_answer_is_not_waited_for_longer_because_other_messages_come():
    def talk(socket: ServerConnection) -> None:
        while True:
            says(op="other")(socket)

    with lying(talk, foxglove=False) as (address, _), connected(address.url) as socket, pytest.raises(TimeoutError):
        RosBridge(socket).call("/rosapi/topics", {}, seconds=0.2)


def test_messages_that_wait_are_taken_together_up_to_a_number_of_bytes():
    size = LARGEST_MESSAGE // 4
    twelve = lying(lambda socket: [socket.send("x" * size) for _ in range(12)], foxglove=False)
    with twelve as (address, over), connected(address.url) as socket:
        eventually(lambda: socket.recv_messages.frames.qsize() == 12, "twelve messages")
        over.set()
        assert [len(waiting) for _, waiting in arrivals(socket)] == [4, 4, 4]


def test_a_name_of_a_frame_takes_no_more_memory_than_a_name():
    name = b"x" * 1_000_000
    message = CDR + struct.pack("<iII", 1, 2, len(name)) + name + struct.pack("<7f3I", -1, 1, 0.5, 0, 0, 0, 9, 1, 0, 0)
    assert decode_cdr(message).frame_id == "x" * 200


def test_of_a_foxglove_server_only_schemas_of_scans_are_kept_and_no_name_without_bound():
    def talk(socket: ServerConnection) -> None:
        for id, name in enumerate(["std_msgs/msg/String"] * 9 + [SCAN] * 9, 2):
            channel = CHANNEL | {"id": id, "topic": f"/{id}", "schemaName": name, "schema": "x" * 3_000_000}
            says(op="advertise", channels=[channel])(socket)
            long = channel | {"id": 100 + id, "topic": "/" + "x" * 3_000_000, "schemaName": "std_msgs/msg/String"}
            says(op="advertise", channels=[long | {"schema": ""}])(socket)
        says(op="advertise", channels=[CHANNEL])(socket)

    tracemalloc.start()
    with lying(talk, foxglove=True) as (address, _), running(address, "/scan") as told:
        said(told, "subscribed to /scan; waiting for its first scan")

        def held() -> int:
            gc.collect()
            return tracemalloc.get_traced_memory()[0]

        # The peer is in this process, too, and what it sends is let go of a moment later.
        eventually(lambda: held() < 2 * MOST_BYTES, f"less than {2 * MOST_BYTES} bytes to be held", held)
    tracemalloc.stop()


@pytest.mark.parametrize("answer", [{"results": 3, "values": {}}, {"results": [3], "values": [[]]}])
def test_a_node_that_answers_with_the_wrong_kinds_is_told_so(answer: dict[str, Any]):
    def talk(socket: ServerConnection) -> None:
        while True:
            call = heard(socket, "call_service")
            says(op="service_response", id=call["id"], result=True, values=answer)(socket)

    with lying(talk, foxglove=False) as (address, _), pytest.raises(RobotError, match=r"it sent \d results"):
        send_params(address.url, "/node", Params())


class Dripping(socketserver.BaseRequestHandler):
    """Says for ever that the answer will come."""

    def handle(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                self.request.sendall(b"HTTP/1.1 100 Continue\r\n\r\n")
                time.sleep(0.01)


def test_a_node_whose_answer_never_ends_is_given_up(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(offers, "SEND_SECONDS", 0.3)
    with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Dripping) as peer:
        threading.Thread(target=peer.serve_forever).start()
        offer = Offer(address=f"http://127.0.0.1:{peer.server_address[1]}", token="", source="")
        with pytest.raises(OSError, match="does not answer"):
            send_to_node(offer, "region-growing", {})
        peer.shutdown()
