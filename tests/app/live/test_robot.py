"""Scans from a robot over rosbridge: they arrive, stop and arrive again, and segments are sent back."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lineseg_app.bridges.address import Address as Laser
from lineseg_app.node.running import Running
from lineseg_app.server import Settings
from live import Address, Page, page_of, serving
from obeying import running
from ports import held_port
from robots import nearest, wall, watching
from rosbridge_peer import TEXT, RosBridgePeer, scan_message
from waiting import SECONDS

from lineseg import EXTRACTORS
from lineseg.readers.laser_scan import LaserScan


@pytest.fixture
def peer() -> Iterator[RosBridgePeer]:
    peer = RosBridgePeer()
    yield peer
    peer.close()


def send(peer: RosBridgePeer, page: Page, *distances: float) -> dict[str, Any]:
    """Publish scans of a wall and return the state that shows the last one."""
    assert peer.subscribed.wait(SECONDS)
    for second, distance in enumerate(distances):
        peer.publish("/scan", scan_message(wall(distance), second))
    return page.until(lambda state: abs(nearest(state) - distances[-1]) < 0.01)


def test_scans_arrive_as_frames_and_the_newest_is_followed(peer: RosBridgePeer, tmp_path: Path):
    with watching(peer.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        assert "waiting for its first scan" in page.heard("loading", lambda m: "subscribed" in m["note"])["note"]
        state = send(peer, page, 4.0, 3.0, 2.0)
        assert (state["frame"], state["frames"], state["live"], state["first"]) == (2, 3, True, 0)
        assert (state["frameId"], state["topic"]) == ("laser", "/scan")
        status = page.heard("live", lambda m: m["total"] == 3 and m["connection"] == "open")
        assert (status["message"], status["dropped"], status["delay"]) == ("", 0, None)


def test_two_lasers_are_two_live_recordings(peer: RosBridgePeer, tmp_path: Path):
    rear = RosBridgePeer()
    lasers = Laser(peer.url, "/scan"), Laser(f"{rear.url}#/scan")
    with serving(Settings(robots=lasers, data_folder=tmp_path)) as server, page_of(server) as page:
        page.say(type="hello")
        assert nearest(send(peer, page, 4.0, 3.0)) == pytest.approx(3.0)
        page.ask(recording=lasers[1].id)
        assert nearest(send(rear, page, 1.5)) == pytest.approx(1.5)
        back = page.change(recording=lasers[0].id)
        assert (back["frames"], nearest(back)) == (2, pytest.approx(3.0))
    rear.close()


def test_a_selected_frame_stays_until_following_starts_again(peer: RosBridgePeer, tmp_path: Path):
    with watching(peer.url, tmp_path, keep=3) as server, page_of(server) as page:
        page.say(type="hello")
        send(peer, page, 4.0, 3.5, 3.0)
        paused = page.change(frame=0)
        assert (paused["live"], nearest(paused)) == (False, pytest.approx(4.0))
        for distance in (2.5, 2.0, 1.5):
            peer.publish("/scan", scan_message(wall(distance)))
        page.heard("live", lambda m: m["total"] == 6 and m["dropped"] == 3)
        still = page.change(params={"epsilon": 0.04})
        assert (still["frame"], still["frames"], still["first"], nearest(still)) == (0, 3, 0, pytest.approx(4.0))
        assert nearest(page.change(frame=1)) == pytest.approx(3.5)
        newest = page.change(live=True)
        assert (newest["live"], newest["frame"], newest["first"]) == (True, 5, 3)
        assert nearest(newest) == pytest.approx(1.5)
        assert page.heard("survey", lambda m: m["first"] == 3)["frames"] == 3


def test_the_scores_follow_the_scans(peer: RosBridgePeer, tmp_path: Path):
    with watching(peer.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        send(peer, page, 4.0)
        for distance in (3.5, 3.0, 2.5):
            peer.publish("/scan", scan_message(wall(distance)))
        surveyed = page.heard("survey", lambda m: m["frames"] == 4)
        assert surveyed["scores"]["segments"].tolist() == [1, 1, 1, 1]


def test_a_lost_robot_is_reported_and_found_again(tmp_path: Path):
    with held_port() as port:
        first = RosBridgePeer(port=port)
        with watching(first.url, tmp_path) as server, page_of(server) as page:
            page.say(type="hello")
            send(first, page, 4.0)
            first.close()
            lost = page.heard("live", lambda m: m["connection"] == "lost")
            assert "trying again in" in lost["message"]
            assert page.change(params={"epsilon": 0.04})["frames"] == 1
            again = RosBridgePeer(port=port)
            try:
                state = send(again, page, 2.0)
                assert state["frames"] == 2
                assert page.heard("live", lambda m: m["total"] == 2)["connection"] == "open"
            finally:
                again.close()


def test_a_missing_robot_is_named_and_another_recording_can_be_opened(tmp_path: Path):
    with held_port() as port, watching(f"ws://127.0.0.1:{port}", tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        waiting = page.heard("loading", lambda m: "listens" in m["note"])
        assert f"nothing listens at 127.0.0.1:{port}; trying again in" in waiting["note"]
        assert page.change(recording="sample:hallway")["live"] is None


@pytest.mark.parametrize(
    ("topic", "peer_of", "sentence"),
    [
        ("/chatter", {}, "/chatter is std_msgs/msg/String; choose a sensor_msgs/LaserScan topic, such as /scan"),
        ("/rear", {}, "the robot has no topic /rear; its laser topics: /scan"),
        (None, {"topics": {"/chatter": TEXT}}, "no sensor_msgs/LaserScan topic; it has /chatter (std_msgs/String)"),
        (
            None,
            {"rosapi": False},
            "the robot does not list its topics (Service /rosapi/topics does not exist); name one",
        ),
        (
            "/chatter",
            {"rosapi": False},
            "/chatter: Tried to subscribe to topic /chatter with type sensor_msgs/LaserScan",
        ),
    ],
)
def test_an_unavailable_topic_is_named(tmp_path: Path, topic: str | None, peer_of: dict, sentence: str):
    peer = RosBridgePeer(**peer_of)
    try:
        with watching(peer.url, tmp_path, topic=topic) as server, page_of(server) as page:
            page.say(type="hello")
            assert sentence in page.heard("loading", lambda m: sentence in m["note"])["note"]
    finally:
        peer.close()


def test_without_a_topic_the_first_of_laser_scans_is_taken(peer: RosBridgePeer, tmp_path: Path):
    with watching(peer.url, tmp_path, topic=None) as server, page_of(server) as page:
        page.say(type="hello")
        assert send(peer, page, 4.0)["topic"] == "/scan"


def test_a_message_that_is_not_a_scan_is_counted_and_skipped(peer: RosBridgePeer, tmp_path: Path):
    with watching(peer.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        assert peer.subscribed.wait(SECONDS)
        peer.publish("/scan", {"data": "hello"})
        peer.publish("/scan", scan_message([1.0, 2.0], angle_min=math.nan))
        refused = page.heard("live", lambda m: m["refused"] == 2)
        assert "a message of /scan is not a scan: its angle_min is nan" in refused["message"]
        state = send(peer, page, 3.0)
        peer.publish("/scan", scan_message([math.nan, math.inf, *wall(2.5)[2:]]))
        state = page.until(lambda s: s["frames"] == 2)
        assert state["beams"] - state["valid"] == 2


def test_segments_go_back_with_the_stamp_and_the_frame_of_their_scan(peer: RosBridgePeer, tmp_path: Path):
    with watching(peer.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        session = {"session": page.hear_a("welcome")["session"]}
        send(peer, page, 4.0)
        assert server.post("/api/robot/segments", json=session | {"on": True, "topic": "/walls"}).status_code == 200
        peer.publish("/scan", scan_message(wall(3.0), second=77))
        topic, message = peer.received.get(timeout=SECONDS)
        (marker,) = message["markers"]
        assert (topic, marker["header"]["frame_id"], marker["type"], marker["action"]) == ("/walls", "laser", 5, 0)
        assert marker["header"]["stamp"] == {"sec": 77, "nanosec": 123456789}
        assert [point["x"] for point in marker["points"]] == pytest.approx([3.0, 3.0], abs=1e-3)
        page.change(params={"min_length": 30.0})
        peer.publish("/scan", scan_message(wall(3.0)))
        assert peer.received.get(timeout=SECONDS)[1]["markers"][0]["action"] == 2
        assert server.post("/api/robot/segments", json=session | {"on": False}).status_code == 200


def test_ros_1_is_answered_in_its_own_words(peer: RosBridgePeer, tmp_path: Path):
    peer.topics = {"/scan": "sensor_msgs/LaserScan"}
    header = {"seq": 4, "stamp": {"secs": 9, "nsecs": 5}, "frame_id": "laser"}
    with watching(peer.url, tmp_path, topic=None) as server, page_of(server) as page:
        page.say(type="hello")
        session = page.hear_a("welcome")["session"]
        assert peer.subscribed.wait(SECONDS)
        peer.publish("/scan", scan_message(wall(3.0), header=header))
        assert page.hear_a("drawn")["state"]["stamp"] == pytest.approx(9.0)
        assert server.post("/api/robot/segments", json={"session": session, "on": True}).status_code == 200
        peer.publish("/scan", scan_message(wall(3.0), header=header))
        topic, message = peer.received.get(timeout=SECONDS)
        assert topic == "/lineseg/segments"
        assert message["markers"][0]["header"]["stamp"] == {"secs": 9, "nsecs": 5}


def test_only_one_tab_publishes_and_a_closed_tab_stops(peer: RosBridgePeer, tmp_path: Path):
    with watching(peer.url, tmp_path) as server, page_of(server) as page, page_of(server) as other:
        sessions = []
        for each in (page, other):
            each.say(type="hello")
            sessions.append(each.hear_a("welcome")["session"])
        send(peer, page, 3.0)
        asked = [{"session": session, "on": True} for session in sessions]
        assert server.post("/api/robot/segments", json=asked[0]).status_code == 200
        refused = server.post("/api/robot/segments", json=asked[1])
        assert (refused.status_code, "another tab already publishes" in refused.text) == (400, True)
        assert page.heard("live", lambda m: m["publisher"])["publisher"] == "this"
        assert other.heard("live", lambda m: m["publisher"])["publisher"] == "another"
        page.say(type="close")
        other.heard("live", lambda m: m["publisher"] == "")
        assert server.post("/api/robot/segments", json=asked[1]).status_code == 200


def test_an_impossible_message_ends_the_connection_and_not_the_program(peer: RosBridgePeer, tmp_path: Path):
    peer._service = lambda service, args: {"topics": 3, "types": None}  # type: ignore[method-assign]
    with watching(peer.url, tmp_path) as server, page_of(server) as page:
        page.say(type="hello")
        note = page.heard("loading", lambda m: "trying again" in m["note"])["note"]
        assert "the robot has no topic /scan; its laser topics: none" in note


def test_a_publication_that_fails_says_why(server: Address, page: Page):
    page.hello()
    for asked, sentence in [
        ({"session": "nobody", "on": True}, "reload the page"),
        ({"session": page.welcome["session"], "on": True}, "only be published for a live source"),
    ]:
        answer = server.post("/api/robot/segments", json=asked)
        assert answer.status_code in (400, 404)
        assert sentence in answer.json()["message"]


def test_a_node_over_rosbridge_runs_any_method_and_another_from_the_next_scan_on(peer: RosBridgePeer):
    room = [*wall(2.0)[:45], *[3.0] * 5, *wall(4.0)[50:]]
    scan = LaserScan(0, 0, "", -math.radians(45), math.radians(1), 0.1, 30.0, np.float32(room)).beams()
    present = Running("hough", EXTRACTORS["hough"].params_type())
    with running(Laser(peer.url, "/scan"), "/scan", present):
        assert peer.subscribed.wait(SECONDS)
        for method in ("hough", "split-and-merge-textbook", "region-growing"):
            params = EXTRACTORS[method].params_type(min_points=12)
            present.send(method, params)
            peer.publish("/scan", scan_message(room))
            sent = dict(peer.received.get(timeout=SECONDS) for _ in range(2))
            expected = EXTRACTORS[method].extract(scan, params).segments
            assert len(expected) == 2
            (marker,) = sent["/scan/markers"]["markers"]
            ends = [end for segment in expected for end in (segment.start, segment.end)]
            assert [(point["x"], point["y"]) for point in marker["points"]] == [pytest.approx(end) for end in ends]
            assert sent["/scan/cloud"]["width"] == 2
