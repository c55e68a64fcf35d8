"""Scans from ROS 2 on DDS and segments back, with participants in other processes, on the loopback interface alone."""

from __future__ import annotations

import itertools
import json
import os
import re
import signal
import threading
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cyclonedds", reason="DDS needs the extra ros2")

import dds_peer
import rtps_peer
from dds_peer import DOMAIN, URI, loopback
from lineseg_app.__main__ import main
from lineseg_app.bridges.address import Address, domain_of
from lineseg_app.bridges.cdr import CdrWriter
from lineseg_app.bridges.dds_domain import discovery, join
from lineseg_app.live.ring import Ring
from lineseg_app.live.robot import Robot
from live import page_of
from obeying import Obedient, running, said
from processes import lineseg
from robots import nearest, wall, watching
from waiting import SECONDS, eventually

from lineseg import Recording, Scan, extract, open_recording
from lineseg.covariance import Noise, covariances
from lineseg.readers.laser_scan import LaserScan

SAMPLES = Path(__file__).parents[3] / "sample_scans"
numbers = itertools.count(1)


@pytest.fixture(scope="module")
def peer() -> Iterator[Obedient]:
    with loopback():
        peer = Obedient(dds_peer.start())
        yield peer
        peer.close()


@pytest.fixture
def topic() -> str:
    return f"/robot{next(numbers)}/scan"


def opened(peer: Obedient, topic: str, **qos: bool) -> None:
    """A publisher of scans, and readers of what comes back."""
    peer.ask("open", topic=topic, kind="LaserScan", write=True, **qos)
    peer.ask("open", topic=f"{topic}/markers", kind="MarkerArray", write=False, reliable=True)
    peer.ask("open", topic=f"{topic}/cloud", kind="PointCloud2", write=False, reliable=True)
    peer.until("matched", topic=topic)
    peer.until("matched", topic=f"{topic}/markers")
    peer.until("matched", topic=f"{topic}/cloud")


def segments_back(peer: Obedient, topic: str, **scan: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """The markers and the cloud that answer a scan, which is sent until they come, for best effort may lose it."""

    def came() -> tuple[dict[str, Any], dict[str, Any]] | None:
        markers, cloud = (peer.ask("take", topic=f"{topic}/{kind}") for kind in ("markers", "cloud"))
        there["markers"] += markers
        there["cloud"] += cloud
        if all(there.values()):
            return there["markers"][0], there["cloud"][0]
        peer.ask("scan", topic=topic, **scan)
        return None

    there: dict[str, list[Any]] = {"markers": [], "cloud": []}
    found = eventually(came, f"segments on {topic}", lambda: there, every=0.1)
    assert found
    return found


def answer(peer: Obedient, topic: str, second: int) -> dict[str, Any]:
    """The message on a topic whose stamp has these seconds."""

    def found() -> dict[str, Any] | None:
        for message in peer.ask("take", topic=topic):
            header = message["header"] if "header" in message else message["markers"][0]["header"]
            if header["stamp"]["sec"] == second:
                return message
        return None

    message = eventually(found, f"the message of second {second} on {topic}")
    assert message
    return message


def test_a_scan_of_megabytes_is_not_taken_into_memory(peer: Obedient, topic: str):
    with running(Address(f"ros2:{topic}"), topic):
        opened(peer, topic, reliable=True)
        segments_back(peer, topic, ranges=[2.0] * 90, second=7)
        for second, beams in ((8, 400_000), (9, 90)):
            peer.ask("scan", topic=topic, ranges=[2.0] * beams, second=second)
        seconds: list[int] = []
        while seconds[-1:] != [9]:
            seconds += [cloud["header"]["stamp"]["sec"] for cloud in peer.until("take", topic=f"{topic}/cloud")]
    assert 8 not in seconds


def test_markers_and_cloud_have_the_segments_the_stamp_and_the_frame_of_their_scan(peer: Obedient, topic: str):
    ranges = [*wall(2.0)[:45], *[3.0] * 5, *wall(4.0)[50:]]
    noise = Noise(0.01, 0.001)
    with running(Address(f"ros2:{topic}"), topic, noise=noise):
        opened(peer, topic)
        markers, cloud = segments_back(peer, topic, ranges=ranges, second=7)
    angles = np.float32([-0.7853982, 0.017453292]).tolist()
    scan = LaserScan(7, 123456789, "laser", *angles, 0.0, 30.0, np.float32(ranges)).beams()
    expected = extract(scan)
    assert len(expected.segments) == 2

    (marker,) = markers["markers"]
    header = {"stamp": {"sec": 7, "nanosec": 123456789}, "frame_id": "laser"}
    assert (marker["header"], marker["ns"], marker["type"], marker["action"]) == (header, "lineseg", 5, 0)
    assert marker["pose"]["orientation"] == {"x": 0, "y": 0, "z": 0, "w": 1}
    assert marker["scale"]["x"] == pytest.approx(0.04)
    assert [(p["x"], p["y"], p["z"]) for p in marker["points"]] == [
        (*end, 0.0) for segment in expected.segments for end in (segment.start, segment.end)
    ]
    assert len(marker["colors"]) == 4 and all(colour["a"] == 1 for colour in marker["colors"])

    assert (cloud["header"], cloud["height"], cloud["width"], cloud["is_dense"]) == (header, 1, 2, True)
    kinds = {5: "<i4", 7: "<f4"}
    described = np.dtype(
        {
            "names": [field["name"] for field in cloud["fields"]],
            "formats": [kinds[field["datatype"]] for field in cloud["fields"]],
            "offsets": [field["offset"] for field in cloud["fields"]],
            "itemsize": cloud["point_step"],
        }
    )
    points = np.frombuffer(bytes(cloud["data"]), described)
    assert cloud["row_step"] == len(cloud["data"]) == points.nbytes
    for point, segment, matrix in zip(points, expected.segments, covariances(scan, expected, noise), strict=True):
        row = dict(zip(described.names or (), point.tolist(), strict=True))
        assert (row["first"], row["last"], row["points"]) == (segment.first, segment.last, segment.points)
        assert [row[name] for name in ("x", "y", "z", "x2", "y2", "rho", "theta", "length", "rms")] == pytest.approx(
            [*segment.start, 0.0, *segment.end, segment.rho, segment.theta, segment.length, segment.rms], rel=1e-6
        )
        assert [row["var_rho"], row["cov_rho_theta"], row["var_theta"]] == pytest.approx(
            [matrix[0, 0], matrix[0, 1], matrix[1, 1]], rel=1e-6
        )


@pytest.mark.parametrize("qos", [{"reliable": True}, {"reliable": True, "kept": True}, {"xcdr2": True}])
def test_every_usual_quality_of_service_is_received(peer: Obedient, topic: str, qos: dict[str, bool]):
    with running(Address(f"ros2:{topic}"), topic):
        opened(peer, topic, **qos)
        assert segments_back(peer, topic, ranges=wall(2.0))[1]["width"] == 1


def test_a_scan_that_its_publisher_keeps_is_received_by_a_node_that_comes_later(peer: Obedient, topic: str):
    peer.ask("open", topic=topic, kind="LaserScan", write=True, reliable=True, kept=True)
    peer.ask("scan", topic=topic, ranges=wall(2.0), second=42)
    peer.ask("open", topic=f"{topic}/markers", kind="MarkerArray", write=False, reliable=True, kept=True)
    with running(Address(f"ros2:{topic}"), topic):
        (markers,) = peer.until("take", topic=f"{topic}/markers")
    assert markers["markers"][0]["header"]["stamp"]["sec"] == 42


def test_a_topic_that_cannot_be_used_is_told(peer: Obedient, topic: str):
    with running(Address(f"ros2:{topic}"), topic) as told:
        said(told, f"nobody publishes {topic} yet")
        peer.ask("open", topic=topic, kind="String", write=True)
        said(told, f"{topic} is std_msgs/msg/String; choose a sensor_msgs/LaserScan topic")


def test_a_quality_of_service_that_does_not_fit_is_told(peer: Obedient, topic: str):
    with running(Address(f"ros2:{topic}"), topic) as told:
        peer.ask("open", topic=topic, kind="LaserScan", write=True, exclusive=True)
        said(told, f"{topic} is published, but its ownership does not fit")


def test_a_publisher_that_sends_nothing_that_can_be_read_is_told(peer: Obedient, topic: str):
    with running(Address(f"ros2:{topic}"), topic) as told:
        opened(peer, topic)
        said(told, f"{topic} has a publisher, but no scan comes from it")
        assert segments_back(peer, topic, ranges=wall(2.0))[1]["width"] == 1


def test_another_definition_of_the_type_is_told(peer: Obedient, topic: str):
    with running(Address(f"ros2:{topic}"), topic) as told:
        peer.ask("open", topic=topic, kind="OtherScan", write=True)
        said(told, f"{topic} is published, but with another definition of sensor_msgs/LaserScan")


def test_how_another_vendor_describes_the_type_does_not_matter(peer: Obedient, topic: str):
    ranges = np.float32(wall(2.0))
    cdr = CdrWriter()
    cdr.numbers("2I", 7, 0)
    cdr.text("laser")
    cdr.numbers("7f", -0.7853982, 0.7853982, 0.017453292, 0.0, 0.1, 0.0, 30.0)
    cdr.sequence(ranges)
    cdr.sequence(ranges[:0])
    other = rtps_peer.Publisher(DOMAIN, f"lineseg-{os.getpid()}", topic)
    robot = Robot(Address(f"ros2:{topic}"), Ring(10), lambda: None)
    robot.start()

    def heard() -> int:
        other.send(cdr.bytes())
        return robot.ring.total

    try:
        eventually(heard, "a scan")
    finally:
        robot.close()
        other.close()


def test_a_publisher_may_die_and_return(peer: Obedient, topic: str):
    other = Obedient(dds_peer.start())
    with running(Address(f"ros2:{topic}"), topic) as told:
        opened(other, topic)
        segments_back(other, topic, ranges=wall(2.0))
        other.close()
        said(told, f"{topic} is no longer published; waiting for it")
        opened(peer, topic)
        assert segments_back(peer, topic, ranges=wall(3.0))[1]["width"] == 1


def test_a_robot_that_starts_later_is_found_without_multicast(
    peer: Obedient, topic: str, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    process = lineseg("node", f"ros2:{topic}", "--markers", f"{topic}/markers", "--cloud", f"{topic}/cloud")
    assert process.stderr is not None
    assert any("nobody publishes" in line for line in process.stderr)
    # With multicast, Cyclone DDS would choose a port that nobody guesses; other implementations do not.
    uri = os.environ["CYCLONEDDS_URI"].replace("<Discovery>", "<Discovery><ParticipantIndex>auto</ParticipantIndex>")
    monkeypatch.setenv("CYCLONEDDS_URI", uri)
    later = Obedient(dds_peer.start())
    opened(later, topic)
    assert segments_back(later, topic, ranges=wall(2.0))[1]["width"] == 1
    later.close()
    process.terminate()
    process.communicate(timeout=SECONDS)


def as_messages_have_it(recording: Recording, frame: int) -> Scan:
    """The frame in the float32 of sensor_msgs/LaserScan."""
    scan = recording[frame]
    angles = np.float32([recording.angle_min[frame], recording.angle_increment[frame]]).tolist()
    shortest, longest = np.float32([scan.range_min, scan.range_max]).tolist()
    return Scan.regular(scan.ranges.astype(np.float32), *angles, range_min=shortest, range_max=longest)


def assert_replayed_exactly(peer: Obedient, topic: str, recording: Recording, frames: Iterable[int]) -> None:
    for frame in frames:
        scan = as_messages_have_it(recording, frame)
        angles = float(recording.angle_min[frame]), float(recording.angle_increment[frame])
        limits = scan.range_min, scan.range_max
        second = next(numbers)
        peer.ask("scan", topic=topic, ranges=scan.ranges.tolist(), second=second, angles=angles, limits=limits)
        (marker,) = answer(peer, f"{topic}/markers", second)["markers"]
        ends = [end for segment in extract(scan).segments for end in (segment.start, segment.end)]
        assert [(point["x"], point["y"]) for point in marker["points"]] == ends, (recording.name, frame)


def test_a_bag_that_is_replayed_gives_exactly_the_segments_of_extract(peer: Obedient, topic: str):
    recording = open_recording(SAMPLES / "hallway.mcap")
    for field in ("ranges", "bearings", "range_min", "range_max"):
        np.testing.assert_array_equal(getattr(as_messages_have_it(recording, 3), field), getattr(recording[3], field))
    with running(Address(f"ros2:{topic}"), topic):
        opened(peer, topic, reliable=True)
        # From then on the node knows its readers, too.
        segments_back(peer, topic, ranges=wall(2.0))
        assert_replayed_exactly(peer, topic, recording, range(0, len(recording), len(recording) // 5))


def test_any_recording_that_is_replayed_gives_exactly_the_segments_of_its_float32(
    peer: Obedient, topic: str, data_dir: Path
):
    refused = ("ros1_unsupported_v12", "ros1_no_laserscan")
    files = [
        next(file for file in sorted(folder.iterdir()) if file.suffix not in (".yaml", ".db3-shm", ".db3-wal"))
        for folder in sorted(data_dir.iterdir())
        if folder.is_dir() and folder.name not in refused
    ]
    with running(Address(f"ros2:{topic}"), topic):
        opened(peer, topic, reliable=True)
        segments_back(peer, topic, ranges=wall(2.0))
        for file in files:
            recording = open_recording(file)
            assert_replayed_exactly(peer, topic, recording, range(0, len(recording), len(recording) // 3 + 1))


def test_the_page_shows_scans_and_publishes_segments(peer: Obedient, topic: str, tmp_path: Path):
    with watching(f"ros2:{topic}", tmp_path, topic=None) as server, page_of(server) as page:
        page.say(type="hello")
        session = {"session": page.hear_a("welcome")["session"]}
        peer.ask("open", topic=topic, kind="LaserScan", write=True, reliable=True)
        peer.ask("open", topic=f"{topic}/segments", kind="MarkerArray", write=False, reliable=True)
        peer.until("matched", topic=topic)
        for second, distance in enumerate((4.0, 3.0, 2.0)):
            peer.ask("scan", topic=topic, ranges=wall(distance), second=second)
        state = page.until(lambda state: abs(nearest(state) - 2.0) < 0.01)
        assert (state["frame"], state["frames"], state["live"], state["topic"]) == (2, 3, True, topic)
        assert nearest(page.change(frame=0)) == pytest.approx(4.0, abs=1e-3)
        asked = {**session, "on": True, "topic": f"{topic}/segments"}
        server.post("/api/robot/segments", json=asked).raise_for_status()

        def published() -> Any:
            peer.ask("scan", topic=topic, ranges=wall(2.5), second=9)
            return peer.ask("take", topic=f"{topic}/segments")

        eventually(published, "segments on their topic")


def test_the_command_follows_its_file_and_ends_on_sigterm(peer: Obedient, topic: str, tmp_path: Path):
    file = tmp_path / "tuned.yaml"
    file.write_text("/**:\n  ros__parameters:\n    min_line_points: 10\n")
    out = ("--markers", f"{topic}/markers", "--cloud", f"{topic}/cloud")
    process = lineseg("node", f"ros2:{topic}", "--params", file, *out)
    opened(peer, topic, reliable=True)
    assert segments_back(peer, topic, ranges=wall(2.0))[1]["width"] == 1
    file.write_text("/**:\n  ros__parameters:\n    min_line_points: 92\n")
    peer.ask("scan", topic=topic, ranges=wall(2.0), second=99)
    assert answer(peer, f"{topic}/cloud", second=99)["width"] == 0
    process.send_signal(signal.SIGTERM)
    output, errors = process.communicate(timeout=SECONDS)
    assert (process.returncode, output) == (0, "")
    assert f"{file}: min_points 10 → 92" in errors


def test_once_publishes_one_scan_and_prints_it(peer: Obedient, topic: str, capsys: pytest.CaptureFixture[str]):
    done = threading.Event()

    def send() -> None:
        opened(peer, topic, reliable=True)
        while not done.wait(0.02):
            peer.ask("scan", topic=topic, ranges=wall(2.0), second=3)

    sending = threading.Thread(target=send)
    sending.start()
    code = main(["node", f"ros2:{topic}", "--once", "--markers", f"{topic}/markers", "--cloud", f"{topic}/cloud"])
    done.set()
    sending.join()
    assert code == 0
    (segment,) = json.loads(capsys.readouterr().out)["segments"]
    assert segment["points"] == 91
    assert len(peer.until("take", topic=f"{topic}/cloud")) == 1


def test_the_laser_topics_are_listed(peer: Obedient, topic: str, capsys: pytest.CaptureFixture[str]):
    peer.ask("open", topic=topic, kind="LaserScan", write=True, reliable=True)

    def listed() -> bool:
        # Topics show up in a few moments; the command looks for two seconds only.
        main(["view", "ros2:"])
        return f"ros2:{topic}  reliable, volatile\n" in capsys.readouterr().out

    eventually(listed, f"a list with {topic}")


def test_an_interface_that_is_not_there_is_named(peer: Obedient, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("CYCLONEDDS_URI", URI.format("elsewhere").replace("'lo'", "'eth99'"))
    with pytest.raises(OSError, match=r"CYCLONEDDS_URI names the interface eth99; this machine has .*lo"):
        join(DOMAIN + 1)


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({}, ""),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, ""),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, "<AllowMulticast>false.*<Peer Address='localhost'/>"),
        ({"ROS_LOCALHOST_ONLY": "1"}, "address='127.0.0.1'/>.*<AllowMulticast>false.*<Peer Address='localhost'/>"),
        (
            {"ROS_LOCALHOST_ONLY": "1", "CYCLONEDDS_URI": URI},
            "<General><AllowMulticast>false.*<Peer Address='localhost'/>",
        ),
        ({"ROS_STATIC_PEERS": "10.0.0.2;robot"}, "<Peer Address='10.0.0.2'/><Peer Address='robot'/>"),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF", "ROS_STATIC_PEERS": "robot"}, "<AllowMulticast>false.*<Tag>off-"),
    ],
)
def test_the_environment_of_ros_says_where_to_look(environment: dict[str, str], expected: str):
    found = discovery(environment)
    assert re.search(expected, found)
    assert ("<Peer " in found, "<AllowMulticast>" in found) == ("<Peer " in expected, "<AllowMulticast>" in expected)
    assert "<InitialLocatorPruneDelay>inf<" in found


def test_a_variable_that_cannot_be_is_told(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    monkeypatch.setenv("ROS_DOMAIN_ID", "999")
    assert main(["node", "ros2:/scan"]) == 2
    assert capsys.readouterr().err.startswith("lineseg: ROS_DOMAIN_ID is '999'; a domain of DDS is a whole number")
    with pytest.raises(ValueError, match="ROS_AUTOMATIC_DISCOVERY_RANGE is 'HERE'; choose from LOCALHOST"):
        discovery({"ROS_AUTOMATIC_DISCOVERY_RANGE": "HERE"})
    with pytest.raises(ValueError, match="ROS_STATIC_PEERS has 'a b'"):
        discovery({"ROS_STATIC_PEERS": "a b"})
    with pytest.raises(ValueError, match="ROS_DOMAIN_ID is '233'; a domain of DDS is a whole number from 0 to 232"):
        domain_of({"ROS_DOMAIN_ID": "233"})


def test_thousands_of_scans_take_no_more_memory_than_a_few(peer: Obedient, topic: str):
    psutil = pytest.importorskip("psutil", reason="the size of a process needs psutil")
    process = psutil.Process()
    with running(Address(f"ros2:{topic}"), topic):
        opened(peer, topic, reliable=True)
        sizes = []
        for _ in range(4):
            peer.ask("scan", topic=topic, ranges=wall(2.0) * 5, times=1000)
            peer.until("take", topic=f"{topic}/cloud")
            sizes.append(process.memory_info().rss)
    # What else is in this process may grow at any time; what is kept of the scans would grow each time.
    assert min(later - earlier for earlier, later in itertools.pairwise(sizes)) < 8 << 20, sizes
