"""The first scans of a long file, shown while the rest is read."""

import errno
import json
import sqlite3
from contextlib import closing

import numpy as np
import pytest
from bags import SCAN, STORES, bag1, bag2, encoded, message
from rosbags.rosbag1 import Writer
from rosbags.rosbag2 import StoragePlugin

from lineseg.readers import open_recording, parts

STAMPS = [100 + 0.025 * k for k in range(400)]


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    """A test need not wait between parts."""
    monkeypatch.setattr(parts, "FIRST", 0.0)
    monkeypatch.setattr(parts, "EVERY", 0.0)


def log(path, *publishers, stamps):
    """A CARMEN log as the bags, with messages of another kind between its lines."""
    ((_, ranges),) = publishers
    lines = [f"FLASER {len(ranges)} {' '.join(map(str, ranges))} 0 0 0 0 0 0 {stamp} robot {stamp}" for stamp in stamps]
    path.write_text("\n".join(f"ODOM 0 0 0 0 0 0 0 robot 0\n{line}" for line in lines))
    return path


def parts_of(path, **given):
    shown = []
    whole = open_recording(path, so_far=lambda part: shown.append((part, part.ranges.tolist())), **given)
    return whole, shown


@pytest.mark.parametrize(
    "write",
    [
        bag1,
        lambda *given, **more: bag2(*given, plugin=StoragePlugin.MCAP, **more),
        lambda *given, **more: bag2(*given, plugin=StoragePlugin.SQLITE3, **more),
        log,
    ],
)
def test_parts_are_the_first_scans_of_the_whole_in_the_same_memory(tmp_path, write):
    path = write(tmp_path / "long.bag", ("/scan", list(np.linspace(1, 5, 50))), stamps=STAMPS)
    whole, shown = parts_of(path)
    assert not whole.partial
    assert len(whole) == 400
    assert [len(part) for part, _ in shown] == sorted({len(part) for part, _ in shown})
    assert len(shown) > 2
    for part, ranges in shown:
        assert part.partial
        assert np.shares_memory(part.ranges, whole.ranges)
        assert part.ranges.tolist() == ranges
        assert part.stamps.tolist() == whole.stamps[: len(part)].tolist()
        assert part.frame_ids == whole.frame_ids[: len(part)]
        assert (part.poses is None) == (whole.format != "CARMEN log")
        assert part.account.line.startswith(whole.account.line.split(" · ")[0])


def test_the_first_of_many_lines_of_json_are_shown_as_they_are_in_the_whole(tmp_path):
    path = tmp_path / "long.jsonl"
    lines = [
        {"ranges": [1.0 + k / 400] * 40, "angle_min": -1.0, "angle_increment": 0.05, "stamp": stamp}
        for k, stamp in enumerate(STAMPS)
    ]
    path.write_text("\n".join(map(json.dumps, lines)))
    whole, shown = parts_of(path)
    assert (len(whole), whole.partial) == (400, False)
    assert len(shown) > 2
    for part, ranges in shown:
        assert part.partial
        assert ranges == whole.ranges[: len(ranges)].tolist()
        assert part.stamps.tolist() == whole.stamps[: len(part)].tolist()


def test_parts_stay_as_they_are_when_scans_grow_longer_than_the_first(tmp_path):
    with Writer(tmp_path / "growing.bag") as writer:
        scan = writer.add_connection("/scan", SCAN, typestore=STORES[1])
        for k in range(300):
            ranges = [1.0 + k] * (30 + k // 30)
            writer.write(scan, 10**9 * (100 + k), encoded(1, message(1, ranges, 100.0 + k)))
    whole, shown = parts_of(tmp_path / "growing.bag")
    assert len(shown) > 2
    for part, ranges in shown:
        assert part.ranges.tolist() == ranges == whole.ranges[: len(ranges)].tolist()


def test_a_reading_that_needs_the_whole_file_has_no_parts(tmp_path):
    path = bag1(tmp_path / "long.bag", ("/scan", [2.0] * 30), stamps=STAMPS)
    whole, shown = parts_of(path, frames="-100:")
    assert (len(whole), shown) == (100, [])


def test_scans_that_are_to_be_sorted_are_not_shown_before(tmp_path):
    path = bag2(tmp_path / "long", ("/scan", [2.0] * 30), stamps=STAMPS)
    (file,) = path.glob("*.db3")
    with closing(sqlite3.connect(file)) as database:
        database.execute("UPDATE messages SET timestamp = 1 WHERE id = (SELECT max(id) FROM messages) - 300")
        database.commit()
    whole, shown = parts_of(path)
    assert whole.stamps[0] == pytest.approx(STAMPS[99])
    assert max(len(part) for part, _ in shown) < 100


def test_a_disk_that_fails_does_not_make_a_damaged_file(tmp_path):
    path = log(tmp_path / "run.log", ("/scan", [2.0] * 30), stamps=STAMPS)

    def fails(done, total):
        raise OSError(errno.EIO, "Input/output error", str(path))

    with pytest.raises(OSError, match=r"^run\.log: its disk or network failed \(Input/output error\); copy the file"):
        open_recording(path, progress=fails)
