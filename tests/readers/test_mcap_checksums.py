"""The checksums of MCAP, which our sample has: each damage is told, and the rest of the file is read."""

import shutil
import struct

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin

from lineseg import open_recording
from lineseg.readers.bags.mcap_records import CHUNK, DATA_END, FOOTER, HEAD, MAGIC
from lineseg.simulate.mcap_checksums import add_checksums

from .test_ros_bags import bag2

SCANS, BEAMS = 600, 500


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A file of three chunks."""
    stamps = np.arange(1.0, 1 + SCANS)
    publishers = (("/scan", [1.0] * BEAMS), ("/other", [2.0]))
    folder = bag2(tmp_path_factory.mktemp("bag") / "b", *publishers, stamps=stamps, plugin=StoragePlugin.MCAP)
    file = folder / "b.mcap"
    add_checksums(file)
    return file


def records(content):
    """(opcode, where its content begins, its length) of each record."""
    at = len(MAGIC)
    while at < len(content) - len(MAGIC):
        opcode, length = HEAD.unpack_from(content, at)
        yield opcode, at + HEAD.size, length
        at += HEAD.size + length


def places(content, opcode):
    return [(at, length) for found, at, length in records(content) if found == opcode]


def damaged(whole, folder, opcode, number, byte, value=b"\x55"):
    """A copy in which a byte of a record is another; byte: from its beginning, or from its end if negative."""
    content = bytearray(whole.read_bytes())
    at, length = places(content, opcode)[number]
    place = at + (byte if byte >= 0 else length + byte)
    assert content[place : place + 1] != value
    content[place : place + 1] = value
    path = folder / "damaged.mcap"
    path.write_bytes(content)
    return path


def test_a_whole_file_has_every_checksum_and_nothing_to_tell(whole):
    content = whole.read_bytes()
    checksums = [content[at + 24 : at + 28] for at, _ in places(content, CHUNK)]
    checksums += [content[at : at + 4] for at, _ in places(content, DATA_END)]
    checksums += [content[at + 16 : at + 20] for at, _ in places(content, FOOTER)]
    assert len(checksums) == 5
    assert all(map(any, checksums))
    account = open_recording(whole).account
    assert (len(open_recording(whole)), account.skips, account.notices) == (SCANS, 0, ())


def test_the_scans_of_a_chunk_with_another_checksum_are_skipped_and_counted(whole, tmp_path):
    recording = open_recording(damaged(whole, tmp_path, CHUNK, 1, -100))
    at = places(whole.read_bytes(), CHUNK)[1][0] - HEAD.size
    assert recording.account.skips == SCANS - len(recording) > 100
    assert f"the first at damaged.mcap: the chunk at byte {at}: its checksum differs" in recording.account.skipped_text
    assert [notice.kind for notice in recording.account.notices] == []
    assert np.all(recording.ranges == 1.0)


def test_a_file_whose_every_chunk_is_damaged_is_refused(tmp_path):
    folder = bag2(tmp_path / "b", ("/scan", [1.0] * 10), plugin=StoragePlugin.MCAP)
    add_checksums(folder / "b.mcap")
    with pytest.raises(ValueError, match=r"^damaged\.mcap: the chunk at byte \d+: its checksum differs\.$"):
        open_recording(damaged(folder / "b.mcap", tmp_path, CHUNK, 0, -8))


def test_an_index_with_another_checksum_is_not_used(whole, tmp_path):
    content = whole.read_bytes()
    (at, _), (end, _) = places(content, FOOTER)[0], places(content, DATA_END)[0]
    (summary,) = struct.unpack_from("<Q", content, at)
    assert summary > end
    path = tmp_path / "damaged.mcap"
    shutil.copy(whole, path)
    with path.open("r+b") as file:
        file.seek(at - 60)
        file.write(b"\x55\xaa\x55")
    recording = open_recording(path)
    (notice,) = recording.account.notices
    assert (len(recording), notice.kind) == (SCANS, "checksum")
    assert "the checksum of its index differs" in notice.text


def test_damage_outside_of_the_chunks_is_told(whole, tmp_path):
    recording = open_recording(damaged(whole, tmp_path, DATA_END, 0, 0))
    (notice,) = recording.account.notices
    assert (len(recording), recording.account.skips, notice.kind) == (SCANS, 0, "checksum")
    assert "the checksum of its data differs" in notice.text
