"""Which reader opens a file, and the error if none does."""

import gzip
from contextlib import ExitStack
from pathlib import Path

import pytest

from lineseg.readers import READERS, format_of, open_recording
from lineseg.readers.account import Notes
from lineseg.readers.containers.wrapping import unwrapped

FLASER = b"FLASER 3 1.0 2.0 3.0 0 0 0 0 0 0 1.0 x 1.0\n"


def test_content_decides_before_the_suffix(tmp_path):
    for name in ("walk.bag", "walk.npz", "walk.csv", "walk"):
        path = tmp_path / name
        path.write_bytes(FLASER)
        assert open_recording(path).format == "CARMEN log"


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("empty.bag", b"", "empty.bag is empty; a ROS 1 bag has #ROSBAG V2.0 at its beginning."),
        ("blank.log", b" \n\n", "blank.log is empty; a CARMEN log has lines that begin with FLASER"),
        ("junk.mcap", b"\0\1\2\3" * 50, "junk.mcap begins with b'.*', which is not a known format; a MCAP has"),
        (
            "junk",
            b"\0\1\2\3" * 50,
            "junk begins with .* Known formats: ROS 1 bag, ROS 2 bag, MCAP, failure pack, NPZ, .*, text",
        ),
        (
            "words.log",
            b"Hello world\n",
            "words.log has no laser line; it begins with 'Hello world'; a CARMEN log has lines that",
        ),
        (
            "walk.bag.gz",
            gzip.compress(b"#ROSBAG V2.0\n", mtime=0),
            "walk.bag.gz: a damaged ROS bag",
        ),
        (
            "short.log.gz",
            gzip.compress(FLASER, mtime=0)[:12],
            "short.log.gz: the gzip data are incomplete or damaged .* has no laser line",
        ),
        ("short.npz", b"PK\x03\x04" + b"\0" * 20, "short.npz: a damaged NPZ file"),
        ("short.db3", b"SQLite format 3\0" + b"\0" * 99, "short.db3: a damaged ROS 2 bag"),
        ("short.mcap", b"\x89MCAP0\r\n" + b"\0" * 9, "short.mcap: a damaged MCAP"),
        ("new.bag", b"#ROSBAG VX\n", "new.bag begins with '#ROSBAG VX'; a ROS bag begins with #ROSBAG V2.0"),
    ],
)
def test_an_unreadable_file_gives_one_sentence(tmp_path, name, content, sentence):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(ValueError, match=f"^{sentence}") as raised:
        open_recording(path)
    assert "\n" not in str(raised.value)


def test_a_folder_without_bag_says_what_a_bag_has(tmp_path):
    with pytest.raises(ValueError, match="is a folder without a ROS 2 recording, which has"):
        open_recording(tmp_path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere.bag: there is no such file or folder\.$"):
        open_recording(tmp_path / "nowhere.bag")


def test_no_two_formats_claim_a_suffix():
    suffixes = [suffix for reader in READERS for suffix in reader.suffixes]
    assert len(suffixes) == len(set(suffixes))


MAGIC = {
    "ROS 1 bag": b"#ROSBAG V2.0\n",
    "ROS 2 bag": b"SQLite format 3\0",
    "MCAP": b"\x89MCAP0\r\n",
    "failure pack": b"PK\x03\x04" + b"\0" * 22 + b"\x0c\0\0\0lineseg.json",
    "NPZ": b"PK\x03\x04" + b"\0" * 22 + b"\x0a\0\0\0ranges.npy",
    "NPY": b"\x93NUMPY\x01\0",
    "point cloud": b"# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS x y z\n",
    "CARMEN log": b"# " + b"x" * 80 + b"\nODOM 0 0 0 0 0 0 1 h 1\n",
    "Player log": b"## Player version 3.0.2\n",
    "UrgBenri log": b"[appName]\nUrgBenri\n",
    "SICK telegrams": b"\x02sSN LMDscandata 1 1 89A27F 0 0 1 1 5 6 ",
    "JSON": b'{"ranges": [',
    "XML": b"<?xml version='1.0'?>\n<data>",
    "printed messages": b"sensor_msgs.msg.LaserScan(header=std_msgs.msg.Header(",
    "MAT": b"MATLAB 5.0 MAT-file, Platform: GLNXA64",
    "MATLAB": b"% scans\nangle_min = -pi/2;\nranges = [\n",
    "echo": b"header:\n  stamp:\n    sec: 1\nangle_min: -1.5\n",
    "YAML": b"scan:\n" + b"- 1.5\n" * 60,
    "text": b"angle,distance\n",
}


def bytes_read():
    """How many bytes this process has read so far, by the count of the system."""
    return int(Path("/proc/self/io").read_text().split()[1])


@pytest.mark.skipif(not Path("/proc/self/io").exists(), reason="the system does not count bytes that are read")
@pytest.mark.parametrize("format", [reader.format for reader in READERS])
def test_recognising_a_format_reads_little_of_a_large_file(tmp_path, format):
    path = tmp_path / "large.bin"
    with path.open("wb") as file:
        file.write(MAGIC[format] + b"1.0, 2.0\n" * 10_000)
        file.truncate(1 << 30)  # what is not written takes no space
    found = []
    for _ in range(2):  # the first imports what it needs
        before = bytes_read()
        with ExitStack() as stack:
            found.append(format_of(unwrapped(path, stack, Notes(), lambda done, total: None)))
        spent = bytes_read() - before
    assert found == [format] * 2
    assert 0 < spent < 1 << 20
