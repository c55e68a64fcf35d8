"""Archives and failure packs that were made to do harm."""

import io
import json
import re
import tarfile
import zipfile

import numpy as np
import pytest

from lineseg import Recording, Scan, open_recording
from lineseg.readers import save_npz

TABLE = b"angle,distance\n" + b"".join(b"%g,%g\n" % (0.1 * k, 1 + 0.01 * k) for k in range(30))
NAMES = ["a\\..", "a\\..\\..\\over.csv", f"{'n' * 300}.csv", f"{'ä' * 180}.csv", "C:\\over.csv", "con.csv", "-rf.csv"]


@pytest.mark.parametrize("name", NAMES, ids=[name[:12] for name in NAMES])
@pytest.mark.parametrize("kind", ["zip", "tar", "cut.zip"])
def test_a_file_in_an_archive_stays_in_its_folder_whatever_its_name(tmp_path, monkeypatch, name, kind):
    inside = tmp_path / "temporary" / "inside"
    inside.mkdir(parents=True)
    monkeypatch.setattr("tempfile.tempdir", str(inside))
    path = tmp_path / f"odd.{kind}"
    if kind == "tar":
        with tarfile.open(path, "w") as archive:
            member = tarfile.TarInfo(name)
            member.size = len(TABLE)
            archive.addfile(member, io.BytesIO(TABLE))
    else:
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr(zipfile.ZipInfo(name), TABLE)
    if kind == "cut.zip":
        path.write_bytes(path.read_bytes()[:-30])
    assert len(open_recording(path)) == 1
    assert (list(inside.iterdir()), list(inside.parent.iterdir())) == ([], [inside])


def test_the_parts_of_a_bag_in_a_zip_count_together(tmp_path, monkeypatch):
    monkeypatch.setattr("lineseg.readers.containers.bounded.SMALL", 1 << 20)
    path = tmp_path / "bag.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for number in range(5):
            archive.writestr(f"bag/run_{number}.mcap", bytes(600_000))
    with pytest.raises(ValueError, match=r"run_1\.mcap in bag\.zip would have more than .* unpacked"):
        open_recording(path)


ABOUT = {"format": "lineseg failure pack", "version": 1, "recording": "a.bag", "frame": 3, "method": "ransac"}


@pytest.mark.parametrize("frame", ["9" * 5000, "9" * 400, "-5"])
def test_a_pack_with_an_impossible_frame_is_refused(tmp_path, frame):
    path = tmp_path / "a.zip"
    _pack(path, json.dumps(ABOUT | {"params": {}, "note": ""}).replace("3", frame))
    with pytest.raises(ValueError, match=r"a\.zip: .*(more digits than can be read|frames count from 0)"):
        open_recording(path)


def test_half_a_character_in_a_pack_can_be_told_to_the_page(tmp_path):
    path = tmp_path / "a.zip"
    _pack(path, json.dumps(ABOUT | {"params": {}, "note": "so\ud800"}))
    pack = open_recording(path).pack
    assert pack is not None and pack.note == "so?"


def _pack(path, about: str):
    frame = io.BytesIO()
    save_npz(Recording.from_scans([Scan.regular(np.ones(9), 0.0, 0.01)]), frame)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("lineseg.json", about)
        archive.writestr("frame.npz", frame.getvalue())


@pytest.mark.parametrize("offset", ["of the directory", "of the entry"])
def test_a_zip_whose_offsets_are_damaged_says_so_without_the_number_of_the_error(tmp_path, offset):
    with zipfile.ZipFile(tmp_path / "log.zip", "w") as archive:
        archive.writestr("a.log", "FLASER 3 1 1 1 0 0 0 0 0 0 1 h 1\n" * 9)
    content = bytearray((tmp_path / "log.zip").read_bytes())
    at = content.rindex(b"PK\5\6") + 16 if offset == "of the directory" else content.rindex(b"PK\1\2") + 42
    content[at : at + 4] = b"\xff\xff\xff\x7f"
    (tmp_path / "log.zip").write_bytes(content)
    with pytest.raises(ValueError, match=r"log\.zip") as error:
        open_recording(tmp_path / "log.zip")
    assert not re.search(r"Errno|Invalid argument", str(error.value))


def test_the_name_of_an_entry_with_odd_characters_is_told_in_a_line(tmp_path):
    name = "a\n\x1b[31m.csv"
    with zipfile.ZipFile(tmp_path / "odd.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, TABLE)
    content = bytearray((tmp_path / "odd.zip").read_bytes())
    content[30 + len(name)] = 0xFF
    (tmp_path / "odd.zip").write_bytes(content)
    with pytest.raises(ValueError, match=r"a\?\?\[31m\.csv in odd\.zip: .* damaged \(invalid block type\)"):
        open_recording(tmp_path / "odd.zip")
