"""Lines are cut where they step aside, as at a door set back a little, and nowhere else."""

import numpy as np
import pytest
from scenes import scan_of

from lineseg import Params, Scan, extract
from lineseg.proposal.steps import cut_at_steps

LOOSE = Params(epsilon=0.1)
DEPTH = 0.06
# A wall 2 m ahead, with a door from 0 to 1 m.
DOOR = [(2, -3, 2, 0), (2, 0, 2 + DEPTH, 0), (2 + DEPTH, 0, 2 + DEPTH, 1), (2 + DEPTH, 1, 2, 1), (2, 1, 2, 3)]


def pieces(scan: Scan, params: Params = LOOSE) -> tuple[list[np.ndarray], float]:
    """The beams of each piece, and the share of lines that step."""
    (labels,), share = cut_at_steps([scan], [extract(scan, params)], params)
    return [np.flatnonzero(labels == piece) for piece in range(labels.max() + 1)], share


def seen(walls: list, **options) -> Scan:
    return scan_of(walls, **{"beams": 361, "field_of_view": np.radians(140), "noise": 0.005} | options)


def test_a_line_that_takes_in_a_door_is_cut_at_both_jambs():
    scan = seen(DOOR)
    assert len(extract(scan, LOOSE).segments) == 1
    found, share = pieces(scan)
    assert share == 1.0
    ends = [scan.xy[piece[-1], 1] for piece in found[:-1]]
    assert ends == pytest.approx([0.0, 1.0], abs=0.05)


def test_a_wall_that_bends_is_not_cut():
    scan = seen([(2, -3, 2, 3)])
    bends = Scan(scan.ranges + 0.03 * np.sin(4 * scan.bearings), scan.bearings)
    found, share = pieces(bends)
    assert [len(piece) for piece in found] == [line.points for line in extract(bends, LOOSE).segments]
    assert share == 0.0


def test_pieces_too_short_for_a_line_are_left_out():
    found, _ = pieces(seen(DOOR), LOOSE.but(min_length=1.5))
    assert len(found) == 2


@pytest.mark.parametrize("turn", [300, 360, 380])
def test_a_line_across_the_seam_is_cut_as_elsewhere(turn: int):
    scan = scan_of(DOOR, beams=720, field_of_view=2 * np.pi, noise=0.005)
    turned = Scan(np.roll(scan.ranges, turn), scan.bearings)
    expected = {frozenset((piece + turn) % 720) for piece in pieces(scan)[0]}
    assert len(expected) == 3
    assert set(map(frozenset, pieces(turned)[0])) == expected


def test_without_lines_there_is_nothing_to_cut():
    blank = Scan.regular(np.full(100, np.inf), 0.0, 0.01)
    (labels,), share = cut_at_steps([blank], [extract(blank)], LOOSE)
    assert (labels == -1).all()
    assert share == 0.0
