"""The trace as sent to the page: once, in columns that match the decisions."""

from __future__ import annotations

import pytest
from lineseg_app.frame.findings import findings
from lineseg_app.frame.stepping import columns_of
from lineseg_app.places import data_folder
from lineseg_app.tuning.sweep import sweep, values_of
from live import Address, Page

from lineseg import Params, extract, open_recording
from lineseg.baselines.ransac import RansacParams


@pytest.mark.parametrize("name", ["lessons/2_grazing_wall", "lessons/6_curved_wall", "laboratory"])
def test_the_columns_hold_every_decision(name):
    found = findings(open_recording(data_folder("sample_scans") / f"{name}.npz"), 0, "region-growing", Params())
    columns = columns_of(found)
    assert columns["total"] == len(found.trace)
    for decision in found.trace:
        at = decision.index
        assert columns["kinds"][columns["kind"][at]] == decision.kind
        assert columns["checks"][columns["check"][at]] == decision.check
        assert columns["phases"][columns["phase"][at]] == decision.phase
        assert [columns[field][at] for field in ("first", "last", "beam", "points")] == [
            decision.first,
            decision.last,
            decision.beam,
            decision.points,
        ]
        assert (columns["a"][at], columns["c"][at]) == pytest.approx((decision.line[0], decision.line[2]), abs=1e-8)
        assert columns["text"][at] == decision.text
        assert columns["others"].get(at) == pytest.approx(decision.other, abs=1e-8)
        assert columns["ends"].get(at) == pytest.approx(decision.ends, abs=1e-6)
    for level, starts in columns["starts"].items():
        assert starts == found.trace.starts(level).tolist()
    assert columns["jumps"] == {jump: found.trace.jump(jump).tolist() for jump in found.trace.vocabulary.jumps}
    assert columns["jumps"].keys() == {"refusal", "seed", "line", "drop", "merge", "cut"}


def test_a_method_without_cuts_has_no_jump_to_them():
    scan = open_recording(data_folder("sample_scans") / "laboratory.npz")
    columns = columns_of(findings(scan, 0, "ransac", RansacParams()))
    assert columns["jumps"].keys() == {"seed", "line", "drop"}


def test_a_page_in_mode_learn_gets_the_trace_once(page: Page):
    page.hello()
    page.ask(mode="learn", step=0)
    traced = page.hear_a("trace", "drawn")
    assert traced["type"] == "trace" and traced["trace"]["total"] > 20
    page.hear_a("drawn")
    page.ask(step=1)
    assert page.hear_a("trace", "drawn")["type"] == "drawn"
    page.ask(params={"epsilon": 0.02})
    assert page.hear_a("trace", "drawn")["type"] == "trace"


def test_other_modes_get_no_trace(page: Page):
    page.hello()
    page.ask(step=3)
    assert page.hear_a("trace", "drawn")["type"] == "drawn"


def test_a_sweep_shows_what_an_extraction_finds_at_each_value():
    scan = open_recording(data_folder("sample_scans") / "laboratory.npz")[0]
    swept = sweep(scan, "region-growing", Params(), "min_length")
    for value, lines, runs in list(zip(swept["values"], swept["lines"], swept["runs"], strict=True))[::20]:
        segments = extract(scan, Params().but(min_length=value)).segments
        assert lines == len(segments)
        assert {line.first for line in segments} <= {first for first, _, _ in runs}


def test_a_sweep_of_a_count_has_whole_values():
    kind, knob = next((kind, knob) for name, kind, knob in Params.knobs() if name == "seed_points")
    assert values_of(kind, knob) == [float(value) for value in range(3, 21)]


def test_a_sweep_of_an_unknown_threshold_names_the_known_ones(page: Page, server: Address):
    page.hello()
    answer = server.get("/api/sweep", params={"session": page.welcome["session"], "name": "zeta"})
    assert answer.status_code == 400 and "epsilon" in answer.json()["message"]
    assert server.get("/api/sweep", params={"session": "none"}).status_code == 404
