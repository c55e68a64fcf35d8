"""The pseudocode of the page, compared with the decisions of the kernels."""

from __future__ import annotations

import json
from collections import Counter
from math import pi

import numpy as np
import pytest
from lineseg_app.places import data_folder

from lineseg import Params, Scan, Trace, open_recording, trace
from lineseg.region_growing.trace import VOCABULARY
from lineseg.simulate.worlds import WORLDS

LISTING = json.loads((data_folder("static") / "learn" / "listing.json").read_text("utf-8"))
EVENTS = [
    event for algorithm in LISTING["algorithms"] for line in algorithm["lines"] for event in line.get("events", ())
]
SAMPLES = sorted(
    [*(data_folder("sample_scans") / "lessons").glob("*.npz"), *data_folder("sample_scans").glob("*.npz")],
)


def events_of(traced: Trace) -> Counter[str]:
    """How the page names each decision; static/learn/trace.js does the same."""
    names = Counter()
    for decision in traced:
        check = f" ({decision.check})" if decision.check else ""
        way = {1: " forward", -1: " backward", 0: ""}[decision.direction]
        names[f"{decision.phase}: {decision.kind}{check}{way}"] += 1
    return names


def ring(radius: float = 3.0) -> Scan:
    """A room around the laser, whose walls merge under coarse thresholds."""
    bearings = np.linspace(-pi, pi, 360, endpoint=False)
    rng = np.random.default_rng(5)
    ranges = radius / np.maximum(np.abs(np.cos(bearings)), np.abs(np.sin(bearings))) + rng.normal(0, 0.02, 360)
    ranges[40:44] = np.inf
    return Scan(ranges.astype(np.float32), bearings)


def test_each_event_belongs_to_only_one_line():
    assert [event for event, times in Counter(EVENTS).items() if times > 1] == []


def test_every_event_names_a_decision_and_a_check_that_exist():
    for event in EVENTS:
        phase, _, rest = event.partition(": ")
        kind, _, check = rest.removesuffix(" forward").removesuffix(" backward").rstrip(")").partition(" (")
        assert phase in ("seed", "growth", "overlap", "endpoints")
        assert kind in VOCABULARY.names and check in VOCABULARY.check_names, event


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_every_decision_of_a_sample_has_its_line(path):
    recording = open_recording(path)
    for frame in range(0, len(recording), 60):
        for params in (
            Params(),
            Params().but(epsilon=0.008),
            Params().but(epsilon=0.15, max_gap=0.4, merge_angle=0.01),
        ):
            assert set(events_of(trace(recording[frame], params))) <= set(EVENTS)


def test_nearly_every_line_occurs_in_some_sample():
    met: Counter[str] = Counter()
    for params in (Params(), Params().but(epsilon=0.15, max_gap=0.2), Params().but(epsilon=0.08, merge_angle=0.001)):
        met += events_of(trace(ring(), params))
        for path in SAMPLES:
            met += events_of(trace(open_recording(path)[0], params))
    for name in ("lobby", "workshop"):
        for scan in WORLDS[name].recording(name, 24):
            met += events_of(trace(scan))
    unmet = set(EVENTS) - set(met)
    assert all(event.startswith("overlap: line dropped") for event in unmet), unmet
