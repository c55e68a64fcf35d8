"""Writes sample_scans/: two long recordings, a short one of a coarser laser in a room of boards that bend, the lessons,
and the hallway again in every other format.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ..scan import Recording, Scan
from .hallway import hallway_recording
from .laboratory import laboratory_recording
from .laser import LMS_200, RPLIDAR_A2, UTM_30LX
from .lessons import LESSONS
from .mcap_checksums import add_checksums
from .worlds import WORLDS

# Simulated time starts in the year of the paper: stamps of 0 would look like a clock that was never set.
EPOCH = 1_514_764_800
TOPIC = "/scan"
# What a SICK writes for no return.
SICK_NOTHING = 81.91


def write_samples(folder: Path) -> None:
    """Write all of sample_scans/, with the same arrays every time. Replaces existing files."""
    (folder / "lessons").mkdir(parents=True, exist_ok=True)
    save(folder / "hallway.npz", hallway_recording(), "A hallway with doors, fire cabinets and a side corridor")
    save(folder / "laboratory.npz", laboratory_recording(), "A laboratory with desks, chairs, cabinets and a walker")
    boards = WORLDS["boards"].recording("boards", 40)
    save(
        folder / "room_of_boards.npz",
        boards,
        "A room of boards that bend, for which the default ε is too small",
    )
    for lesson in LESSONS:
        save(folder / "lessons" / f"{lesson.name}.npz", lesson.recording(), lesson.title)
    write_carmen(folder / "hallway.log", hallway_recording(30, LMS_200, every=45, seed=30))
    write_mcap(folder / "hallway.mcap", hallway_recording(40, RPLIDAR_A2, every=9, seed=40))
    write_csv(folder / "hallway.csv", hallway_recording(10, UTM_30LX, every=150, seed=10))


def save(path: Path, recording: Recording, title: str) -> None:
    """Write a simulated recording as NPZ with its truth and a title. All scans have the same beams."""
    frames = len(recording)
    arrays: dict[str, Any] = {
        "ranges": recording.ranges.reshape(frames, -1),
        "angle_min": recording.angle_min[0],
        "angle_increment": recording.angle_increment[0],
        "range_min": recording.range_min[0],
        "range_max": recording.range_max[0],
        "stamps": recording.stamps,
        "frame_id": np.array(recording.frame_ids[0]),
        "title": np.array(title),
    }
    if recording.wall is not None:
        arrays["wall"] = recording.wall.reshape(frames, -1)
    arrays |= {name: array for name in ("poses", "walls") if (array := getattr(recording, name)) is not None}
    np.savez_compressed(path, allow_pickle=False, **arrays)


def write_carmen(path: Path, recording: Recording) -> None:
    """A CARMEN log of ROBOTLASER1 lines; the true poses stand in for odometry."""
    lines = ["# CARMEN Logfile", "# a simulated hallway, written by lineseg", "PARAM robot_frontlaser_offset 0.0"]
    poses = recording.poses if recording.poses is not None else np.zeros((len(recording), 3))
    lines += [_robotlaser(scan, pose) for scan, pose in zip(recording, poses.tolist(), strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


def _robotlaser(scan: Scan, pose: list[float]) -> str:
    """Type, start, field of view, resolution, maximum, accuracy, remission mode; ranges; remissions; poses; …"""
    increment = scan.bearings[1] - scan.bearings[0]
    field_of_view = scan.bearings[-1] - scan.bearings[0]
    head = f"0 {scan.bearings[0]:.6f} {field_of_view:.6f} {increment:.6f} {scan.range_max:.6f} 0.010000 0"
    ranges = np.where(scan.valid, scan.ranges, SICK_NOTHING)
    place = " ".join(f"{value:.6f}" for value in pose)
    stamp = f"{EPOCH + scan.stamp:.6f}"
    motion = "0.000000 0.000000 0.600000 0.400000 1000000.000000"
    values = " ".join(f"{value:.2f}" for value in ranges)
    return f"ROBOTLASER1 {head} {len(scan)} {values} 0 {place} {place} {motion} {stamp} lineseg {stamp}"


def write_csv(path: Path, recording: Recording) -> None:
    """One scan per row; the comments describe the beams."""
    scan = recording[0]
    lines = [
        "# A simulated hallway, one scan a row; inf where nothing came back.",
        f"# angle_min = {recording.angle_min[0]!s}",
        f"# angle_increment = {recording.angle_increment[0]!s}",
        "# unit = m",
        f"# range_min = {scan.range_min}",
        f"# range_max = {scan.range_max}",
    ]
    lines += [",".join(f"{value:.3f}" for value in each.ranges) for each in recording]
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


def write_mcap(path: Path, recording: Recording) -> None:
    """A ROS 2 bag as a bare .mcap with sensor_msgs/LaserScan and checksums."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    with TemporaryDirectory() as folder:
        bag = Path(folder) / "bag"
        with Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            connection = writer.add_connection(TOPIC, "sensor_msgs/msg/LaserScan", typestore=store)
            for scan in recording:
                nanoseconds = EPOCH * 10**9 + round(scan.stamp * 1e9)
                message = _laser_scan(scan, nanoseconds, store.types)
                writer.write(connection, nanoseconds, store.serialize_cdr(message, "sensor_msgs/msg/LaserScan"))
        (file,) = bag.glob("*.mcap")
        add_checksums(file)
        file.replace(path)


def _laser_scan(scan: Scan, nanoseconds: int, types: dict):
    stamp = types["builtin_interfaces/msg/Time"](sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)
    return types["sensor_msgs/msg/LaserScan"](
        header=types["std_msgs/msg/Header"](stamp=stamp, frame_id=scan.frame_id),
        angle_min=scan.bearings[0],
        angle_max=scan.bearings[-1],
        angle_increment=scan.bearings[1] - scan.bearings[0],
        time_increment=0.0,
        scan_time=1 / RPLIDAR_A2.rate,
        range_min=scan.range_min,
        range_max=scan.range_max,
        ranges=scan.ranges.astype(np.float32),
        intensities=np.empty(0, dtype=np.float32),
    )
