"""Each lesson shows what its title says, with the thresholds of the paper, and changes as its text says."""

from pathlib import Path

import numpy as np
import pytest

from lineseg import Params, extract, trace
from lineseg.readers import open_recording
from lineseg.simulate.lessons import LESSONS

FOLDER = Path(__file__).parents[2] / "sample_scans" / "lessons"
DEFAULT = Params()


def lesson(number):
    (path,) = FOLDER.glob(f"{number}_*.npz")
    return open_recording(path)


def walls_of(scan, found):
    """For each segment the set of true walls of its beams."""
    return [set(scan.wall[found.labels == index].tolist()) for index in range(len(found.segments))]


def test_there_are_nine_lessons_of_one_frame():
    assert sorted(path.stem for path in FOLDER.glob("*.npz")) == [each.name for each in LESSONS]
    assert len(LESSONS) == 9
    assert all(len(each.recording()) == 1 for each in LESSONS)


@pytest.mark.parametrize("each", LESSONS, ids=lambda each: each.name)
def test_a_lesson_can_be_replayed_in_a_few_hundred_decisions(each):
    assert len(trace(each.recording()[0], DEFAULT)) < 300


def test_perfect_corner_two_lines_overlap_and_are_cut_at_the_corner():
    scan = lesson(1)[0]
    found = trace(scan, DEFAULT)
    assert len(found.indices("overlap cut")) == 1
    before, behind = found.extraction.segments
    assert before.end == pytest.approx((2.4, 1.2), abs=0.06)
    assert behind.start == pytest.approx((2.4, 1.2), abs=0.06)
    assert np.abs(np.dot(before.line[:2], behind.line[:2])) < 0.01


def test_grazing_wall_without_delta_a_line_joins_the_wall_and_the_door_leaf():
    scan = lesson(2)[0]
    leaf, wall = scan.wall[23], scan.wall[15]
    assert not any({leaf, wall} <= walls for walls in walls_of(scan, extract(scan, DEFAULT)))
    assert any({leaf, wall} <= walls for walls in walls_of(scan, extract(scan, DEFAULT.but(delta=1.0))))


def test_grazing_wall_delta_refuses_a_seed_that_epsilon_would_accept():
    found = trace(lesson(2)[0], DEFAULT)
    assert any(found[int(index)].check == "delta" for index in found.indices("seed rejected"))


def test_collinear_overlap_two_lines_of_one_wall_are_merged():
    scan = lesson(3)[0]
    found = trace(scan, DEFAULT)
    first, second = (found[int(index)] for index in found.indices("line kept"))
    assert second.first < first.last < second.last
    assert first.last - second.first >= 10
    assert len(found.indices("lines merged")) == 1
    (segment,) = found.extraction.segments
    assert segment.points == scan.valid.sum()


def test_collinear_overlap_stays_two_lines_when_nothing_is_merged():
    assert len(extract(lesson(3)[0], DEFAULT.but(merge_angle=0.0)).segments) == 2


def split(xy, first, last, limit):
    """Iterative end point fit: split at the point farthest from the chord until all are nearer than `limit`."""
    chord = xy[last] - xy[first]
    distances = np.abs((xy[first : last + 1] - xy[first]) @ np.array((-chord[1], chord[0]))) / np.hypot(*chord)
    farthest = first + int(distances.argmax())
    if distances.max() < limit or last - first < 2:
        return [(first, last)]
    return split(xy, first, farthest, limit) + split(xy, farthest, last, limit)


def test_lost_end_split_breaks_the_back_of_the_niche_and_region_growing_keeps_it_whole():
    scan = lesson(4)[0]
    beams = np.flatnonzero(scan.valid)
    xy, back = scan.xy[beams], scan.wall[beams] == 2
    pieces = [
        (first, last)
        for first, last in split(xy, 0, len(xy) - 1, limit=0.05)
        if last - first + 1 >= DEFAULT.min_points and np.hypot(*(xy[last] - xy[first])) >= DEFAULT.min_length
    ]
    kept = np.zeros(len(xy), dtype=bool)
    for first, last in pieces:
        kept[first : last + 1] = True
    assert np.count_nonzero(back & ~kept) >= 10

    found = extract(scan, DEFAULT)
    assert len(found.segments) == 3
    assert set(found.labels[beams][back].tolist()) == {1}


def test_shallow_corner_is_one_line_until_angle_or_fit_is_checked():
    scan = lesson(5)[0]
    unasked = DEFAULT.but(merge_rms=0.0)
    assert len(extract(scan, unasked).segments) == 1
    for params in (unasked.but(merge_angle=0.05), unasked.but(merge_rms=1.2)):
        parted = extract(scan, params)
        assert len(parted.segments) == 2
        first, second = (segment.theta for segment in parted.segments)
        assert abs(first - second) == pytest.approx(np.radians(4), abs=np.radians(1.5))


def test_curved_wall_becomes_chords_that_are_not_walls():
    scan = lesson(6)[0]
    found = walls_of(scan, extract(scan, DEFAULT))
    assert sum(walls == {-1} for walls in found) >= 3
    assert sum(0 in walls for walls in found) == 1


def test_doorway_splits_the_wall_until_longer_dropouts_are_crossed():
    scan = lesson(7)[0]
    assert walls_of(scan, extract(scan, DEFAULT)) == [{0}, {1}]
    assert walls_of(scan, extract(scan, DEFAULT.but(max_dropout=40, max_void=0.0)))[0] >= {0, 1}


def test_noise_burst_splits_the_wall_until_epsilon_is_as_wide_as_the_noise():
    scan = lesson(8)[0]
    found = extract(scan, DEFAULT)
    assert len(found.segments) == 2
    assert np.count_nonzero((found.labels == -1) & scan.valid) >= 8
    assert len(extract(scan, DEFAULT.but(epsilon=0.15)).segments) == 1
