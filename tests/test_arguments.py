"""Passing an object of the wrong type raises an error that says what to pass."""

from pathlib import Path

import numpy as np
import pytest
from scenes import wall_ahead

import lineseg
from lineseg import EXTRACTORS, Params, Recording, Scan, Thresholds

SCAN = wall_ahead(2.0)
RECORDING = Recording.from_scans([SCAN])
ARRAY = np.ones((3, 4))
OF_SCANS = [lineseg.extract, lineseg.trace, lineseg.misses, lineseg.true_lines, lambda scan: lineseg.what_if(scan, 0)]
OF_RECORDINGS = [
    lineseg.survey,
    lambda recording: lineseg.why(recording, 0),
    lambda recording: next(lineseg.agreements(recording)),
    lambda recording: lineseg.save_npz(recording, Path("never.npz")),
    lambda recording: lineseg.write_pack(Path("never.zip"), recording, 0),
]
OF_THRESHOLDS = [
    lambda params: lineseg.extract(SCAN, params),
    lambda params: lineseg.trace(SCAN, params),
    lambda params: lineseg.survey(RECORDING, params),
    lambda params: lineseg.misses(SCAN, params),
    lambda params: lineseg.what_if(SCAN, 0, params),
    lambda params: lineseg.write_pack(Path("never.zip"), RECORDING, 0, params),
]


@pytest.mark.parametrize("function", OF_SCANS)
@pytest.mark.parametrize(
    ("given", "says"),
    [
        (ARRAY, r"not an array of shape \(3, 4\); Scan\.regular\(ranges, angle_min, angle_increment\)"),
        ([1.0, 2.0], r"not list; Scan\.regular"),
        (RECORDING, r"not Recording; recording\[0\] .* survey\(recording\)"),
        ("hallway.npz", r"not 'hallway.npz'; open_recording\(path\)\[0\]"),
    ],
)
def test_what_needs_a_scan_says_how_to_get_one(function, given, says):
    with pytest.raises(TypeError, match=f"^pass a Scan, {says}"):
        function(given)


@pytest.mark.parametrize("function", OF_RECORDINGS)
@pytest.mark.parametrize(
    ("given", "says"),
    [
        (ARRAY, r"not an array of shape \(3, 4\); Recording\.from_scans\(scans\) .* Scan\.regular"),
        ([SCAN], r"not list; Recording\.from_scans\(scans\)"),
        (SCAN, r"not Scan; Recording\.from_scans\(\[scan\]\)"),
        (Path("hallway.npz"), r"not \w+Path; open_recording\(path\)"),
    ],
)
def test_what_needs_a_recording_says_how_to_get_one(function, given, says):
    with pytest.raises(TypeError, match=f"^pass a Recording, {says}"):
        function(given)


@pytest.mark.parametrize("function", OF_THRESHOLDS)
@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"epsilon": 0.02}, r"not dict; Params\(\*\*values\)"),
        ({}, r"not dict; Params\(\*\*values\)"),
        (Params, r"not the class Params; Params\(\)"),
        ("ransac", r"not 'ransac'; EXTRACTORS"),
        (0.02, r"not float; EXTRACTORS"),
    ],
)
def test_what_needs_thresholds_says_how_to_get_them(function, given, says):
    with pytest.raises(TypeError, match=f"^pass Params.*, {says}"):
        function(given)


@pytest.mark.parametrize("given", [ARRAY, b"hallway.npz", 3])
def test_what_needs_a_file_says_so(given):
    with pytest.raises(TypeError, match=r"^pass the path of a file or folder, not "):
        lineseg.open_recording(given)


def test_thresholds_of_one_method_are_not_those_of_another():
    with pytest.raises(TypeError, match=r"^pass RansacParams, not Params"):
        lineseg.what_if(SCAN, 0, Params(), method="ransac")
    with pytest.raises(TypeError, match=r"^pass Params, not RansacParams"):
        next(lineseg.agreements(RECORDING, EXTRACTORS["ransac"].params_type()))


def test_thresholds_of_no_method_are_named():
    class Mine(Thresholds):
        def __post_init__(self) -> None: ...

    with pytest.raises(TypeError, match=r"^no method of EXTRACTORS takes Mine"):
        lineseg.extract(SCAN, Mine())


def test_a_scan_of_lists_says_that_arrays_are_needed():
    with pytest.raises(TypeError, match=r"^ranges must be an array, not list; numpy\.asarray\(ranges\) makes one"):
        Scan([1.0, 2.0], np.zeros(2))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"^bearings must be an array, not tuple"):
        Scan(np.ones(2), (0.0, 0.1))  # type: ignore[arg-type]
