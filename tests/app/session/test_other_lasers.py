"""Two lasers of one robot in one picture: what both see of a room lies on its walls."""

from __future__ import annotations

import numpy as np
import pytest
from bags import SCAN, STORES, TREE, encoded, message, transform
from lineseg_app.scene.beside import OtherLaser, beside_told, scans_beside, why_apart
from lineseg_app.scene.palette import LIGHT
from lineseg_app.scene.world import World
from lineseg_app.server import Settings
from live import page_of, serving
from rosbags.rosbag2 import Writer

from lineseg import open_recording

# Half the sides of the room, and the lasers: x, y [m] and heading [rad] on the robot, and whether upside down.
ROOM = np.array([4.0, 3.0])
LASERS = {"/front_scan": ("front", 0.4, 0.0, 0.0, False), "/rear_scan": ("rear", -0.4, 0.1, np.pi, True)}
STAMPS = np.arange(100.0, 103.0, 0.1)


def robot_at(stamp):
    """Its place and heading."""
    since = stamp - 101.5
    return 0.6 * since, 0.3 * since, 0.4 * since


def laser_at(stamp, x, y, heading):
    rx, ry, turn = robot_at(stamp)
    return np.cos(turn) * x - np.sin(turn) * y + rx, np.sin(turn) * x + np.cos(turn) * y + ry, turn + heading


def ranges_in_room(pose, bearings):
    away = np.stack((np.cos(pose[2] + bearings), np.sin(pose[2] + bearings)), axis=1)
    walls = np.where(away > 0, ROOM - pose[:2], -ROOM - pose[:2])
    return (walls / away).min(axis=1)


def turned(heading, upside_down=False):
    half = heading / 2
    return (np.cos(half), np.sin(half), 0.0, 0.0) if upside_down else (0.0, 0.0, np.sin(half), np.cos(half))


def bag_of_two(path, mounts=("front", "rear"), moves=True):
    """A drive through the room; the scans of the rear laser are taken 30 ms after those of the front."""
    store, bearings = STORES[2], -1.003 + 0.02 * np.arange(101)
    tree = [transform(2, 99.0, "base_link", frame, (x, y, 0.0), turned(heading, under))
            for frame, x, y, heading, under in LASERS.values() if frame in mounts]  # fmt: skip
    if moves:
        tree += [
            transform(2, time, "odom", "base_link", (*robot_at(time)[:2], 0.0), turned(robot_at(time)[2]))
            for time in np.arange(99.9, 103.3, 0.02)
        ]
    with Writer(path, version=9) as bag:
        scans = {topic: bag.add_connection(topic, SCAN, typestore=store) for topic in LASERS}
        frames = bag.add_connection("/tf", TREE, typestore=store)
        for edge in tree if moves else []:
            stamp = edge.header.stamp.sec + 1e-9 * edge.header.stamp.nanosec
            bag.write(frames, round(1e9 * stamp), store.serialize_cdr(store.types[TREE]([edge]), TREE))
        for stamp in STAMPS:
            for late, (topic, (frame, x, y, heading, under)) in zip((0.0, 0.03), LASERS.items(), strict=True):
                pose = laser_at(stamp + late, x, y, heading)
                ranges = ranges_in_room(pose, -bearings if under else bearings)
                body = message(2, ranges, stamp + late, frame, bearings[0], 0.02, bearings[-1])
                bag.write(scans[topic], round(1e9 * (stamp + late)), encoded(2, body))
    return path


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return bag_of_two(tmp_path_factory.mktemp("robot") / "two")


def test_the_scan_nearest_in_time_is_drawn_on_the_walls(bag):
    front, rear = (open_recording(bag, topic=topic) for topic in LASERS)
    assert why_apart(front, rear) == ""
    laser = OtherLaser("/rear_scan", World.of(rear))
    drawn = scans_beside([laser], STAMPS[12], LIGHT)
    assert laser.frame_at(STAMPS[12]) == 12
    assert len(drawn.xyz) == 101
    assert (drawn.colours == LIGHT.second).all()
    assert np.abs(np.abs(drawn.xyz[:, :2]) / ROOM).max(axis=1) == pytest.approx(1.0, abs=1e-3)
    later = STAMPS[-1] + 2.0
    assert len(scans_beside([laser], later, LIGHT).xyz) == 0
    assert "no scan with a pose within 0.5 s" in beside_told([laser], later, LIGHT)[0]["why"]


def test_a_laser_whose_place_is_not_known_is_not_drawn(tmp_path, bag):
    one, none = bag_of_two(tmp_path / "one", ("front",)), bag_of_two(tmp_path / "none", moves=False)
    front, rear = (open_recording(one, topic=topic) for topic in LASERS)
    assert why_apart(front, rear).startswith("how /rear_scan is mounted on the robot is not known")
    front, rear = (open_recording(none, topic=topic) for topic in LASERS)
    assert why_apart(front, rear) == "/front_scan has no poses: the bag has neither /tf nor a topic of poses"
    stamps = np.arange(99.0, 105.0, 0.5)
    (tmp_path / "way.tum").write_text("".join(f"{stamp} {stamp} 0 0 0 0 0 1\n" for stamp in stamps))
    file = str(tmp_path / "way.tum")
    assert "/front_scan is mounted" in why_apart(*(open_recording(bag, topic=each, poses=file) for each in LASERS))


def test_the_page_shows_the_other_laser_while_its_layer_is_on(bag, tmp_path):
    with serving(Settings(files=(bag,), data_folder=tmp_path)) as server, page_of(server) as page:
        page.hello(space="world", topic="/front_scan", frame=5)
        page.change(layers={"other_lasers": True})
        state = page.until(lambda state: state["world"] and [each["why"] for each in state["world"]["lasers"]] == [""])
        assert "other lasers" in state["nodes"]
        assert state["world"]["lasers"][0]["topic"] == "/rear_scan"
        state = page.change(layers={"other_lasers": False})
        assert "other lasers" not in state["nodes"]
        assert state["world"]["lasers"] == []
