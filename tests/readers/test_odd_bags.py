"""Bags of which a part cannot be read, written by the Foxglove SDK or cut: what is good opens, and the rest is told."""

import json
import shutil
import sqlite3

import pytest
from bags import SCAN, encoded, message
from foxglove import Channel, Context, Schema, open_mcap
from rosbags.rosbag2 import StoragePlugin

from lineseg.readers import open_recording
from lineseg.readers.bags import ros2

from .test_ros_bags import bag2

JSON = json.dumps({"ranges": [1.0, 2.0], "angle_min": 0.0, "angle_increment": 0.1}).encode()


def mcap(path, *channels):
    """An MCAP file of three messages in each channel: (topic, encoding, name of its schema or None, message)."""
    context = Context()
    with open_mcap(path, context=context):
        for topic, encoding, schema, data in channels:
            described = None if schema is None else Schema(name=schema, encoding="ros2msg", data=b"")
            channel = Channel(topic, schema=described, message_encoding=encoding, context=context)
            for number in range(3):
                channel.log(data, log_time=10**9 * (1 + number))
    return path


def test_a_topic_in_an_unknown_encoding_does_not_hide_the_others(tmp_path):
    scan = encoded(2, message(2, [1.0, 2.0]))
    path = mcap(tmp_path / "two.mcap", ("/odd", "flatbuffer", SCAN, b"odd"), ("/scan", "cdr", SCAN, scan))
    recording = open_recording(path)
    assert (recording.topic, len(recording), [topic.name for topic in recording.topics]) == ("/scan", 3, ["/scan"])
    (notice,) = (each for each in recording.account.notices if each.kind == "unreadable topic")
    assert notice.text.startswith("The messages of /odd were left out: messages are encoded as flatbuffer;")
    with pytest.raises(
        ValueError, match=r"two\.mcap: /odd: messages are encoded as flatbuffer; only cdr, .* be read\.$"
    ):
        open_recording(path, topic="/odd")


def test_messages_in_an_unknown_encoding_are_left_out_of_a_topic(tmp_path):
    scan = encoded(2, message(2, [1.0, 2.0]))
    path = mcap(tmp_path / "one.mcap", ("/scan", "flatbuffer", SCAN, b"odd"), ("/scan", "cdr", SCAN, scan))
    recording = open_recording(path)
    assert recording.ranges.tolist() == [1.0, 2.0] * 3
    assert "Some of the messages of /scan were left out" in recording.account.notices[0].text


def test_json_without_a_schema_is_known_by_its_first_message(tmp_path):
    path = mcap(tmp_path / "json.mcap", ("/state", "json", None, b'{"battery": 1}'), ("/front", "json", None, JSON))
    recording = open_recording(path)
    assert ([topic.name for topic in recording.topics], len(recording)) == (["/front"], 3)


def test_a_file_without_topics_says_what_to_record(tmp_path):
    with pytest.raises(ValueError, match=r"it has no topic at all\. Record the topic of the laser again\.$"):
        open_recording(mcap(tmp_path / "none.mcap"))


@pytest.mark.parametrize("lost", [b"", bytes(5000)])
@pytest.mark.parametrize("plugin", list(StoragePlugin))
def test_a_part_of_a_split_bag_that_cannot_be_opened_is_left_out(tmp_path, plugin, lost):
    (folder := tmp_path / "split").mkdir()
    suffix = "db3" if plugin == StoragePlugin.SQLITE3 else "mcap"
    for number in range(3):
        part = bag2(tmp_path / f"part_{number}", ("/scan", [1.0 + number]), plugin=plugin, stamps=(float(number),))
        shutil.copy(part / f"part_{number}.{suffix}", folder / f"split_{number}.{suffix}")
    (folder / f"split_0.{suffix}").write_bytes(lost)
    (folder / "metadata.yaml").write_text("".join(f"  - split_{number}.{suffix}\n" for number in range(4)))
    recording = open_recording(folder)
    assert recording.ranges.tolist() == [2.0, 3.0]
    told = {notice.kind: notice.text for notice in recording.account.notices}
    assert told["lost part"].startswith(f"split_0.{suffix} was left out, because it cannot be opened (begins with")
    assert told["missing part"] == f"Its metadata.yaml also names split_3.{suffix}, not in the folder."
    for number in (1, 2):
        (folder / f"split_{number}.{suffix}").unlink()
    with pytest.raises(ValueError, match=f"a damaged ROS 2 bag .split_0.{suffix} begins with"):
        open_recording(folder)


def test_a_bag_whose_messages_are_still_in_its_log_names_that_file(tmp_path):
    source = sqlite3.connect(bag2(tmp_path / "whole", ("/scan", [1.0])) / "whole.db3")
    writing = sqlite3.connect(tmp_path / "live.db3")
    writing.execute("PRAGMA journal_mode=WAL")
    writing.executescript("".join(f"{line}\n" for line in source.iterdump()))
    assert len(open_recording(tmp_path / "live.db3")) == 3
    (alone := tmp_path / "alone").mkdir()
    for name in ("live.db3", "live.db3-wal"):
        shutil.copy(tmp_path / name, alone / name)
    (alone / "live.db3").rename(alone / "moved.db3")
    writing.close()
    source.close()
    with pytest.raises(
        ValueError, match=r"without tables; its messages may be in moved\.db3-wal, .* so copy both files\.$"
    ):
        open_recording(alone / "moved.db3")
    with pytest.raises(ValueError, match=r"live\.db3-wal is the log of .*; open the \.db3 of the same name"):
        open_recording(alone / "live.db3-wal")


@pytest.mark.parametrize("seen", [4, 256])
def test_what_lies_before_and_after_a_damaged_page_of_a_database_is_read_once(tmp_path, monkeypatch, seen):
    monkeypatch.setattr(ros2, "ROWS", seen)
    stamps = [100.0 + number for number in range(1000)]
    path = bag2(tmp_path / "bag", ("/scan", [1.0] * 40), ("/rear", [2.0] * 20), stamps=stamps) / "bag.db3"
    whole = open_recording(path)
    assert [(topic.name, topic.scans) for topic in whole.topics] == [("/scan", 1000), ("/rear", 1000)]
    data = bytearray(path.read_bytes())
    at = data.index(whole.stamps[530].astype("<i4").tobytes()) // 4096 * 4096
    data[at : at + 4096] = bytes(4096)
    path.write_bytes(data)
    recording = open_recording(path)
    read = recording.stamps.tolist()
    assert read == sorted(set(read)) == [stamp for stamp in stamps if stamp in read]
    assert 980 < len(read) < 1000
    assert [(topic.name, topic.scans > 980) for topic in recording.topics] == [("/scan", True), ("/rear", True)]
    assert recording.topics[0].scans == len(read)
    assert "breaks off" in [notice.kind for notice in recording.account.notices]
