"""MAT files of MATLAB, written here element by element as MATLAB does."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from lineseg import open_recording
from tests.readers.test_forms_of_tables import BEARINGS, FAR, NEAR, SCANS

HEADER = b"MATLAB 5.0 MAT-file, Platform: GLNXA64".ljust(124) + struct.pack("<H", 0x0100) + b"IM"
CLASSES = {"f8": (6, 9), "f4": (7, 7), "u2": (11, 4), "u4": (13, 6)}
STEP = np.pi / 180


def element(kind: int, data: bytes) -> bytes:
    if 0 < len(data) <= 4:
        return struct.pack("<HH", kind, len(data)) + data.ljust(4, b"\0")
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(name: str, value) -> bytes:
    """A matrix of numbers, a text, a struct (dict) or cells (list)."""
    if isinstance(value, dict):
        kind, shape = 2, (1, 1)
        letters = b"".join(key.encode().ljust(32, b"\0") for key in value)
        rest = element(5, struct.pack("<i", 32)) + element(1, letters)
        rest += b"".join(matrix("", each) for each in value.values())
    elif isinstance(value, list):
        kind, shape, rest = 1, (len(value), 1), b"".join(matrix("", each) for each in value)
    elif isinstance(value, str):
        kind, shape, rest = 4, (1, len(value)), element(17, value.encode("utf-16-le"))
    else:
        array = np.atleast_2d(value)
        kind, stored = CLASSES[array.dtype.str[1:]]
        shape, rest = array.shape, element(stored, array.tobytes(order="F"))
    head = element(6, struct.pack("<II", kind, 0)) + element(5, struct.pack("<2i", *shape)) + element(1, name.encode())
    return element(14, head + rest)


def saved(folder: Path, compressed: bool = False, **variables) -> Path:
    parts = [matrix(name, value) for name, value in variables.items()]
    if compressed:
        parts = [struct.pack("<II", 15, len(packed := zlib.compress(part))) + packed for part in parts]
    path = folder / "scans.mat"
    path.write_bytes(HEADER + b"".join(parts))
    return path


def check(recording) -> None:
    assert len(recording) == 2
    for scan, ranges in zip(recording, (NEAR, FAR), strict=True):
        assert scan.bearings == pytest.approx(BEARINGS, abs=1e-6)
        assert scan.ranges == pytest.approx(ranges, abs=1e-3)


@pytest.mark.parametrize("compressed", [False, True])
def test_arrays_are_read(tmp_path: Path, compressed: bool):
    path = saved(tmp_path, compressed, ranges=SCANS, angle_min=BEARINGS[0], angle_increment=STEP, note="a room")
    check(open_recording(path))


def test_units_in_names_are_followed(tmp_path: Path):
    millimetres = (1000 * SCANS).round().astype(np.uint16)
    check(open_recording(saved(tmp_path, ranges_mm=millimetres, angle_min_deg=-90.0, angle_step_deg=1.0)))


def test_scans_in_columns_beside_angles_in_a_struct_are_read(tmp_path: Path):
    check(open_recording(saved(tmp_path, scan={"Ranges": SCANS.T.astype(np.float32), "Angles": BEARINGS[:, None]})))


def test_messages_that_matlab_read_from_a_bag_are_read_with_their_stamps(tmp_path: Path):
    messages = [
        {
            "Header": {"Stamp": {"Sec": np.uint32(at + 5), "Nsec": np.uint32(500_000_000)}, "FrameId": "laser"},
            "AngleMin": np.float32(BEARINGS[0]), "AngleIncrement": np.float32(STEP),
            "RangeMin": np.float32(0), "RangeMax": np.float32(30), "Ranges": each.astype(np.float32)[:, None],
        }
        for at, each in enumerate(SCANS)
    ]  # fmt: skip
    recording = open_recording(saved(tmp_path, True, messages=messages))
    check(recording)
    assert recording.stamps == pytest.approx([5.5, 6.5])
    assert set(recording.frame_ids) == {"laser"}


def test_a_file_that_breaks_off_is_read_up_to_there(tmp_path: Path):
    path = saved(tmp_path, angles=BEARINGS, ranges=SCANS, more=np.zeros(9000))
    path.write_bytes(path.read_bytes()[:-5000])
    recording = open_recording(path)
    check(recording)
    assert recording.account is not None
    assert any("breaks off after angles, ranges" in notice.text for notice in recording.account.notices)


@pytest.mark.parametrize(
    ("variables", "sentence"),
    [
        ({"note": "a room"}, r"no array of numbers; save them in MATLAB.*'-v7'"),
        ({"ranges": SCANS, "angles": BEARINGS[:90]}, "angles has 90 values, but a row of ranges 181"),
    ],
)
def test_what_is_missing_is_said(tmp_path: Path, variables: dict, sentence: str):
    with pytest.raises(ValueError, match=sentence):
        open_recording(saved(tmp_path, **variables))


def test_damaged_bytes_are_one_sentence(tmp_path: Path):
    whole = saved(tmp_path, True, ranges=SCANS, angles=BEARINGS).read_bytes()
    random = np.random.default_rng(0)
    for _ in range(200):
        damaged = bytearray(whole)
        for at in random.integers(128, len(whole), 8):
            damaged[at] = random.integers(256)
        (tmp_path / "b.mat").write_bytes(damaged)
        try:
            open_recording(tmp_path / "b.mat")
        except ValueError as error:
            assert "b.mat" in str(error)


def test_empty_structs_and_arrays_end_nothing(tmp_path: Path):
    recording = open_recording(
        saved(tmp_path, empty={}, nothing=np.zeros((0, 0)), ranges=SCANS, angle_min=BEARINGS[0], angle_increment=STEP)
    )
    check(recording)


@pytest.mark.parametrize("length", range(8))
def test_variables_after_a_compressed_one_are_read_wherever_they_lie(tmp_path: Path, length: int):
    path = saved(tmp_path, compressed=True, note="a" * length)
    packed = path.read_bytes()
    path.write_bytes(packed + saved(tmp_path, angles=BEARINGS, ranges=SCANS).read_bytes()[128:])
    check(open_recording(path))


def test_an_angle_min_of_zero_is_no_missing_one(tmp_path: Path):
    assert open_recording(saved(tmp_path, ranges=SCANS, angle_min=0.0))[0].bearings[0] == 0


def numbers(kind: int, stored: int, count: int, flags: int = 0) -> bytes:
    """A matrix of zeros, each of one byte."""
    zeros = element(stored, bytes(count))
    head = element(6, struct.pack("<II", kind | flags, 0)) + element(5, struct.pack("<2i", 1, count))
    return element(14, head + element(1, b"ranges") + zeros * (2 if flags else 1))


def holding(kind: int, *parts: bytes) -> bytes:
    head = element(6, struct.pack("<II", kind, 0)) + element(5, struct.pack("<2i", 1, 1)) + element(1, b"ranges")
    return element(14, head + b"".join(parts))


@pytest.mark.parametrize(
    "made",
    [
        pytest.param(lambda: numbers(8, 1, 1 << 18), id="bytes"),
        pytest.param(lambda: numbers(8, 1, 1 << 17, flags=0x0800), id="complex numbers"),
        pytest.param(lambda: numbers(4, 2, 1 << 18), id="a text"),
        pytest.param(lambda: holding(1, bytes(1 << 18)), id="empty cells"),
        pytest.param(lambda: holding(2, element(5, struct.pack("<i", 1)), element(1, bytes(1 << 18))), id="names"),
    ],
)
def test_what_a_mat_file_becomes_in_memory_is_counted_not_only_what_it_unpacks_to(tmp_path, monkeypatch, made):
    monkeypatch.setattr("lineseg.readers.containers.bounded.SMALL", 1 << 20)
    packed = zlib.compress(made())
    path = tmp_path / "scans.mat"
    path.write_bytes(HEADER + struct.pack("<II", 15, len(packed)) + packed)
    with pytest.raises(ValueError, match=r"scans\.mat would have more than 1 MB unpacked, which is not allowed"):
        open_recording(path)


def test_two_lasers_in_structs_are_not_mixed_and_the_second_is_told(tmp_path: Path):
    front, rear = {"ranges": SCANS, "angles": BEARINGS}, {"ranges": SCANS + 1.0, "angles": BEARINGS[::-1]}
    recording = open_recording(saved(tmp_path, front=front, rear=rear))
    check(recording)
    assert any(
        "front.ranges was read; rear.ranges, rear.angles were not" in each.text for each in recording.account.notices
    )
