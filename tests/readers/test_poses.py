"""Poses of the laser, from what each format has; the bags are written by `rosbags`."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from bags import ODOMETRY, SCAN, STORES, TREE, encoded, header, message, odometry, transform
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from scenes import wall_ahead

from lineseg import Recording, open_recording, save_npz
from lineseg.poses import in_world, said_of, seen_from
from lineseg.readers.poses.trajectory import trajectory_of

STAMPS = np.arange(5) * 0.1 + 100.05
# Turned by half a turn around the x axis.
UPSIDE_DOWN = (1.0, 0.0, 0.0, 0.0)


AS_THE_ROBOT = (0.0, 0.0, 0.0, 1.0)


def about_z(angle):
    return (0.0, 0.0, np.sin(angle / 2), np.cos(angle / 2))


def drive(stamp):
    """The robot, which drives ahead with 1 m/s and turns with 0.5 rad/s: its heading, and its pose."""
    since = stamp - 100.0
    return (since, 2.0, 0.0), about_z(0.5 * since)


def write(path, version, messages, stamps=STAMPS, **scan):
    """A bag of scans and of (topic, type, stamp, message)."""
    store = STORES[version]
    writer = Writer1(path) if version == 1 else Writer2(path, version=9, storage_plugin=StoragePlugin.MCAP)
    encode = store.serialize_ros1 if version == 1 else store.serialize_cdr
    with writer:
        topics = {
            topic: writer.add_connection(topic, type, typestore=store)
            for topic, type in {("/scan", SCAN), *(each[:2] for each in messages)}
        }
        rows = [(stamp, "/scan", encoded(version, message(version, [2.0] * 5, stamp, **scan))) for stamp in stamps]
        rows += [(stamp, topic, bytes(encode(body, type))) for topic, type, stamp, body in messages]
        for stamp, topic, data in sorted(rows, key=lambda row: row[0]):
            writer.write(topics[topic], round(1e9 * stamp), data)
    return path


def tree_of(version, transforms, topic="/tf"):
    kind = STORES[version].types[TREE]
    return [
        (topic, TREE, each.header.stamp.sec + 1e-9 * each.header.stamp.nanosec, kind([each])) for each in transforms
    ]


def driving(version, times, mount=(0.2, 0.1, 0.3), turn=AS_THE_ROBOT):
    moving = [transform(version, time, "odom", "base_link", *drive(time)) for time in times]
    fixed = [
        transform(version, 99.0, "map", "odom", (10.0, 0.0, 0.0)),
        transform(version, 99.0, "base_link", "laser", mount, turn),
    ]
    return [*tree_of(version, moving), *tree_of(version, fixed, "/tf_static")]


@pytest.mark.parametrize("version", [1, 2])
def test_a_chain_of_frames_is_interpolated_to_the_stamp_of_the_scan(tmp_path, version):
    path = write(tmp_path / "run.bag", version, driving(version, np.arange(100.0, 100.7, 0.1)))
    recording = open_recording(path)
    since = STAMPS - 100.0
    heading = 0.5 * since
    expected = np.column_stack((
        10 + since + np.cos(heading) * 0.2 - np.sin(heading) * 0.1,
        2 + np.sin(heading) * 0.2 + np.cos(heading) * 0.1, heading,
    ))  # fmt: skip
    assert np.allclose(recording.poses, expected, atol=1e-6)
    assert recording.pose_source.frames == ("map", "odom", "base_link", "laser")
    assert recording.pose_source.apart == pytest.approx(0.05, abs=1e-6)
    assert "5 of 5 scans, from /tf (map → odom → base_link → laser), 50 ms apart" in said_of(
        recording.poses, recording.pose_source
    )


def test_a_laser_that_hangs_upside_down_sees_its_walls_where_they_are(tmp_path):
    path = write(tmp_path / "run", 2, driving(2, [100.0, 100.3, 100.6], turn=UPSIDE_DOWN), angle_min=0.0, increment=0.3)
    recording = open_recording(path)
    assert recording.pose_source.upside_down
    seen = in_world(recording[0].xy, recording.poses[0], True)
    mirrored = open_recording(path, direction="clockwise")
    assert not mirrored.pose_source.upside_down
    assert np.allclose(seen, in_world(mirrored[0].xy, mirrored.poses[0]))
    assert seen[1, 1] < seen[0, 1]
    assert np.allclose(seen_from(seen, recording.poses[0], True), recording[0].xy)


def test_a_gap_is_a_gap(tmp_path):
    times = [100.0, 100.1, 102.9, 103.0]
    recording = open_recording(write(tmp_path / "run", 2, driving(2, times), stamps=[99.5, 100.05, 101.0, 102.95]))
    assert np.isfinite(recording.poses).all(axis=1).tolist() == [False, True, False, True]
    assert "has gaps" in recording.pose_source.missing
    standing = [transform(2, time, "odom", "laser", (1.0, 2.0, 0.0)) for time in (100.0, 103.0)]
    moved = [*standing, transform(2, 103.1, "odom", "laser", (1.1, 2.0, 0.0))]
    recording = open_recording(write(tmp_path / "standing", 2, tree_of(2, moved), stamps=[101.0]))
    assert recording.poses.tolist() == [[1.0, 2.0, 0.0]]


def test_odometry_is_taken_where_no_frames_move_and_the_mount_is_applied(tmp_path):
    poses = [("/odom", ODOMETRY, time, odometry(2, time, "odom", "base_link", *drive(time))) for time in (100.0, 100.5)]
    mount = tree_of(2, [transform(2, 99.0, "base_link", "laser", (0.2, 0.0, 0.0))], "/tf_static")
    recording = open_recording(write(tmp_path / "run", 2, [*poses, *mount], stamps=[100.25]))
    assert recording.poses[0] == pytest.approx([0.25 + 0.2 * np.cos(0.125), 2 + 0.2 * np.sin(0.125), 0.125])
    assert recording.pose_source.text == "/odom"
    bare = open_recording(write(tmp_path / "bare", 2, poses, stamps=[100.25]))
    assert bare.poses[0] == pytest.approx([0.25, 2, 0.125])
    assert "mount is not known" in bare.pose_source.missing


@pytest.mark.parametrize("version", [1, 2])
@pytest.mark.parametrize("kind", ["PoseStamped", "PoseWithCovarianceStamped"])
def test_poses_of_a_localisation_are_those_of_the_robot_if_the_mount_is_known(tmp_path, version, kind):
    types, name = STORES[version].types, f"geometry_msgs/msg/{kind}"

    def pose_at(time):
        place, turn = drive(time)
        pose = types["geometry_msgs/msg/Pose"](
            types["geometry_msgs/msg/Point"](*place), types["geometry_msgs/msg/Quaternion"](*turn)
        )
        covered = types["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36)) if "With" in kind else pose
        return types[name](header(version, time, "map"), covered)

    poses = [("/amcl_pose", name, time, pose_at(time)) for time in (100.0, 100.5)]
    goals = [("/goal_pose", name, time, pose_at(50.0)) for time in (100.0, 100.5)]
    mount = tree_of(version, [transform(version, 99.0, "base_link", "laser", (0.2, 0.0, 0.0))], "/tf_static")
    recording = open_recording(write(tmp_path / "run.bag", version, [*goals, *poses, *mount], stamps=[100.25]))
    assert recording.poses[0] == pytest.approx([0.25 + 0.2 * np.cos(0.125), 2 + 0.2 * np.sin(0.125), 0.125])
    assert recording.pose_source.frames == ("map", "base_link", "laser")


def test_a_topic_of_poses_can_be_chosen(tmp_path):
    poses = [
        ("/odom", ODOMETRY, time, odometry(2, time, "odom", "base_link", (7.0, time, 0.0), about_z(1.0)))
        for time in (100.0, 100.5)
    ]
    path = write(tmp_path / "run", 2, [*driving(2, [100.0, 100.5]), *poses])
    assert open_recording(path).pose_source.missing == "also there: /odom"
    assert open_recording(path, pose_topic="/odom").poses[0, 2] == pytest.approx(1.0)
    assert "there is /tf, /odom" in open_recording(path, pose_topic="/amcl").pose_source.missing


def test_poses_of_another_clock_are_told(tmp_path):
    recording = open_recording(write(tmp_path / "run", 2, driving(2, [5.0, 6.0])))
    assert recording.poses is None
    assert "another clock" in recording.pose_source.missing
    assert said_of(None, recording.pose_source).startswith("none: /tf: their stamps go from 5.000 to 6.000 s")


def test_the_poses_of_a_bag_are_read_when_they_are_asked_for_and_survive_a_copy(tmp_path):
    path = write(tmp_path / "run", 2, driving(2, [100.0, 100.5]))
    recording = open_recording(path, frames="1:3")
    copy = pickle.loads(pickle.dumps(recording))
    assert "found" not in vars(recording.track)
    assert np.array_equal(copy.poses, recording.poses)
    assert len(recording.only(np.array([1])).poses) == 1


def test_flaser_lines_state_the_pose_of_the_laser(tmp_path):
    log = tmp_path / "run.log"
    log.write_text("FLASER 3 1 2 3 1.5 2.5 0.5 9 9 9 12.5 host 12.5\nFLASER 3 1 2 3\n")
    recording = open_recording(log)
    assert recording.poses[0].tolist() == [1.5, 2.5, 0.5]
    assert np.isnan(recording.poses[1]).all()
    assert recording.pose_source.text == "FLASER lines"


def test_robotlaser_states_the_laser_before_the_robot_and_rawlaser_has_no_pose(tmp_path):
    log = tmp_path / "run.log"
    head = "0 -1.57 3.14 1.57 80 0.01 0 3 1 2 3 2 7 7"
    log.write_text(f"ROBOTLASER1 {head} 1 2 3 4 5 6 0 0 0 0 0 12.5 host 1\nRAWLASER1 {head} 12.5 host 1\n")
    assert open_recording(log).poses.tolist() == [[1, 2, 3]]
    raw = open_recording(log, topic="RAWLASER1")
    assert raw.poses is None
    assert raw.pose_source.missing == "RAWLASER1 lines have none"


def scans(stamps):
    return Recording.from_scans([wall_ahead(stamp=stamp) for stamp in stamps])


@pytest.mark.parametrize(
    ("text", "heading"),
    [
        ("# a trajectory\n100 0 2 0 0 0 0 1\n101 1 2 0 0 0 0.5 0.8660254\n", np.pi / 6),
        ("t,x,y,yaw\n100,0,2,0\n101,1,2,1\n", 0.5),
        ("#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n"
         "1400000100000000000,0,2,0,1,0,0,0\n1400000101000000000,1,2,0,0.8660254,0,0,0.5\n", np.pi / 6),
    ],
)  # fmt: skip
def test_a_trajectory_beside_the_recording_is_read(tmp_path, text, heading):
    began = 1.4e9 if "ns" in text else 0.0
    save_npz(scans([began + 100.5, began + 103.0]), tmp_path / "run.npz")
    (tmp_path / "run.tum").write_text(text)
    recording = open_recording(tmp_path / "run.npz", poses="run.tum")
    assert recording.poses[0] == pytest.approx([0.5, 2.0, heading], abs=1e-5)
    assert np.isnan(recording.poses[1]).all()


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("1 2 3 4 5\n", "run.tum has 5 columns that are not known to be poses"),
        ("100 0 2 0 0 0 0 1\n101 0 2\n", "run.tum:2 has 3 columns, but the rows before have 8"),
        ("0 0 0\n1 1 1\n2 2 2\n", "no stamps and 3 poses, but the recording has 1 scans"),
        ("", "no row of numbers"),
    ],
)
def test_a_file_that_is_no_trajectory_is_refused_with_its_place(tmp_path, text, complaint):
    save_npz(scans([100.5]), tmp_path / "run.npz")
    (tmp_path / "run.tum").write_text(text)
    with pytest.raises(ValueError, match=complaint):
        open_recording(tmp_path / "run.npz", poses="run.tum")


def test_npz_keeps_poses_gaps_and_a_laser_upside_down(tmp_path):
    path = write(tmp_path / "run", 2, driving(2, [100.0, 100.3], turn=UPSIDE_DOWN))
    recording = open_recording(path)
    save_npz(recording, tmp_path / "copy.npz")
    copy = open_recording(tmp_path / "copy.npz")
    assert np.array_equal(copy.poses, recording.poses, equal_nan=True)
    assert copy.pose_source.upside_down


def test_an_array_of_poses_that_are_all_nan_says_so(tmp_path):
    arrays = {"ranges": np.full((3, 20), 2.0), "angle_min": 0.0, "angle_increment": 0.05}
    np.savez(tmp_path / "none.npz", **arrays, poses=np.full((3, 3), np.nan))
    recording = open_recording(tmp_path / "none.npz")
    assert recording.poses is None
    assert recording.pose_source.missing == "all are NaN in the file"


@pytest.mark.parametrize("turn", [AS_THE_ROBOT, UPSIDE_DOWN])
def test_motion_within_a_sweep_is_removed(tmp_path, turn):
    """A wall at y = 5, seen by a laser that drives towards it with 2 m/s and turns while it measures."""
    pause, sense = 0.001, -1.0 if turn == UPSIDE_DOWN else 1.0
    moving = [transform(2, time, "odom", "laser", *pose) for time, pose in [
        (time, ((0.0, 2.0 * (time - 100.0), 0.0), compose(about_z(np.pi / 2 + 0.8 * (time - 100.0)), turn)))
        for time in np.arange(100.0, 101.0, 0.01)]]  # fmt: skip
    bearings = -0.5 + 0.01 * np.arange(100)
    since = 0.2 + pause * np.arange(100)
    ranges = (5 - 2.0 * since) / np.sin(np.pi / 2 + 0.8 * since + sense * bearings)
    path = tmp_path / "run"
    with Writer2(path, version=9) as bag:
        scan, tree = (bag.add_connection(*each, typestore=STORES[2]) for each in (("/scan", SCAN), ("/tf", TREE)))
        bag.write(scan, 0, encoded(2, message(2, ranges, 100.2, angle_min=-0.5, increment=0.01, time_increment=pause)))
        for _, _, time, body in tree_of(2, moving):
            bag.write(tree, round(1e9 * time), STORES[2].serialize_cdr(body, TREE))
    kept, removed = open_recording(path), open_recording(path, motion="removed")

    def off(recording):
        seen = in_world(recording[0].xy, recording.poses[0], recording.pose_source.upside_down)
        return np.abs(seen[:, 1] - 5).max()

    assert off(kept) > 0.05
    assert off(removed) < 1e-4


def compose(one, other):
    x, y, z, w = one
    a, b, c, d = other
    return (
        w * a + x * d + y * c - z * b,
        w * b - x * c + y * d + z * a,
        w * c + x * b - y * a + z * d,
        w * d - x * a - y * b - z * c,
    )


def test_motion_that_cannot_be_removed_is_told(tmp_path):
    save_npz(scans([1.0]), tmp_path / "run.npz")
    with pytest.raises(ValueError, match="time between two beams is not known; give it with time_increment"):
        open_recording(tmp_path / "run.npz", motion="removed")
    with pytest.raises(ValueError, match="the scans have no poses: the file has none"):
        open_recording(tmp_path / "run.npz", motion="removed", time_increment=1e-4)


@pytest.mark.parametrize("name", ["hallway.log", "hallway.mcap", "hallway.csv", "hallway.npz"])
def test_opening_a_file_finds_neither_its_poses_nor_what_it_was_taken_for(name: str):
    recording = open_recording(Path(__file__).parents[2] / "sample_scans" / name)
    assert "findings" not in vars(recording.account)
    assert recording.track is None or "found" not in vars(recording.track)


def test_a_line_of_opening_brackets_is_refused_at_once(tmp_path):
    """Each bracket once looked for its partner to the end of the line: this test would not end."""
    (tmp_path / "poses.txt").write_text("[" * 1_000_000)
    with pytest.raises(ValueError, match="has no row of numbers"):
        trajectory_of(tmp_path / "poses.txt", STAMPS)
