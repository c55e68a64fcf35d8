"""Bags written by `rosbags` and read by lineseg: the decoder is tested with an independent encoder."""

import gzip
import shutil
import sqlite3
import struct
import zipfile

import numpy as np
import pytest
import zstandard
from bags import SCAN, STORES, bag1, bag2, encoded, message
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionMode, StoragePlugin

from lineseg.readers import Cancelled, open_recording
from lineseg.readers.laser_scan import decode_cdr, decode_ros1


@pytest.mark.parametrize("frame_id", ["", "l", "la", "las", "lase", "laser_link", "Läser"])
@pytest.mark.parametrize(("version", "decode"), [(1, decode_ros1), (2, decode_cdr)])
def test_a_message_is_decoded_whatever_the_length_of_its_frame_name(version, decode, frame_id):
    ranges = [1.0, np.nan, np.inf, 0.0, 2.5]
    scan = decode(encoded(version, message(version, ranges, 1.25e9 + 0.5, frame_id)))
    assert (scan.frame_id, scan.stamp) == (frame_id, 1.25e9 + 0.5)
    assert np.array_equal(scan.ranges, np.array(ranges, np.float32), equal_nan=True)
    assert scan[3:7] == pytest.approx((-1.5, 0.01, 0.1, 30.0))


def test_a_message_whose_structures_are_delimited_is_told():
    data = bytearray(encoded(2, message(2, [1.0])))
    data[1] = 0x09
    with pytest.raises(ValueError, match="its bytes have the encoding 0x0009, but ROS 2 sends plain CDR"):
        decode_cdr(bytes(data))


def test_an_increment_of_0_is_taken_from_the_angles(tmp_path):
    scan = decode_ros1(encoded(1, message(1, [1.0] * 11, increment=0.0, angle_min=-1.0, angle_max=1.0)))
    assert scan.angle_increment == pytest.approx(0.2)


def test_a_maximum_of_0_bounds_nothing():
    assert decode_ros1(encoded(1, message(1, [1.0], limits=(0.0, 0.0)))).range_max == np.inf


def test_a_truncated_message_is_refused():
    data = encoded(1, message(1, [1.0] * 100))
    with pytest.raises(ValueError, match="announces 100 ranges"):
        decode_ros1(data[:200])


def test_a_driver_that_was_started_anew_goes_on_with_the_same_recording(tmp_path):
    with Writer1(tmp_path / "two.bag") as bag:
        for driver in range(2):
            topic = bag.add_connection("/scan", SCAN, typestore=STORES[1], callerid=f"/driver_{driver}")
            for number in range(3):
                stamp = 1.0 + 3 * driver + number
                bag.write(topic, int(1e9 * stamp), encoded(1, message(1, [1.0, 2.0 + driver], stamp)))
    recording = open_recording(tmp_path / "two.bag")
    assert recording.stamps.tolist() == [1, 2, 3, 4, 5, 6]
    assert [topic.name for topic in recording.topics] == ["/scan"]
    assert not recording.account.notices


def test_two_lasers_on_one_topic_are_never_mixed(tmp_path):
    path = bag1(tmp_path / "two.bag", ("/scan", [1.0, 2.0]), ("/scan", [3.0, 4.0, 5.0]))
    first, second = open_recording(path), open_recording(path, geometry=1)
    assert (first.ranges.tolist(), second.ranges.tolist()) == ([1.0, 2.0] * 3, [3.0, 4.0, 5.0] * 3)
    (notice,) = first.account.notices
    assert (notice.kind, notice.change) == ("several lasers", {"geometry": 1})


def test_only_messages_of_the_laser_are_read(tmp_path):
    recording = open_recording(bag1(tmp_path / "bag.bag", ("/scan", [1.0, 2.0]), text=["a", "b"]))
    assert len(recording) == 3
    with pytest.raises(ValueError, match=r"has no sensor_msgs/LaserScan topic; it has /chatter \(std_msgs/String\)\."):
        open_recording(bag1(tmp_path / "text.bag", text=["a"]))


def test_stamps_that_are_all_zero_give_way_to_the_times_of_recording(tmp_path):
    recording = open_recording(bag1(tmp_path / "zero.bag", ("/scan", [1.0]), stamps=(0.0, 0.0)))
    assert recording.stamps.tolist() == [100.0, 101.0]


@pytest.mark.parametrize("compression", [None, CompressionMode.MESSAGE, CompressionMode.FILE])
@pytest.mark.parametrize("plugin", list(StoragePlugin))
def test_a_ros_2_bag_opens_compressed_or_not_and_with_or_without_metadata(tmp_path, plugin, compression):
    folder = bag2(tmp_path / "bag", ("/scan", [1.0, 2.0]), ("/rear", [3.0]), plugin=plugin, compression=compression)
    for _ in range(2):
        recording = open_recording(folder, topic="/rear")
        assert recording.ranges.tolist() == [3.0, 3.0, 3.0]
        assert {topic.name: topic.scans for topic in recording.topics} == {"/scan": 3, "/rear": 3}
        (folder / "metadata.yaml").unlink(missing_ok=True)


def test_the_files_of_a_split_bag_are_joined_in_the_order_of_their_numbers(tmp_path):
    folder = tmp_path / "split"
    folder.mkdir()
    for number in (2, 10, 1):
        bag2(tmp_path / f"part_{number}", ("/scan", [float(number)]), stamps=(float(number),))
        shutil.move(tmp_path / f"part_{number}" / f"part_{number}.db3", folder / f"split_{number}.db3")
    recording = open_recording(folder)
    assert recording.stamps.tolist() == [1.0, 2.0, 10.0]
    assert recording.topics[0].scans == 3


def test_a_file_name_may_contain_the_marks_of_an_address(tmp_path):
    folder = bag2(tmp_path / "bag", ("/scan", [1.0]))
    odd = tmp_path / "50% of a? #1.db3"
    shutil.copy(folder / "bag.db3", odd)
    assert len(open_recording(odd)) == 3


def test_messages_still_in_the_write_ahead_log_are_read(tmp_path):
    folder = bag2(tmp_path / "bag", ("/scan", [1.0]))
    database = sqlite3.connect(folder / "bag.db3")
    database.execute("PRAGMA journal_mode=WAL")
    database.execute(
        "INSERT INTO messages (topic_id, timestamp, data) SELECT topic_id, timestamp + 1, data FROM messages"
    )
    database.commit()
    cut_short = tmp_path / "cut_short"
    cut_short.mkdir()
    for name in ("bag.db3", "bag.db3-wal"):
        shutil.copy(folder / name, cut_short / name)
    database.close()
    assert len(open_recording(cut_short)) == 6
    assert not (cut_short / "bag.db3-shm").exists()


def test_a_callback_sees_progress_and_can_cancel(tmp_path):
    path = bag1(tmp_path / "long.bag", ("/scan", [1.0]), stamps=np.arange(500.0))
    seen = []
    open_recording(path, progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (500, 500)
    assert len(seen) > 5
    assert seen == sorted(seen)

    def cancel(done, total):
        if done > 100:
            raise Cancelled

    with pytest.raises(Cancelled):
        open_recording(path, progress=cancel)


def test_a_bag_without_index_is_read_and_the_tool_that_makes_one_is_named(tmp_path):
    data = bytearray(bag1(tmp_path / "whole.bag", ("/scan", [1.0])).read_bytes())
    place = data.index(b"index_pos=") + len(b"index_pos=")
    data[place : place + 8] = struct.pack("<Q", 0)
    path = tmp_path / "active.bag"
    path.write_bytes(data)
    recording = open_recording(path)
    (notice,) = recording.account.notices
    assert (len(recording), notice.kind, "`rosbag reindex`" in notice.text) == (3, "breaks off", True)


def test_a_long_bag_that_breaks_off_is_read_up_to_there(tmp_path):
    ranges, stamps = [1.0] * 2000, np.arange(1.0, 600.0)
    paths = [bag1(tmp_path / "whole.bag", ("/scan", ranges), stamps=stamps)]
    folder = bag2(tmp_path / "b", ("/scan", ranges), stamps=stamps, plugin=StoragePlugin.MCAP)
    paths += [path for path in folder.iterdir() if path.suffix != ".yaml"]
    paths.append(bag2(tmp_path / "c", ("/scan", ranges), stamps=stamps) / "c.db3")
    for path in paths:
        broken = tmp_path / f"broken{path.suffix}"
        broken.write_bytes(path.read_bytes()[: int(path.stat().st_size * 0.6)])
        recording = open_recording(broken)
        assert 250 < len(recording) < 400
        assert "breaks off" in [notice.kind for notice in recording.account.notices]


def zstd(data):
    """Packed in blocks that do not refer to each other, as data that vary are."""
    settings = zstandard.ZstdCompressionParameters(window_log=10)
    return zstandard.ZstdCompressor(compression_params=settings).compress(data)


@pytest.mark.parametrize("compression", [gzip.compress, zstd])
def test_what_can_be_unpacked_of_a_packed_bag_that_breaks_off_is_read_and_the_rest_is_told(tmp_path, compression):
    ranges, stamps = np.random.default_rng(0).uniform(1, 5, 500).astype(np.float32), np.arange(1.0, 200.0)
    folder = bag2(tmp_path / "bag", ("/scan", ranges), stamps=stamps)
    packed = compression((folder / "bag.db3").read_bytes())
    suffix = ".gz" if compression is gzip.compress else ".zstd"
    (folder / "bag.db3").unlink()
    (folder / f"bag.db3{suffix}").write_bytes(packed[: len(packed) // 2])
    for path in (folder / f"bag.db3{suffix}", *([folder] if suffix == ".zstd" else [])):
        recording = open_recording(path)
        assert 10 < len(recording) < 199
        assert np.array_equal(recording[0].ranges, ranges)
        assert [notice.kind for notice in recording.account.notices] == ["breaks off"] * 2


@pytest.mark.parametrize("packing", [zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED])
def test_a_zip_that_breaks_off_is_read_up_to_there(tmp_path, packing):
    bag1(tmp_path / "whole.bag", ("/scan", np.random.default_rng(0).uniform(1, 5, 1000)), stamps=np.arange(1.0, 40.0))
    with zipfile.ZipFile(tmp_path / "run.zip", "w", packing) as archive:
        archive.writestr("run/README.txt", "A bag.")
        archive.write(tmp_path / "whole.bag", "run/whole.bag")
    packed = (tmp_path / "run.zip").read_bytes()
    (tmp_path / "cut.zip").write_bytes(packed[: len(packed) * 2 // 3])
    recording = open_recording(tmp_path / "cut.zip")
    assert 5 < len(recording) < 39
    assert "breaks off" in [notice.kind for notice in recording.account.notices]


@pytest.mark.parametrize("share", [0.05, 0.15])
def test_a_bag_that_breaks_off_before_its_first_scan_is_damaged(tmp_path, share):
    for path in (
        bag1(tmp_path / "whole.bag", ("/scan", [1.0] * 5000)),
        bag2(tmp_path / "b", ("/scan", [1.0] * 999)) / "b.db3",
    ):
        broken = tmp_path / f"broken{path.suffix}"
        broken.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])
        with pytest.raises(ValueError, match=rf"^broken\{path.suffix}: a damaged"):
            open_recording(broken)
