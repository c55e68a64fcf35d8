"""The drawn state: its lists of lines."""

from __future__ import annotations

from lineseg_app.frame.findings import findings_in
from lineseg_app.frame.state import _dropped_once
from lineseg_app.places import data_folder

from lineseg import Params, open_recording


def covered(line, n: int) -> set[int]:
    return {(line["first"] + k) % n for k in range((line["last"] - line["first"]) % n + 1)}


def test_a_dropped_line_that_grew_from_several_seeds_is_listed_once():
    scan = open_recording(data_folder("sample_scans") / "hallway.npz")[39]
    found = findings_in(scan, "region-growing", Params())
    listed, n = _dropped_once(found), len(scan)
    spans = [covered(line, n) for line in listed]
    assert len(listed) < len(found.drops)
    for k, one in enumerate(spans):
        assert all(2 * len(one & other) <= max(len(one), len(other)) for other in spans[:k])
    for first, last in found.drop_spans.T.tolist():
        span = covered({"first": first, "last": last}, n)
        assert any(2 * len(span & other) > len(span) for other in spans)


def test_the_beam_of_a_dropped_line_is_in_it_and_in_no_segment_if_possible():
    scan = open_recording(data_folder("sample_scans") / "hallway.npz")[39]
    found = findings_in(scan, "region-growing", Params())
    for line in _dropped_once(found):
        span = covered(line, len(scan))
        assert line["beam"] in span
        free = [beam for beam in span if scan.valid[beam] and found.extraction.labels[beam] < 0]
        assert not free or found.extraction.labels[line["beam"]] < 0
