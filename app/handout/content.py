"""What a page that stands alone shows: each decision, and the results over the range of each threshold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from lineseg import EXTRACTORS, Recording, Scan, Thresholds

from ..frame.findings import Findings, findings_in
from ..frame.framing import framing_of
from ..frame.geometry import Bounds, bounds_of
from ..frame.state import framing_told, segments_told
from ..frame.stepping import columns_of
from ..scene.palette import NUMBERED
from ..scene.picture import picture
from ..told.handout import Framed, Range, Result, Stand
from ..tuning.sweep import on_slider
from ..view import View
from .pool import Pool

VALUES = 60
RANGES = 5
# A slower method would take minutes for all results, so that its thresholds stand [s].
SLOWEST = 0.03
# A micrometre; places of views to 0.1 mm, and directions finer, because a plan may be stretched 50 times across them.
DIGITS, PLACE_DIGITS, NORMAL_DIGITS = 6, 4, 6


class Content:
    """One frame under several thresholds; what they have in common is stored once.

    x, y: of every beam [m]. most_steps: decisions that can be stepped through.
    """

    def __init__(self, recording: Recording, frame: int, most_steps: int) -> None:
        self.recording, self.most_steps = recording, most_steps
        self.scan: Scan = recording[recording.position(frame)]
        self.bounds: Bounds = bounds_of(recording)
        self.pool = Pool()
        self.results: list[Result] = []
        self.segments: list[Any] = []
        self.x: list[float | None] = []
        self.y: list[float | None] = []
        self._view = View(mode="learn", frame=frame)
        self._of_result: dict[tuple[int, tuple[int, ...]], int] = {}
        self._of_segment: dict[str, int] = {}

    def stand(self, method: str, params: Thresholds, ranged: Sequence[str]) -> tuple[Stand, Findings]:
        """The frame under these thresholds, with the ranges of some."""
        found = findings_in(self.scan, method, params)
        columns = columns_of(found)
        steps = min(len(columns["kind"]), self.most_steps)
        for name, column in columns.items():
            if isinstance(column, list) and name not in ("x", "y"):
                del column[steps:]
                columns[name] = rounded(column)
        columns["jumps"] = {name: [k for k in jumps if k < steps] for name, jumps in columns["jumps"].items()}
        starts = columns["starts"]
        starts["phase"], starts["line"] = ([k for k in starts[name] if k < steps] for name in ("phase", "line"))
        # They are the same for all thresholds.
        (self.x, self.y), columns["x"], columns["y"] = (columns["x"], columns["y"]), [], []
        view = replace(self._view, method=method, params=params)
        # The first run of a method also loads its kernels.
        elapsed_us = min(found.extraction_us, findings_in(self.scan, method, params).extraction_us)
        ranged = ranged if elapsed_us < 1e6 * SLOWEST else []
        first = len(self.pool.moments)
        for step in range(steps):
            self.pool.add(self._picture(replace(view, step=step), found))
        return {
            "method": method,
            "params": params.numbers(),
            "trace": columns,
            "framings": [self._framed(found, step) for step in range(steps)],
            "first": first,
            "result": self._result(view, found),
            "ranges": {name: self._range(view, name) for name in ranged},
            "why": [found.trace.explain(beam).text for beam in range(len(self.scan))],
        }, found

    def _range(self, view: View, name: str) -> Range:
        """The result at each value of a threshold while the others stand."""
        kind, knob = {field: (kind, knob) for field, kind, knob in view.params.knobs()}[name]
        present = view.params.numbers()[name]
        values = sorted({*on_slider(kind, knob.reaching(present), VALUES), float(present)})
        results = []
        for value in values:
            params = view.params.but(**{name: kind(value)})
            # Timed findings run the method twice.
            traced = EXTRACTORS[view.method].trace(self.scan, params)
            found = Findings(self.scan, traced.extraction, traced, 0.0)
            results.append(self._result(replace(view, params=params), found))
        return {"values": values, "results": results}

    def _result(self, view: View, found: Findings) -> int:
        numbers = []
        for segment in segments_told(found):
            told = rounded(segment)
            number = self._of_segment.setdefault(str(told), len(self.segments))
            if number == len(self.segments):
                self.segments.append(told)
            numbers.append(number)
        moment = self.pool.once(self._picture(view, found))
        known = self._of_result.setdefault((moment, tuple(numbers)), len(self.results))
        if known == len(self.results):
            self.results.append({"moment": moment, "segments": numbers})
        return known

    def _picture(self, view: View, found: Findings):
        return picture(view, self.recording, found, self.bounds, theme=NUMBERED)

    def _framed(self, found: Findings, step: int) -> Framed | None:
        framing = framing_of(found, step)
        if framing is None:
            return None
        tells = [number for number, name in enumerate(framing.names) if name.tells]
        told = framing_told(framing)
        placed = rounded(told, PLACE_DIGITS) | {"normal": rounded(told["normal"], NORMAL_DIGITS)}
        return {"framing": placed, "tells": tells}


def usual_ranges(params: Thresholds) -> list[str]:
    """The five thresholds of the paper; of another method, the first ones."""
    return [name for name, kind, knob in params.knobs() if kind is not bool and not knob.extension][:RANGES]


def rounded(told: Any, digits: int = DIGITS) -> Any:
    """The same with all numbers rounded to so many digits after the point."""
    if isinstance(told, float):
        return round(told, digits)
    if isinstance(told, dict):
        return {name: rounded(value, digits) for name, value in told.items()}
    return [rounded(each, digits) for each in told] if isinstance(told, list | tuple) else told
