"""No line crosses a void, and none is cut on a wall at a grazing angle."""

import numpy as np
import pytest
from scenes import scan_of

from lineseg import Params, Scan, extract, open_recording, trace

OPEN, PAPER = Params(), Params(max_void=0.0)
# A wall 1 m beside the laser, with an open door from 6 to 6.9 m ahead.
WALLS = [(1, 1, 6, 1), (6.9, 1, 12, 1)]


def spans(scan: Scan, params: Params = OPEN) -> list[tuple[int, int]]:
    return [(segment.first, segment.last) for segment in extract(scan, params).segments]


def along_a_wall(walls=WALLS, **options) -> Scan:
    return scan_of(walls, beams=181, field_of_view=np.pi / 2, noise=0.002, **options)


@pytest.mark.parametrize("behind", [[], [(5, 3, 9, 3)]], ids=["nothing", "a room"])
def test_a_wall_ends_at_an_open_door(behind: list):
    scan = along_a_wall(WALLS + behind)
    door = scan.xy[:, 0]
    for first, last in spans(scan):
        assert not (min(door[first], door[last]) < 5.9 and max(door[first], door[last]) > 7.0)


def test_without_the_check_the_line_crosses_the_door_and_the_trace_says_what_stops_it():
    scan = along_a_wall()
    assert np.count_nonzero(~scan.valid[100:115]) == 2
    assert spans(scan, PAPER) == [(100, 180)]
    assert spans(scan) == [(109, 180)]
    stops = [each for each in trace(scan) if each.kind == "growth stopped" and each.check == "max_void"]
    assert {(stop.beam, stop.limit) for stop in stops} == {(106, 0.3), (109, 0.3)}
    assert "a void of 1.1" in stops[0].text


def test_a_wall_seen_at_a_grazing_angle_stays_whole_however_far_apart_its_points_are():
    scan = along_a_wall([(1, 1, 20, 1)])
    (line,) = spans(scan)
    steps = np.hypot(*np.diff(scan.xy[scan.valid], axis=0).T)
    assert steps.max() > 1.5
    assert line == spans(scan, PAPER)[0]


def test_a_lone_point_far_out_is_not_on_the_line_of_a_board_that_points_at_the_laser():
    # The board passes the laser 2 cm away; the next beam ends 5 m behind it, 6 cm beside its line.
    bearings = 0.02 - 0.001 * np.arange(9)
    ranges = np.array([*(0.02 / bearings[:8]), 6.5])
    wide = Params(epsilon=0.1, delta=1.0, min_points=3, max_occluder=0.0)
    crossing, board = (extract(Scan(ranges, bearings), params).segments for params in (wide.but(max_void=0.0), wide))
    assert max(segment.length for segment in crossing) > 5
    assert not [segment for segment in board if segment.length > 1]


def test_a_jump_to_another_surface_is_still_refused_by_epsilon():
    scan = scan_of([(2, -2, 2, 0), (4, 0, 4, 3)], noise=0.002)
    checks = {each.check for each in trace(scan) if each.kind == "growth stopped"}
    assert checks == {"epsilon", "end"}


def test_a_stray_point_in_a_door_does_not_join_the_wall_on_both_sides():
    wall = np.array([*np.linspace(-2, -0.45, 30), 0.0, *np.linspace(0.45, 2, 30)])
    bearings, ranges = np.arctan2(wall, 6.0), np.hypot(wall, 6.0)
    lost = np.linspace(bearings[29], bearings[30], 5)[1:-1], np.linspace(bearings[30], bearings[31], 5)[1:-1]
    beams = np.sort(np.concatenate((bearings, *lost)))
    measured = np.full(len(beams), np.nan)
    measured[np.searchsorted(beams, bearings)] = ranges
    assert len(spans(Scan(measured, beams), PAPER)) == 1
    assert len(spans(Scan(measured, beams))) == 2


@pytest.mark.parametrize("reverse", [1, -1])
def test_no_line_crosses_an_open_door_of_a_corridor(data_dir, reverse: int):
    recording = open_recording(data_dir.parent / "cases" / "doors_in_corridor" / "quarter_degree_room_behind.npz")
    for scan in recording:
        result = extract(Scan(scan.ranges[::reverse], scan.bearings[::reverse], scan.range_min, scan.range_max))
        for label in range(len(result.segments)):
            beams = np.flatnonzero(result.labels == label)
            gaps = np.hypot(*np.diff(scan.xy[::reverse][beams], axis=0).T)
            assert not (gaps[np.diff(beams) > 1] > 0.3).any()
