"""The state after a decision of the trace, and the geometry of that decision."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lineseg import Decision, Params, Scan
from lineseg.colours import SEGMENTS
from lineseg.region_growing.prediction import predicted_ranges

from ..fitting import fitted
from ..frame.findings import Findings
from ..frame.names import pair_of
from .palette import Colours, Theme
from .shapes import Lines, Points, dashed, joined, lines_between, points_at

Line = tuple[float, float, float]
NO_XY = np.empty((0, 2))
# A nearly parallel beam meets the line farther away than this [m]; it counts as never meeting it.
FAR = 1e6
# Dashes of a line that was not fitted.
DASHES = 24


@dataclass(frozen=True, eq=False)
class State:
    """The lines at one moment.

    labels: (beams,) the line of each beam, or −1; colours: (lines, 3); starts, ends: (lines, 2) [m]; candidates: the
    growth of each line; drops: how many lines were dropped so far.
    """

    labels: NDArray[np.int32]
    colours: Colours
    starts: NDArray
    ends: NDArray
    candidates: tuple[int, ...]
    drops: int


def state_at(found: Findings, step: int | None) -> State:
    """The state after decision `step`; the whole result if step is None."""
    if step is None:
        return _final(found)
    labels = np.full(len(found.scan), -1, dtype=np.int32)
    lines = found.trace.lines_at(step)
    starts, ends = np.empty((len(lines), 2)), np.empty((len(lines), 2))
    for index, traced in enumerate(lines):
        labels[found.trace.beams(traced.first, traced.last)] = index
        starts[index] = foot(found.scan.xy[traced.first], traced.line)
        ends[index] = foot(found.scan.xy[traced.last], traced.line)
    candidates = tuple(traced.candidate for traced in lines)
    drops = int(np.searchsorted(found.drops, step, side="right"))
    return State(labels, _candidate_colours(found, candidates), starts, ends, candidates, drops)


def _final(found: Findings) -> State:
    segments = found.extraction.segments
    starts = np.array([segment.start for segment in segments], dtype=float).reshape(-1, 2)
    ends = np.array([segment.end for segment in segments], dtype=float).reshape(-1, 2)
    return State(found.extraction.labels, found.colours, starts, ends, found.trace.candidates, len(found.drops))


def _candidate_colours(found: Findings, candidates: tuple[int, ...]) -> Colours:
    """A line has the colour of its final segment from the start; other lines take turns."""
    by_first = {segment.first: colour for segment, colour in zip(found.extraction.segments, found.colours, strict=True)}
    last = found.trace.lines_at(len(found.trace) - 1)
    known = {line.candidate: by_first[line.first] for line in last if line.first in by_first}
    chosen = [known.get(candidate, SEGMENTS[candidate % len(SEGMENTS)]) for candidate in candidates]
    return np.array(chosen, dtype=np.uint8).reshape(-1, 3)


def decision_geometry(found: Findings, step: int, theme: Theme) -> tuple[dict[str, Points], dict[str, Lines]]:
    """The window under test, the fitted line with its ε band, P and P′ with the beam, and the candidate point.

    Where it would have changed the decision, also the line fitted with the candidate. Two lines that are compared are
    drawn as they were then, and beside them the one that they become.
    """
    decision, scan = found.trace[step], found.scan
    if decision.ends is not None:
        return _moved_ends(found, decision, theme)
    pair = pair_of(found, decision)
    points: dict[str, Points] = {}
    lines: dict[str, Lines] = {}
    refused = found.trace.vocabulary.jump_of(decision.kind) in ("refusal", "drop")
    tone = theme.refused if refused else theme.accepted
    inside = found.trace.beams(decision.first, decision.last)
    if pair is not None:
        for name, one in zip(("first", "other"), pair, strict=True):
            start, end = span(scan.xy[found.trace.beams(one.first, one.last)], one.line)
            lines[name] = lines_between(start, end, getattr(theme, name))
        if decision.kind == "overlap cut":
            # By now each is fitted to what it keeps.
            decision = replace(decision, line=pair[0].line, other=pair[1].line)
    elif decision.other is not None and is_line(decision.other):
        lines["other"] = lines_between(*span(scan.xy[inside], decision.other), theme.other)
    if decision.phase not in ("growth", "overlap", "endpoints") or decision.kind == "line dropped":
        points["window"] = points_at(scan.xy[inside], tone)
    if decision.beam >= 0:
        points["candidate"] = points_at(scan.xy[decision.beam], theme.candidate)
    if is_line(decision.line) and (pair is None or decision.kind == "lines merged"):
        touched = [*inside, decision.beam] if decision.beam >= 0 else list(inside)
        start, end = span(scan.xy[touched], decision.line)
        lines["growing"] = lines_between(start, end, tone)
        width = band_width(found, decision, start, end)
        if np.any(width):
            lines["band"] = band(start, end, decision.line, width, theme)
    if decision.beam >= 0 and is_line(decision.line):
        points["predicted"], lines["ray"] = prediction(scan, decision, theme)
    if (bent := bent_line(found, decision)) is not None:
        start, end = span(scan.xy[[*inside, decision.beam]], bent)
        dash = float(np.linalg.norm(end - start)) / (2 * DASHES)
        lines["bent"] = dashed(start[None], end[None], dash, theme.other)
    return points, lines


def _moved_ends(found: Findings, decision: Decision, theme: Theme) -> tuple[dict[str, Points], dict[str, Lines]]:
    """A line with its outermost points and the way of each to the line."""
    outermost, ends = found.scan.xy[[decision.first, decision.last]], np.reshape(decision.ends or (0.0,) * 4, (2, 2))
    return {"outermost": points_at(outermost, theme.candidate)}, {
        "growing": lines_between(ends[0], ends[1], theme.accepted),
        "perpendicular": lines_between(outermost, ends, theme.candidate),
    }


def bent_line(found: Findings, decision: Decision) -> Line | None:
    """The line fitted with a point that growth refused, if ε would have accepted the point then; None otherwise."""
    scan = found.scan
    refused = decision.kind == "growth stopped" and decision.check == "epsilon"
    # Some methods also refuse beams without a return.
    if not refused or decision.beam < 0 or not scan.valid[decision.beam]:
        return None
    inside = found.trace.beams(decision.first, decision.last)
    point = scan.xy[decision.beam]
    line = fitted(np.concatenate((scan.xy[inside[scan.valid[inside]]], point[None])))
    return line if np.linalg.norm(point - foot(point, line)) < decision.limit else None


def band_width(found: Findings, decision: Decision, start: NDArray, end: NDArray) -> NDArray[np.float64]:
    """(2,) largest allowed distance from the line at both ends at this decision [m]; 0 if distance is not tested."""
    if decision.phase in ("seed", "growth") and decision.kind not in ("line kept", "line dropped"):
        params = found.trace.params
        ranges = np.hypot(*np.column_stack((start, end)))
        return params.epsilon_at(ranges) if isinstance(params, Params) else np.full(2, params.epsilon)
    units = {name: knob.unit for name, _, knob in found.trace.params.knobs()}
    return np.full(2, decision.limit if decision.beam >= 0 and units.get(decision.check) == "m" else 0.0)


def prediction(scan: Scan, decision: Decision, theme: Theme) -> tuple[Points, Lines]:
    """P′, where the beam meets the line; the beam; and the compared distance."""
    point, toward = scan.xy[decision.beam], scan.rays[:, decision.beam]
    reach = float(predicted_ranges(decision.line, toward))
    predicted = reach * toward if 0 < reach < FAR else np.full(2, np.nan)
    near = np.linalg.norm(predicted - point) < 5.0
    end = predicted if near and np.linalg.norm(predicted) > np.linalg.norm(point) else point
    beam = lines_between((0.0, 0.0), end, theme.faint)
    other_end = predicted if decision.check == "delta" else foot(point, decision.line)
    measured = lines_between(point, other_end, theme.candidate)
    if decision.other is not None:
        measured = joined(measured, lines_between(point, foot(point, decision.other), theme.candidate))
    return points_at(predicted if near else NO_XY, theme.predicted), joined(beam, measured)


def band(start: NDArray, end: NDArray, line: Line, width: NDArray, theme: Theme) -> Lines:
    """Two lines beside the line, at ±width (2,) at its ends."""
    one, other = width[:, None] * np.array(line[:2])
    return lines_between(np.stack((start + one, start - one)), np.stack((end + other, end - other)), theme.faint)


def span(xy: NDArray, line: Line) -> tuple[NDArray, NDArray]:
    """The part of the line next to the points, slightly extended at both ends."""
    feet = foot(xy[np.isfinite(xy).all(axis=1)], line)
    along = np.array([-line[1], line[0]])
    if not len(feet):
        return np.full(2, np.nan), np.full(2, np.nan)
    places = feet @ along
    longer = min(0.15 * max(float(np.ptp(places)), 0.1), 0.3)
    on_line = feet[0] - places[0] * along
    return on_line + (places.min() - longer) * along, on_line + (places.max() + longer) * along


def foot(xy: NDArray, line: Line | NDArray) -> NDArray:
    """Points (…, 2) projected onto the line; or points (…, n, 2), each onto one of n lines (3, n)."""
    a, b, c = line
    distance = a * xy[..., 0] + b * xy[..., 1] + c
    return xy - distance[..., None] * np.array([a, b]).T


def foot_between(xy: NDArray, start: NDArray, end: NDArray) -> NDArray:
    """Points (…, 2) projected onto the lines through two points (…, 2)."""
    along = end - start
    along = along / np.maximum(np.linalg.norm(along, axis=-1, keepdims=True), 1e-12)
    return start + ((xy - start) * along).sum(axis=-1, keepdims=True) * along


def is_line(line: Line | NDArray) -> NDArray[np.bool_]:
    """Whether the line exists, or which of (3, n) do: a seed refused before its fit has none."""
    return np.isfinite(line).all(axis=0) & (np.hypot(line[0], line[1]) > 0.5)
