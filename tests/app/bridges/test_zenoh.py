"""Scans from ROS 2 on Zenoh and segments back; the robot is another implementation, on the loopback interface."""

from __future__ import annotations

import itertools
import re
import signal
import socket
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("zenoh_ros2_sdk", reason="tests of Zenoh need the package zenoh-ros2-sdk")

import zenoh_peer
from lineseg_app.__main__ import main
from lineseg_app.bridges.address import Address
from lineseg_app.live.ring import Ring
from lineseg_app.live.robot import Robot
from live import page_of
from obeying import Obedient, running, said
from ports import held_port
from processes import lineseg
from robots import nearest, wall, watching
from waiting import SECONDS, eventually

from lineseg import extract
from lineseg.readers.laser_scan import LaserScan

numbers = itertools.count(1)


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    with held_port() as port:
        yield port


@pytest.fixture(scope="module")
def peer(port: int) -> Iterator[Obedient]:
    peer = Obedient(zenoh_peer.start(port))
    peer.ask("take", topic="/none")
    yield peer
    peer.close()


@pytest.fixture
def topic() -> str:
    return f"/robot{next(numbers)}/scan"


def address(port: int, topic: str) -> Address:
    return Address(f"zenoh://127.0.0.1:{port}{topic}")


def opened(peer: Obedient, topic: str, **hash: str) -> None:
    peer.ask("subscriber", topic=f"{topic}/markers", type="visualization_msgs/msg/MarkerArray", **hash)
    peer.ask("subscriber", topic=f"{topic}/cloud", type="sensor_msgs/msg/PointCloud2", **hash)
    peer.ask("publisher", topic=topic, **hash)


def cloud_back(peer: Obedient, topic: str, distance: float, second: int) -> dict:
    """The cloud that answers a scan, which is sent until it comes, for a subscription takes effect after a while."""

    def came() -> list[dict]:
        clouds = peer.ask("take", topic=f"{topic}/cloud")
        mine = [cloud for cloud in clouds if cloud["header"]["stamp"]["sec"] == second]
        if not mine:
            peer.ask("scan", topic=topic, ranges=wall(distance), second=second)
        return mine

    return eventually(came, f"segments of the scan of second {second}", every=0.05)[0]


def test_markers_and_cloud_have_the_segments_the_stamp_and_the_frame_of_their_scan(
    peer: Obedient, port: int, topic: str
):
    with running(address(port, topic), topic):
        opened(peer, topic)
        cloud = cloud_back(peer, topic, 2.0, second=7)
        markers = peer.until("take", topic=f"{topic}/markers")[0]
    angles = np.float32([-0.7853982, 0.017453292]).tolist()
    (segment,) = extract(LaserScan(7, 7, "laser", *angles, 0.0, 30.0, np.float32(wall(2.0))).beams()).segments
    header = {"stamp": {"sec": 7, "nanosec": 7}, "frame_id": "laser"}
    (marker,) = markers["markers"]
    assert (marker["header"], cloud["header"], cloud["width"]) == (header, header, 1)
    assert [(point["x"], point["y"]) for point in marker["points"]] == [segment.start, segment.end]
    assert np.frombuffer(bytes(cloud["data"]), "<f4", 2).tolist() == np.float32(segment.start).tolist()


def test_a_scan_of_megabytes_is_not_taken_into_memory(peer: Obedient, port: int, topic: str):
    with running(address(port, topic), topic):
        opened(peer, topic)
        cloud_back(peer, topic, 2.0, second=7)
        peer.ask("scan", topic=topic, ranges=[2.0] * 400_000, second=8)
        late = cloud_back(peer, topic, 2.0, second=9)
        others = [cloud["header"]["stamp"]["sec"] for cloud in peer.ask("take", topic=f"{topic}/cloud")]
    assert late["width"] and 8 not in others


def test_each_topic_numbers_its_messages_without_gaps(peer: Obedient, port: int, topic: str):
    with running(address(port, topic), topic):
        opened(peer, topic)
        for second in range(3):
            cloud_back(peer, topic, 2.0, second)
    both = [peer.ask("numbers", topic=f"{topic}/{kind}") for kind in ("markers", "cloud")]
    ids = [{id for _, id in each} for each in both]
    assert [len(each) for each in ids] == [1, 1] and ids[0] != ids[1]
    for each in both:
        first = each[0][0]
        assert [number for number, _ in each] == list(range(first, first + len(each)))


def test_a_robot_with_humble_whose_types_have_no_hash_hears_the_segments(peer: Obedient, port: int, topic: str):
    with running(address(port, topic), topic):
        opened(peer, topic, hash="TypeHashNotSupported")
        assert cloud_back(peer, topic, 2.0, second=7)["width"] == 1


def test_scans_that_never_arrive_are_counted(peer: Obedient, port: int, topic: str):
    with running(address(port, topic), topic) as told:
        opened(peer, topic)
        cloud_back(peer, topic, 2.0, second=1)
        peer.ask("scan", topic=topic, ranges=wall(2.0), second=2, losing=7)
        cloud_back(peer, topic, 2.0, second=3)
    assert re.match(r"ended after \d+ scans(, \d+ left out)?, 7 lost", told[-1])


def test_scans_that_a_publisher_keeps_are_received_by_who_comes_later(peer: Obedient, port: int, topic: str):
    peer.ask("keeper", topic=topic, ranges=wall(2.0), seconds=[5, 6, 7])
    robot = Robot(address(port, topic), Ring(10), lambda: None)
    robot.start()
    try:
        eventually(lambda: robot.ring.total == 3, "three scans", lambda: robot.ring.total)
        assert robot.ring.snapshot().stamps.tolist() == pytest.approx([5, 6, 7])
        assert robot.lost == 0
    finally:
        robot.close()


def test_a_router_may_die_and_return(topic: str):
    with held_port() as port, running(address(port, topic), topic) as told:
        for second in (1, 2):
            peer = Obedient(zenoh_peer.start(port))
            opened(peer, topic)
            cloud_back(peer, topic, 2.0, second)
            peer.close()
            said(told, f"{topic} is no longer published; waiting for it")
            told.clear()


def test_a_publisher_may_go_and_return_and_another_type_is_told(peer: Obedient, port: int, topic: str):
    with running(address(port, topic), topic) as told:
        said(told, f"nobody publishes {topic} yet")
        peer.ask("publisher", topic=topic, type="std_msgs/msg/String")
        said(told, f"{topic} is std_msgs/msg/String; choose a sensor_msgs/LaserScan topic")
        peer.ask("close", topic=topic)
        opened(peer, topic)
        cloud_back(peer, topic, 2.0, second=1)
        peer.ask("close", topic=topic)
        said(told, f"{topic} is no longer published; waiting for it")
        peer.ask("publisher", topic=topic)
        cloud_back(peer, topic, 2.0, second=2)


def test_a_router_that_is_not_there_is_named(topic: str):
    with held_port() as port, running(address(port, topic), topic) as told:
        said(told, f"no Zenoh router answers at 127.0.0.1:{port}")


def test_a_node_ends_on_sigterm_while_a_router_is_silent(topic: str):
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        silent.listen()
        process = lineseg("node", f"zenoh://127.0.0.1:{silent.getsockname()[1]}{topic}")
        silent.accept()[0].close()
        connection, _ = silent.accept()  # after a trial whether anyone listens
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=SECONDS)
        connection.close()
    assert (process.returncode, "Traceback" in errors, "FATAL" in errors) == (0, False, False)


def test_the_page_shows_scans_and_the_topics_are_listed(
    peer: Obedient, port: int, topic: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    peer.ask("publisher", topic=topic)

    def listed() -> bool:
        # Topics show up in a few moments; the command looks for two seconds only.
        main(["view", f"zenoh://127.0.0.1:{port}"])
        return f"zenoh://127.0.0.1:{port}{topic}\n" in capsys.readouterr().out

    eventually(listed, f"a list with {topic}")
    with watching(f"zenoh://127.0.0.1:{port}{topic}", tmp_path, topic=None) as server, page_of(server) as page:
        page.say(type="hello")
        page.heard("loading", lambda message: "waiting for its first scan" in message["note"])

        def shown() -> bool:
            peer.ask("scan", topic=topic, ranges=wall(2.0))
            state = page.until(lambda state: state["topic"] == topic)
            return abs(nearest(state) - 2.0) < 0.01

        eventually(shown, "the wall on the page")
