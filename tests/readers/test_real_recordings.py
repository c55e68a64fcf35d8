"""Every recording of the data folder opens with what its manifest states."""

import json

import numpy as np
import pytest

from lineseg.poses import said_of
from lineseg.readers import Reading, open_recording

REFUSED = ("ros1_unsupported_v12", "ros1_no_laserscan")


@pytest.fixture(scope="module")
def manifest(data_dir):
    return {entry["name"]: entry for entry in json.loads((data_dir / "MANIFEST.json").read_text())}


def readable_files(manifest):
    for name, entry in manifest.items():
        if name not in REFUSED:
            for file in entry["files"]:
                if not file.endswith((".yaml", "-wal", "-shm")):
                    yield entry, file


def invalid_share(recording):
    return 1 - sum(np.count_nonzero(scan.valid) for scan in recording) / len(recording.ranges)


def test_each_has_the_scans_beams_angles_and_returns_of_the_manifest(data_dir, manifest):
    wrong = []
    for entry, file in readable_files(manifest):
        for topic, stated in entry.get("topics", {None: entry}).items():
            recording = open_recording(data_dir / file, topic=topic if len(entry.get("topics", ())) > 1 else None)
            beams = stated["beams"] if isinstance(stated["beams"], list) else [stated["beams"]] * 2
            bearings = recording[0].bearings
            found = (
                len(recording),
                list(recording.beams),
                round(invalid_share(recording), 3),
                round(np.rad2deg(bearings[-1] - bearings[0]), 1),
            )
            expected = (stated["scans"], beams, round(stated["invalid_share"], 3), round(stated["fov_deg"], 1))
            if not np.allclose(np.hstack(found), np.hstack(expected), atol=0.0011) and found != expected:
                wrong.append((file, found, expected))
    assert not wrong


def test_a_folder_opens_as_the_bag_in_it(data_dir):
    folder = open_recording(data_dir / "ros2_ld06_varying")
    file = open_recording(data_dir / "ros2_ld06_varying" / "data1_nov1_0.db3")
    assert np.array_equal(folder.ranges, file.ranges, equal_nan=True)
    assert folder.format == "ROS 2 bag"


def test_reading_leaves_no_trace_beside_a_database(data_dir):
    folder = data_dir / "ros2_ld06_varying"
    before = {path: path.stat().st_mtime_ns for path in folder.iterdir()}
    open_recording(folder)
    assert {path: path.stat().st_mtime_ns for path in folder.iterdir()} == before


def test_an_old_bag_gives_a_sentence_with_a_way_out(data_dir):
    with pytest.raises(ValueError, match=r"^splitter_demo.bag: a ROS bag of version 1\.2; .*`rosbag migrate` upgrades"):
        open_recording(data_dir / "ros1_unsupported_v12" / "splitter_demo.bag")


def test_a_bag_without_scans_says_what_it_has(data_dir):
    sentence = "mylaserdata.bag has no sensor_msgs/LaserScan topic; it has /tf (tf2_msgs/TFMessage)."
    with pytest.raises(ValueError) as raised:
        open_recording(data_dir / "ros1_no_laserscan" / "mylaserdata.bag")
    assert str(raised.value) == sentence


def test_the_first_of_several_topics_is_taken_and_the_others_are_offered(data_dir):
    path = data_dir / "ros1_two_urg04lx" / "scans_demo.bag"
    recording = open_recording(path)
    assert recording.topic == "/rear_scan"
    assert {topic.name: topic.scans for topic in recording.topics} == {"/rear_scan": 330, "/front_scan": 331}
    with pytest.raises(ValueError, match="has no laser topic '/scan'; it has /rear_scan, /front_scan"):
        open_recording(path, topic="/scan")


def test_repacked_bags_hold_the_same_scans(data_dir):
    original = open_recording(data_dir / "ros1_rplidar_a" / "mylaserdata2.bag")
    for packing in ("bz2", "lz4"):
        repacked = open_recording(data_dir / "derived_ros1_compressed" / f"rplidar_{packing}.bag")
        assert np.array_equal(repacked.ranges, original.ranges)
        assert np.array_equal(repacked.stamps, original.stamps)
    original = open_recording(data_dir / "ros2_ld06_varying")
    for packing in ("zstd", "lz4", "unchunked"):
        repacked = open_recording(data_dir / "derived_ros2_mcap" / f"ld06_{packing}.mcap")
        assert np.array_equal(repacked.ranges, original.ranges, equal_nan=True)
        assert np.array_equal(repacked.angle_increment, original.angle_increment)


def test_a_table_with_lists_holds_the_scans_of_its_bag(data_dir):
    table = open_recording(data_dir / "ros2_gazebo_csv_pair" / "scan.csv")
    bag = open_recording(data_dir / "ros2_gazebo_csv_pair" / "full_bag_nav_0.db3")
    assert np.array_equal(table.ranges.astype(np.float32), bag.ranges)
    assert np.allclose(table.angle_increment, bag.angle_increment, rtol=1e-7)
    assert np.allclose(table.stamps, bag.stamps)
    assert table.frame_ids == bag.frame_ids


def test_ranges_of_ros_stay_float32(data_dir):
    assert open_recording(data_dir / "ros1_utm30lx" / "hokuyo.bag").ranges.dtype == np.float32


def test_a_maximum_that_the_data_contradict_clips_no_reading(data_dir):
    recording = open_recording(data_dir / "carmen_edmonton" / "carmen_edmonton.log")  # says 10 m
    ranges = recording.ranges
    valid = np.concatenate([scan.valid for scan in recording])
    assert valid[ranges < 49.9].all()
    assert ranges[valid].max() == 49.09
    assert not valid[ranges > 49.9].any()


def test_options_say_what_a_plain_table_does_not(data_dir):
    path = data_dir / "urg04lx_breezy_exp2" / "exp2.dat"
    options = Reading(
        angle_min=np.deg2rad(-120), angle_increment=np.deg2rad(240 / 681), unit="mm", skip_columns=25, range_min=0.02
    )
    told, guessed = open_recording(path, reading=options), open_recording(path)
    assert np.array_equal(told.ranges, guessed.ranges)
    assert np.allclose(told[0].bearings, guessed[0].bearings)
    assert invalid_share(told) == pytest.approx(0.5774, abs=1e-4)  # with the error codes of 1 to 15 mm


def test_the_stamps_of_a_log_are_kept_as_they_are(data_dir):
    stamps = open_recording(data_dir / "carmen_intel" / "carmen_intel.log").stamps
    assert np.count_nonzero(np.diff(stamps) < 0) == 4
    equal = open_recording(data_dir / "carmen_belgioioso" / "carmen_belgioioso.log.gz").stamps
    assert len(set(equal)) == 1


def test_recordings_with_poses_say_where_they_come_from(data_dir):
    said = {
        name: said_of(recording.poses, recording.pose_source)
        for name in ("carmen_intel/carmen_intel.log", "ros1_urg04lx_corridor/target_before.bag",
                     "ros1_two_urg04lx/scans_demo.bag")
        for recording in [open_recording(data_dir / name)]
    }  # fmt: skip
    assert list(said.values()) == [
        "910 of 910 scans, from FLASER lines, 0 ms apart",
        "857 of 857 scans, from /tf (odom → base_link), 26 ms apart; also there: /odom",
        "none: the bag has neither /tf nor a topic of poses",
    ]
