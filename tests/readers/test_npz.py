import subprocess
import sys
import zipfile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from lineseg import Recording, Scan
from lineseg.readers import open_recording, save_npz

GEOMETRY = {"angle_min": -0.5, "angle_increment": 0.1}


@pytest.fixture
def npz(tmp_path):
    def write(**values):
        path = tmp_path / "hall.npz"
        np.savez(path, **values)
        return path

    return write


def scans(**fields):
    lengths = st.lists(st.integers(1, 12), min_size=1, max_size=5)
    ranges = lengths.flatmap(
        lambda each: st.tuples(
            *(arrays(np.float32, n, elements=st.floats(0, 50, width=32) | st.just(np.nan)) for n in each)
        )
    )
    return ranges.map(
        lambda rows: [
            Scan.regular(row, -1.0, 0.25, range_max=30.0, stamp=float(i), **fields) for i, row in enumerate(rows)
        ]
    )


@given(scans(frame_id="laser"))
def test_a_saved_recording_comes_back_as_it_was(tmp_path_factory, scans):
    recording = Recording.from_scans(scans, "hall")
    path = tmp_path_factory.mktemp("npz") / "hall.npz"
    save_npz(recording, path)
    back = open_recording(path)
    assert (back.ranges.dtype, back.frame_ids, back.format) == (np.float32, recording.frame_ids, "NPZ")
    for name in ("ranges", "offsets", "angle_min", "angle_increment", "range_min", "range_max", "stamps"):
        assert np.array_equal(getattr(back, name), getattr(recording, name), equal_nan=True), name
    assert back.bearings is None


def test_truth_poses_and_uneven_bearings_come_back(tmp_path):
    made = [
        Scan(np.array([1.0, 2.0, 3.0]), np.array([0.0, 0.1, 0.5]), wall=np.array([0, -1, 1]), frame_id=name)
        for name in ("front", "front")
    ]
    recording = Recording.from_scans(made, poses=np.arange(6.0).reshape(2, 3), walls=np.arange(8.0).reshape(2, 4))
    save_npz(recording, tmp_path / "truth.npz")
    back = open_recording(tmp_path / "truth.npz")
    assert back.frame_ids == ("front", "front")
    for name in ("bearings", "wall", "poses", "walls"):
        assert np.array_equal(getattr(back, name), getattr(recording, name)), name


def test_one_scan_with_single_values_is_enough(npz):
    recording = open_recording(npz(ranges=[1, 2, 3], **GEOMETRY))
    assert (len(recording), recording.beams, recording.ranges.dtype) == (1, (3, 3), np.float64)
    assert recording[0].bearings.tolist() == pytest.approx([-0.5, -0.4, -0.3])
    assert recording.range_max.tolist() == [np.inf]


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"scan": [1.0]}, "there is no array 'ranges'; it has scan. Required: ranges"),
        ({"ranges": [1.0], "angle_min": 0.0}, "there is no array 'angle_increment'"),
        ({"ranges": np.ones((2, 2, 2)), **GEOMETRY}, r"ranges has the shape \(2, 2, 2\); required:"),
        (
            {"ranges": np.ones((2, 3)), **GEOMETRY, "stamps": np.ones(5)},
            r"stamps has the shape \(5,\); .* each of 2 scans",
        ),
        ({"ranges": np.ones((2, 3)), **GEOMETRY, "wall": np.ones((3, 2), int)}, r"wall has the shape \(3, 2\)"),
        (
            {"ranges": np.ones((2, 3)), **GEOMETRY, "poses": np.ones((3, 3))},
            r"poses has the shape \(3, 3\); it needs \(2, 3\)",
        ),
        ({"ranges": np.ones((2, 3)), **GEOMETRY, "beams": [3, 9]}, "beams has the value 9; a row of ranges has only 3"),
        ({"ranges": np.array(["a"]), **GEOMETRY}, "ranges has the type <U1; it must contain numbers"),
        ({"ranges": [1.0], "angle_min": np.nan, "angle_increment": 0.1}, "angle_min has a value that is not finite"),
        ({"ranges": np.array([{}]), **GEOMETRY}, "'ranges' has Python objects, which are not loaded"),
        ({"ranges": np.ones((0, 5)), **GEOMETRY}, "has no scan"),
        ({"ranges": np.ones((2, 3)), **GEOMETRY, "frame_id": ["a", "b", "c"]}, r"frame_id has the shape \(3,\)"),
    ],
)
def test_arrays_that_do_not_fit_are_named(npz, values, sentence):
    with pytest.raises(ValueError, match=rf"^hall.npz:? ?.*{sentence}"):
        open_recording(npz(**values))


def test_a_zip_archive_that_states_more_than_memory_holds_is_refused(tmp_path):
    path = tmp_path / "bomb.npz"
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (999999999999, 999999999), }"
    header += b" " * (117 - len(header)) + b"\n"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("ranges.npy", b"\x93NUMPY\x01\x00\x76\x00" + header)
    with pytest.raises(ValueError, match=r"^bomb.npz: "):
        open_recording(path)


@pytest.mark.parametrize("ranges", [np.ones((1, 1 << 26), np.uint8), np.ones((1 << 23, 0))])
def test_numbers_of_a_byte_and_scans_without_beams_are_counted_as_what_they_become(tmp_path, ranges):
    np.savez_compressed(tmp_path / "hall.npz", ranges=ranges, angle_min=0.0, angle_increment=1e-7)
    with pytest.raises(ValueError, match=r"^hall.npz would have more than 256 MB unpacked, which is not allowed"):
        open_recording(tmp_path / "hall.npz")


def test_arrays_that_would_become_too_large_are_refused_and_what_is_no_array_is_not_unpacked(tmp_path):
    path = tmp_path / "hall.npz"
    np.savez(path, ranges=np.ones((2, 11), np.float32), **GEOMETRY)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive, archive.open("about.json", "w") as entry:
        for _ in range(300):
            entry.write(bytes(1 << 20))
    assert len(open_recording(path)) == 2
    np.savez_compressed(path, ranges=np.zeros((300, 1 << 18), np.float32), **GEOMETRY)
    with pytest.raises(ValueError, match=r"^hall.npz would have more than 256 MB unpacked, which is not allowed"):
        open_recording(path)


@pytest.mark.parametrize("form", ["complex", "pairs", "planes", "angles"])
def test_pairs_of_numbers_are_points_or_angles_and_distances_of_each_scan(tmp_path, form):
    bearings = np.linspace(-1.5, 1.5, 181)
    ranges = np.array([[2.0], [3.0]]) / np.cos(0.8 * bearings)
    points = np.stack([ranges * np.cos(bearings), ranges * np.sin(bearings)], axis=-1)
    array = {
        "complex": points[..., 0] + 1j * points[..., 1],
        "pairs": points,
        "planes": points.swapaxes(1, 2),
        "angles": np.stack([np.broadcast_to(bearings, ranges.shape), ranges], axis=-1),
    }[form]
    np.save(tmp_path / "array.npy", array)
    recording = open_recording(tmp_path / "array.npy")
    assert recording.ranges == pytest.approx(ranges.ravel())
    assert recording[1].bearings == pytest.approx(bearings)
    assert any(guess.field == "columns" for guess in recording.account.guesses) == (form != "complex")
    with pytest.raises(ValueError, match="has 2 numbers for each beam; columns must name them, such as x,y"):
        open_recording(tmp_path / "array.npy", columns="stamp,x,y")


def test_a_file_that_another_program_makes_shorter_does_not_end_the_process(tmp_path):
    """A file that is mapped into memory would end it with a signal."""
    path = tmp_path / "array.npy"
    np.save(path, np.ones((100, 1000)))
    whole = path.read_bytes()
    program = """
import os, sys
from pathlib import Path
from lineseg.readers.account import Notes
from lineseg.readers.arrays import loaded

path = Path(sys.argv[1])
array = loaded(path, Notes())
os.truncate(path, 0)
print(array.sum())
"""
    for content, total in ((whole, "100000.0\n"), (whole[:-8], "99000.0\n")):
        path.write_bytes(content)
        ended = subprocess.run([sys.executable, "-c", program, path], capture_output=True, text=True)
        assert (ended.returncode, ended.stdout) == (0, total), ended.stderr
