"""Scans from a real Foxglove WebSocket server in each encoding, and segments sent back to it."""

from __future__ import annotations

import json
import queue
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from foxglove import Channel, Context, Schema, messages, start_server
from foxglove.channels import LaserScanChannel
from foxglove.websocket import Capability, ChannelView, Client, ClientChannel, ServerListener, WebSocketServer
from live import page_of
from robots import nearest, wall, watching
from rosbags.typesys import Stores, get_typestore
from rosbridge_peer import scan_message
from waiting import SECONDS

ROS2, ROS1 = get_typestore(Stores.ROS2_HUMBLE), get_typestore(Stores.ROS1_NOETIC)
SCAN = "sensor_msgs/msg/LaserScan"


class Listener(ServerListener):
    """Records what clients ask of the server."""

    def __init__(self) -> None:
        self.subscribed: queue.Queue[str] = queue.Queue()
        self.received: queue.Queue[tuple[ClientChannel, bytes]] = queue.Queue()
        self.channels: dict[int, ClientChannel] = {}

    def on_subscribe(self, client: Client, channel: ChannelView) -> None:
        self.subscribed.put(channel.topic)

    def on_client_advertise(self, client: Client, channel: ClientChannel) -> None:
        self.channels[channel.id] = channel

    def on_message_data(self, client: Client, client_channel_id: int, data: bytes) -> None:
        self.received.put((self.channels[client_channel_id], data))


class Robot:
    """A server with the encodings it takes, and one channel of laser scans."""

    def __init__(self, *encodings: str) -> None:
        self.context, self.listener = Context(), Listener()
        self.server: WebSocketServer = start_server(
            name="robot",
            port=0,
            capabilities=[Capability.ClientPublish] if encodings else [],
            supported_encodings=list(encodings) or None,
            server_listener=self.listener,
            context=self.context,
        )
        self.url = f"ws://127.0.0.1:{self.server.port}"

    def channel(self, topic: str, encoding: str, schema: str = SCAN) -> Channel:
        kind = {"ros1": "ros1msg", "json": "jsonschema"}.get(encoding, "ros2msg")
        text = b'{"type": "object", "properties": {"ranges": {"type": "array"}}}' if encoding == "json" else b""
        described = Schema(name=schema, encoding=kind, data=text)
        return Channel(topic, schema=described, message_encoding=encoding, context=self.context)


@pytest.fixture
def robots() -> Iterator[list[Robot]]:
    started: list[Robot] = []
    yield started
    for robot in started:
        robot.server.stop()


def encoded(encoding: str, message: dict[str, Any]) -> bytes:
    if encoding == "json":
        return json.dumps(message).encode()
    store = ROS2 if encoding == "cdr" else ROS1
    types = store.types
    stamp = types["builtin_interfaces/msg/Time"](**message["header"]["stamp"])
    seq = {"seq": 0} if encoding == "ros1" else {}
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id=message["header"]["frame_id"], **seq)
    arrays = {name: np.array(message[name], np.float32) for name in ("ranges", "intensities")}
    scan = types[SCAN](**(message | {"header": header} | arrays))
    return bytes(store.serialize_cdr(scan, SCAN) if encoding == "cdr" else store.serialize_ros1(scan, SCAN))


@pytest.mark.parametrize(("encoding", "back"), [("cdr", "cdr"), ("ros1", "ros1"), ("json", "json")])
def test_scans_arrive_in_each_encoding_and_segments_go_back(robots: list[Robot], tmp_path: Path, encoding, back):
    robots.append(robot := Robot(back))
    channel = robot.channel("/scan", encoding)
    with watching(robot.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        session = page.hear_a("welcome")["session"]
        assert robot.listener.subscribed.get(timeout=SECONDS) == "/scan"
        channel.log(encoded(encoding, scan_message(wall(3.0), second=7)))
        state = page.hear_a("drawn")["state"]
        assert (nearest(state), state["frameId"]) == (pytest.approx(3.0, abs=1e-3), "laser")
        assert state["stamp"] == pytest.approx(7.123456789)
        asked = {"session": session, "on": True, "topic": "/walls"}
        assert server.post("/api/robot/segments", json=asked).status_code == 200
        channel.log(encoded(encoding, scan_message(wall(2.0), second=8)))
        to, data = robot.listener.received.get(timeout=SECONDS)
        assert (to.topic, to.encoding, to.schema_name) == ("/walls", back, "visualization_msgs/MarkerArray")
        header, points = decoded(back, data)
        assert header == (8, 123456789, "laser")
        np.testing.assert_allclose(points, [[2.0, -2.0], [2.0, 2.0]], atol=1e-3)


@pytest.mark.parametrize(
    ("encoding", "schema"),
    [("protobuf", "foxglove.LaserScan"), ("json", "foxglove.LaserScan"), ("json", "robot.Lidar")],
)
def test_scans_of_foxglove_arrive_with_their_time_also_under_another_name(
    robots: list[Robot], tmp_path: Path, encoding, schema
):
    robots.append(robot := Robot())
    sent = scan_message(wall(3.0))
    end = sent["angle_min"] + sent["angle_increment"] * (len(sent["ranges"]) - 1)
    plain = {"frame_id": "laser", "start_angle": sent["angle_min"], "end_angle": end, "ranges": sent["ranges"]}
    if encoding == "protobuf":
        channel = LaserScanChannel("/scan", context=robot.context)
        message = messages.LaserScan(**plain, timestamp=messages.Timestamp(7, 250_000_000))
    else:
        channel = robot.channel("/scan", encoding, schema)
        message = json.dumps(plain | {"timestamp": {"sec": 7, "nsec": 250_000_000}, "pose": {}}).encode()
    with watching(robot.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        assert robot.listener.subscribed.get(timeout=SECONDS) == "/scan"
        channel.log(message)
        state = page.hear_a("drawn")["state"]
        assert (nearest(state), state["frameId"]) == (pytest.approx(3.0, abs=1e-3), "laser")
        assert state["stamp"] == pytest.approx(7.25)


def decoded(encoding: str, data: bytes) -> tuple[tuple[int, int, str], list[list[float]]]:
    name = "visualization_msgs/msg/MarkerArray"
    if encoding == "json":
        (marker,) = json.loads(data)["markers"]
        stamp, points = marker["header"]["stamp"], marker["points"]
        header = (stamp["sec"], stamp["nanosec"], marker["header"]["frame_id"])
        return header, [[point["x"], point["y"]] for point in points]
    message: Any = ROS2.deserialize_cdr(data, name) if encoding == "cdr" else ROS1.deserialize_ros1(data, name)
    (marker,) = message.markers
    stamp = marker.header.stamp
    return (stamp.sec, stamp.nanosec, marker.header.frame_id), [[point.x, point.y] for point in marker.points]


def test_a_topic_that_comes_later_is_waited_for_and_others_are_named(robots: list[Robot], tmp_path: Path):
    robots.append(robot := Robot())
    robot.channel("/chatter", "cdr", "std_msgs/msg/String")
    with watching(robot.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        waiting = page.heard("loading", lambda m: "/chatter" in m["note"])
        assert "has no topic /scan yet; it has /chatter is std_msgs/msg/String as cdr" in waiting["note"]
        channel = robot.channel("/scan", "cdr")
        assert robot.listener.subscribed.get(timeout=SECONDS) == "/scan"
        channel.log(encoded("cdr", scan_message(wall(3.0))))
        assert page.hear_a("drawn")["state"]["topic"] == "/scan"
        channel.log(b"\x00\x01\x00\x00 this is no scan")
        refused = page.heard("live", lambda m: m["refused"] == 1)
        assert "a message of /scan is not a scan" in refused["message"]


def test_a_topic_of_another_type_is_named(robots: list[Robot], tmp_path: Path):
    robots.append(robot := Robot())
    robot.channel("/scan", "cdr", "std_msgs/msg/String")
    with watching(robot.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        waiting = page.heard("loading", lambda m: "choose a" in m["note"])
        assert "/scan is std_msgs/msg/String as cdr; choose a sensor_msgs/LaserScan" in waiting["note"]


def test_a_channel_in_an_encoding_that_nobody_reads_is_named_and_hides_no_other(robots: list[Robot], tmp_path: Path):
    robots.append(robot := Robot())
    robot.channel("/scan", "cbor")
    with watching(robot.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        waiting = page.heard("loading", lambda m: "cbor" in m["note"])
        assert f"/scan is {SCAN} as cbor; choose a sensor_msgs/LaserScan" in waiting["note"]
        robot.channel("/imu", "cbor", "sensor_msgs/msg/Imu")
        channel = robot.channel("/scan", "json")
        assert robot.listener.subscribed.get(timeout=SECONDS) == "/scan"
        channel.log(encoded("json", scan_message(wall(3.0))))
        assert page.hear_a("drawn")["state"]["topic"] == "/scan"


def test_segments_for_a_server_that_takes_no_messages_are_refused(robots: list[Robot], tmp_path: Path):
    robots.append(robot := Robot())
    channel = robot.channel("/scan", "cdr")
    with watching(robot.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        session = page.hear_a("welcome")["session"]
        assert robot.listener.subscribed.get(timeout=SECONDS) == "/scan"
        channel.log(encoded("cdr", scan_message(wall(3.0))))
        page.hear_a("drawn")
        server.post("/api/robot/segments", json={"session": session, "on": True})
        channel.log(encoded("cdr", scan_message(wall(3.0))))
        told = page.heard("live", lambda m: m["publishTrouble"])
        assert "enable clientPublish on its Foxglove server" in told["publishTrouble"]
        assert told["publisher"] == ""
