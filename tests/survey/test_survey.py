"""A survey gives the result of `extract` for every frame of any recording."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import chipped, corner, room, scan_of, scans, wall_ahead
from waiting import SECONDS

from lineseg import EXTRACTORS, Cancelled, Params, Recording, Scan, extract, open_recording, trace
from lineseg.doubt import SCORES
from lineseg.survey import survey
from lineseg.survey.frame_by_frame import survey_stretch
from lineseg.survey.stretch import Stretch, Workspace, flattened

SAMPLES = Path(__file__).parents[2] / "sample_scans"
FEW = Params(min_points=2, min_length=0.0, seed_points=3, epsilon=0.1, delta=0.5)


def assert_agrees(recording, params=None, frames=None):
    result = survey(recording, params)
    assert len(result) == len(recording)
    assert result.scores.shape == (len(recording), len(SCORES))
    later = np.isin(list(SCORES), ("unstable", "disputed", "lapsed", "blank"))
    assert np.isfinite(result.scores[:, ~later]).all()
    assert np.isnan(result.scores[:, later]).all()
    for frame in range(len(recording)) if frames is None else frames:
        rows, segments = result[frame], extract(recording[frame], params).segments
        assert rows["first"].tolist() == [segment.first for segment in segments], frame
        assert rows["last"].tolist() == [segment.last for segment in segments], frame
        assert rows["points"].tolist() == [segment.points for segment in segments], frame
        for row, segment in zip(rows, segments, strict=True):
            assert np.allclose((row["a"], row["b"], row["c"]), segment.line, rtol=0, atol=1e-9)
            assert np.allclose((row["x1"], row["y1"], row["x2"], row["y2"]), (*segment.start, *segment.end), atol=1e-9)
            assert row["length"] == pytest.approx(segment.length, abs=1e-9)
            assert row["rms"] == segment.rms
    return result


@pytest.mark.parametrize("name", ["hallway.npz", "laboratory.npz", "hallway.log", "hallway.mcap", "hallway.csv"])
def test_a_survey_and_extract_agree_on_every_frame_of_a_sample(name):
    assert_agrees(open_recording(SAMPLES / name))


@pytest.mark.parametrize("lesson", sorted(path.name for path in (SAMPLES / "lessons").glob("*.npz")))
def test_a_survey_and_extract_agree_on_every_lesson(lesson):
    assert_agrees(open_recording(SAMPLES / "lessons" / lesson))


@pytest.mark.parametrize(
    ("folder", "suffix"), [("ros2_ld06_varying", ".db3"), ("ros1_utm30lx", ".bag"), ("ros1_rplidar_a", ".bag")]
)
def test_a_survey_and_extract_agree_on_every_frame_of_a_real_recording(data_dir, folder, suffix):
    assert_agrees(open_recording(next((data_dir / folder).glob(f"*{suffix}"))))


@settings(max_examples=60)
@given(st.lists(scans(), max_size=5), st.sampled_from([Params(), FEW, Params(max_dropout=0, merge_angle=0.0)]))
def test_frames_may_differ_in_beams_and_geometry(sweeps, params):
    assert_agrees(Recording.from_scans(sweeps), params)


@settings(max_examples=30)
@given(st.lists(scans(), min_size=1, max_size=4), st.integers(0, 1000))
def test_beams_may_be_unevenly_spaced(sweeps, seed):
    rng = np.random.default_rng(seed)
    uneven = [Scan(scan.ranges, scan.bearings + rng.uniform(0, 1e-3, len(scan))) for scan in sweeps]
    assert_agrees(Recording.from_scans(uneven * 2))


@settings(max_examples=20)
@given(st.lists(scans(full_circle=True), min_size=1, max_size=3), st.integers(1, 3))
def test_beams_may_be_missing_at_the_seam(sweeps, missing):
    chips = [chipped(scan, missing) for scan in sweeps]
    result = assert_agrees(Recording.from_scans(chips))
    lost = [scan.ranges.copy() for scan in sweeps]
    for ranges in lost:
        ranges[-missing:] = np.nan
    lost = survey(Recording.from_scans(Scan(*beams) for beams in zip(lost, (s.bearings for s in sweeps), strict=True)))
    assert np.array_equal(result.segments["first"], lost.segments["first"])
    assert np.allclose(result.score("change"), lost.score("change"), atol=1e-6)


def test_beams_may_be_announced_in_single_precision():
    scan = corner(noise=0.01)
    uneven = (scan.bearings + np.linspace(0, 0.01, len(scan)) ** 2).astype(np.float32)
    assert_agrees(Recording.from_scans([Scan(scan.ranges.astype(np.float32), uneven)] * 3))


def test_bearings_may_fall_from_beam_to_beam():
    scan = room(noise=0.01)
    falling = Recording.from_scans([Scan(scan.ranges[::-1].copy(), scan.bearings[::-1].copy())] * 2)
    result = assert_agrees(falling)
    assert result.score("change")[1] == 0


@pytest.mark.parametrize(
    "scan",
    [
        Scan(np.empty(0), np.empty(0)),
        Scan(np.array([2.0]), np.array([0.0])),
        Scan(np.array([2.0, 2.0]), np.array([0.0, 0.1])),
        Scan(np.full(50, np.nan), np.linspace(-1, 1, 50)),
        Scan(np.full(360, np.inf), np.linspace(-np.pi, np.pi, 361)[:360]),
        Scan(np.full(50, 2.0), np.full(50, np.nan)),
        Scan(np.full(50, 2.0), np.linspace(-1, 1, 50), range_min=np.nan),
        Scan(np.full(50, 2.0), np.zeros(50)),
        Scan(np.full(50, 1e-9), np.linspace(-1, 1, 50)),
        Scan(np.where(np.arange(50) % 2, -1.0, 0.0), np.linspace(-1, 1, 50)),
    ],
    ids=["empty", "one beam", "two", "all NaN", "all inf", "no bearing", "no range_min", "one ray", "tiny", "negative"],
)
def test_a_scan_without_points_has_no_segment(scan):
    alone = assert_agrees(Recording.from_scans([scan]))
    assert len(alone.segments) == 0
    among = assert_agrees(Recording.from_scans([wall_ahead(), scan, wall_ahead()]))
    assert np.diff(among.offsets).tolist() == [1, 0, 1]


def test_an_empty_recording_has_an_empty_survey():
    result = survey(Recording.from_scans([]))
    assert len(result) == 0
    assert result.scores.shape == (0, len(SCORES))


def test_a_scan_may_have_100_000_beams():
    many = room(beams=100_000, noise=0.01)
    assert len(assert_agrees(Recording.from_scans([many, many]))[0]) >= 4
    steps = np.repeat(np.random.default_rng(0).uniform(0, 3, 20_000), 5)
    crowded = Scan(room(beams=100_000).ranges + steps, many.bearings)
    narrow = FEW.but(epsilon=1e-3, delta=1e-2)
    assert len(assert_agrees(Recording.from_scans([crowded]), narrow).segments) > 10_000


def test_more_segments_than_were_expected_find_room():
    walls = [(2, 0.2 * k, 2, 0.2 * k + 0.19) for k in range(-30, 30)]
    sweeps = [scan_of(walls, beams=900, noise=0.001)] * 400
    assert_agrees(Recording.from_scans(sweeps), FEW, frames=range(0, 400, 37))


def test_without_scores_the_segments_are_the_same():
    recording = open_recording(SAMPLES / "hallway.npz")
    bare = survey(recording, scores=False)
    assert bare.scores is None
    assert np.array_equal(bare.segments, survey(recording).segments)
    with pytest.raises(ValueError, match="has no scores"):
        bare.score("gap")


def test_the_number_of_threads_changes_nothing():
    recording = open_recording(SAMPLES / "laboratory.npz")
    one, many = survey(recording, threads=1), survey(recording, threads=5)
    assert np.array_equal(one.segments, many.segments)
    assert np.array_equal(one.scores, many.scores, equal_nan=True)


def long_recording(frames=12_000):
    scans = list(open_recording(SAMPLES / "laboratory.npz"))
    return Recording.from_scans((scans * (frames // len(scans) + 1))[:frames])


@pytest.mark.parametrize("method", ["region-growing", "line-tracking"])
def test_a_survey_stops_before_the_next_chunk_and_a_chunk_before_the_next_frame(method):
    recording, params, flag, told = long_recording(3000), EXTRACTORS[method].params_type(), np.zeros(1, np.bool_), []

    def stop(done, total):
        told.append(done)
        flag[0] = True

    with pytest.raises(Cancelled):
        survey(recording, params, cancelled=flag, progress=stop, threads=1)
    assert len(told) == 1
    assert told[0] < len(recording) / 2
    counts, memory = np.full(len(recording), -1), Workspace(recording.beams[1])
    if isinstance(params, Params):
        stretch = Stretch(recording, flattened(recording), 0, len(recording), compared=True)
        stretch.run(params, memory, flag, counts, None)
    else:
        survey_stretch(recording, 0, len(recording), params, memory, flag, counts, None)
    assert (counts == -1).all()


def test_an_exception_in_progress_is_passed_on():
    def refuse(done, total):
        raise KeyError(f"{done} of {total}")

    before = set(threading.enumerate())
    with pytest.raises(KeyError, match="of 3000"):
        survey(long_recording(3000), progress=refuse)
    # Of others, such as those of a server of another test, some may end.
    assert set(threading.enumerate()) <= before


@pytest.mark.parametrize("threads", [1, 4])
def test_progress_ends_with_all_frames(threads):
    seen = []
    survey(long_recording(3000), progress=lambda done, total: seen.append((done, total)), threads=threads)
    assert seen[-1] == (3000, 3000)
    assert seen == sorted(seen)


def test_an_unknown_score_or_frame_is_refused():
    result = survey(Recording.from_scans([wall_ahead()]))
    with pytest.raises(ValueError, match="'misery'; choose from segments, coverage"):
        result.score("misery")
    with pytest.raises(IndexError, match="frame 1: the survey has the frames 0 to"):
        result[1]
    assert np.array_equal(result[-1], result[0])


def survey_nasty_scans():
    """Cases that could make a kernel leave its arrays; the test below runs them with numba's checks."""
    rng = np.random.default_rng(1)
    angles = np.linspace(-np.pi, np.pi, 401)[:400]
    sweeps = [
        Scan(np.empty(0), np.empty(0)),
        Scan(np.ones(1), np.zeros(1)),
        Scan(np.full(3, 2.0), np.array([0.0, 2.1, 4.2])),
        Scan(np.full(9, np.nan), np.linspace(-1, 1, 9)),
        Scan(np.full(400, 2.0), angles),
        Scan(rng.uniform(0.1, 5, 400), angles),
        Scan(np.where(rng.random(400) < 0.5, np.nan, 3.0), angles),
        Scan(np.full(400, 1.0), np.zeros(400)),
        room(noise=0.01),
        Scan(np.roll(room(noise=0.01).ranges, 45), room().bearings),
        corner(noise=0.01),
        wall_ahead(noise=0.02, lost=(3, 4, 5, 50)),
        *(Scan(np.full(n, 2.0), np.linspace(-1, 1, n)) for n in (2, 5, 6, 9, 10, 11)),
        Scan(room(beams=4000).ranges + 0.4 * (np.arange(4000) // 4 % 2), room(beams=4000).bearings),
    ]
    recording = Recording.from_scans(sweeps)
    for params in (Params(), FEW, Params(seed_points=20, min_points=100), Params(max_gap=0.05, merge_angle=0.0)):
        assert_agrees(recording, params)
        for scan in sweeps:
            assert trace(scan, params).extraction.segments == extract(scan, params).segments


def test_no_kernel_leaves_its_arrays():
    program = """
import numpy as np
from lineseg.total_least_squares import scatter_of_few
import test_survey
try:
    scatter_of_few(np.zeros(4), np.zeros(4), 0, 4)
except IndexError:
    test_survey.survey_nasty_scans()
    print("stayed inside")
"""
    environment = os.environ | {
        "NUMBA_BOUNDSCHECK": "1",
        # Sooner compiled; what is read and written is the same.
        "NUMBA_OPT": "0",
        "PYTHONPATH": os.pathsep.join(map(str, Path(__file__).parents[:2])),
    }
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=SECONDS
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "stayed inside"


def test_a_recording_of_chosen_frames_is_surveyed_as_they_were():
    recording = open_recording(SAMPLES / "hallway.npz")
    part = recording.only(np.array([7, 3, 3, 250]))
    whole, chosen = survey(recording), survey(part)
    for k, frame in enumerate([7, 3, 3, 250]):
        assert np.array_equal(chosen[k], whole[frame])
        assert part[k].stamp == recording[frame].stamp
        assert np.array_equal(part[k].wall, recording[frame].wall)
    assert part.poses is not None
    assert np.array_equal(part.poses, recording.poses[[7, 3, 3, 250]])
    assert len(recording.only(np.array([], int))) == 0
