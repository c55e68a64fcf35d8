"""What is named and measured in the scene at a decision, in the words and symbols of text, pseudocode and formulas."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lineseg import Decision, Params, TracedLine
from lineseg.region_growing.prediction import predicted_ranges

from .findings import Findings

Point = tuple[float, float]
# A beam that meets the line farther from its point than this [m] is nearly parallel to it: P′ is not shown.
FAR = 5.0
# How many points from the end of a growing line its ε is written.
BAND_NAME = 12


class Name(NamedTuple):
    """A name at a place of the scan [m]. tells: it tells what was decided, so a question leaves it out."""

    text: str
    at: Point
    tells: bool = False


class Measure(NamedTuple):
    """A distance between two places [m]. beside: drawn beside them, since something else lies between them."""

    text: str
    start: Point
    end: Point
    beside: bool = False


Told = tuple[tuple[Name, ...], tuple[Measure, ...]]


def names_of(found: Findings, decision: Decision) -> Told:
    """Names and measures of a decision."""
    if decision.ends is not None:
        return _endpoints(found, decision)
    if decision.phase == "seed":
        return _tested(found, decision, f"i = {decision.first}", f"j = {decision.last}", "k")
    if decision.kind in ("point added", "growth stopped"):
        return _tested(found, decision, f"P_b = {decision.first}", f"P_f = {decision.last}", "n")
    if decision.other is not None:
        return _pair(found, decision)
    if decision.kind in ("line kept", "line dropped") and _is_line(decision.line):
        return _measured(found, decision)
    return _ends_of(found, decision, f"first {decision.first}", f"last {decision.last}"), ()


def pair_of(found: Findings, decision: Decision) -> tuple[TracedLine, TracedLine] | None:
    """The two lines that a decision compares, as they were before it; None if it compares none."""
    if decision.partner < 0:
        return None
    lines = {line.candidate: line for line in found.trace.lines_at(decision.index - 1)}
    one, two = lines.get(decision.candidate), lines.get(decision.partner)
    return None if one is None or two is None else (one, two)


def shared_with(found: Findings, decision: Decision) -> tuple[Name, int] | None:
    """The end of the line before, with its beam, if a growing or grown line has points of it; else None."""
    if decision.kind not in ("point added", "growth stopped", "line kept"):
        return None
    lines = {line.candidate: line for line in found.trace.lines_at(decision.index)}
    own = lines.get(decision.candidate)
    before = max((candidate for candidate in lines if candidate < decision.candidate), default=None)
    if own is None or before is None or lines[before].last not in found.trace.beams(own.first, own.last):
        return None
    last = lines[before].last
    return Name(f"line before ends: {last}", point_of(found.scan.xy[last])), last


def _ends_of(found: Findings, decision: Decision, first: str, last: str) -> tuple[Name, ...]:
    xy = found.scan.xy
    return Name(first, point_of(xy[decision.first])), Name(last, point_of(xy[decision.last]))


def _tested(found: Findings, decision: Decision, first: str, last: str, index: str) -> Told:
    """A window or a growing line, and the point that was compared with it."""
    # Where a growing line ends after a decision tells whether the point joined.
    growing = decision.phase != "seed"
    names = tuple(name._replace(tells=growing) for name in _ends_of(found, decision, first, last))
    if decision.beam < 0:
        return names, ()
    scan, beam, line = found.scan, decision.beam, decision.line
    point, ray = scan.xy[beam], scan.rays[:, beam]
    refused = not growing
    names += (Name(f"P, beam {index} = {beam}", point_of(point), refused),)
    if not _is_line(line):
        return names, ()
    meets = float(predicted_ranges(line, ray))
    predicted = meets * ray
    in_sight = meets > 0 and float(np.hypot(*(predicted - point))) < FAR
    measures = ()
    if decision.check == "delta":
        if in_sight:
            toward = math.copysign(decision.limit, float(point @ ray) - meets) * ray
            measures = (
                Measure(f"|ρ − ρ′| = {_m(decision.value)}", point_of(point), point_of(predicted)),
                Measure(f"δ = {_m(decision.limit)}", point_of(predicted), point_of(predicted + toward), beside=True),
            )
    elif decision.check == "epsilon":
        measures = (Measure(f"d = {_m(decision.value)}", point_of(point), point_of(feet(point, line))),)
    names += (Name(f"ε = {_m(_epsilon(found, decision.beam))}", point_of(_band_end(found, decision))),)
    return names + ((Name("P′", point_of(predicted), refused),) if in_sight else ()), measures


def _epsilon(found: Findings, beam: int) -> float:
    """ε at the range of a beam [m]."""
    params = found.trace.params
    if isinstance(params, Params):
        return float(params.epsilon_at(np.hypot(*found.scan.xy[beam])))
    return float(params.epsilon)


def _band_end(found: Findings, decision: Decision) -> NDArray[np.float64]:
    """A place on the edge of the ε band, on the side away from the tested point; in a long line some points from it."""
    line, point = decision.line, found.scan.xy[decision.beam]
    side = -1.0 if np.dot(line[:2], point) + line[2] > 0 else 1.0
    beams = found.trace.beams(decision.first, decision.last)
    ordered = beams[::-1] if decision.direction > 0 else beams
    at = ordered[min(len(ordered) - 1, BAND_NAME)] if decision.direction else decision.first
    return feet(found.scan.xy[at], line) + side * _epsilon(found, at) * np.array(line[:2])


def _measured(found: Findings, decision: Decision) -> Told:
    """A grown line, with its number of points and its length."""
    one, other = (feet(found.scan.xy[beam], decision.line) for beam in (decision.first, decision.last))
    length = float(np.hypot(*(other - one)))
    names = _ends_of(found, decision, f"first {decision.first}", f"last {decision.last}")
    names += (Name(f"P_l = {decision.points}", point_of((one + other) / 2)),)
    return names, (Measure(f"L_l = {_m(length)}", point_of(one), point_of(other), beside=True),)


def _pair(found: Findings, decision: Decision) -> Told:
    """Two lines that overlap: their angle, or the point where they are cut."""
    pair = pair_of(found, decision)
    if pair is None:
        return (), ()
    (one, two), xy, scan = pair, found.scan.xy, found.scan
    if decision.kind != "overlap cut":
        middle = (xy[one.last] + xy[two.first]) / 2
        angle = math.asin(min(1.0, abs(one.line[0] * two.line[1] - one.line[1] * two.line[0])))
        return (
            Name(f"first line: {one.first}–{one.last}", point_of(feet(xy[one.first], one.line))),
            Name(f"second line: {two.first}–{two.last}", point_of(feet(xy[two.last], two.line))),
            Name(f"angle {math.degrees(angle):.1f}°", point_of(middle), tells=True),
        ), ()
    point = scan.xy[decision.beam]
    to_one, to_two = point_of(feet(point, one.line)), point_of(feet(point, two.line))
    shared = (
        Name(f"second line begins: {two.first}", point_of(xy[two.first])),
        Name(f"first line ended: {one.last}", point_of(xy[one.last])),
    )
    return (
        (Name(f"P, beam k = {decision.beam}", point_of(point)), *shared),
        (
            Measure(f"d_1 = {_m(decision.value)}", point_of(point), to_one),
            Measure(f"d_2 = {_m(decision.limit)}", point_of(point), to_two),
        ),
    )


def _endpoints(found: Findings, decision: Decision) -> Told:
    """The outermost points and where they are moved to."""
    names, measures = [], []
    ends = np.reshape(decision.ends or (0.0,) * 4, (2, 2))
    for beam, end in zip((decision.first, decision.last), ends, strict=True):
        point = found.scan.xy[beam]
        names += [Name(f"P_0, beam {beam}", point_of(point)), Name("P_s", point_of(end))]
        measures.append(Measure(f"{1000 * float(np.hypot(*(point - end))):.1f} mm", point_of(point), point_of(end)))
    return tuple(names), tuple(measures)


def feet(xy: NDArray, line: tuple[float, float, float]) -> NDArray[np.float64]:
    """(2,) the point projected onto the line."""
    a, b, c = line
    return xy - (a * xy[0] + b * xy[1] + c) * np.array((a, b))


def _is_line(line: tuple[float, float, float]) -> bool:
    return math.isfinite(sum(line)) and math.hypot(line[0], line[1]) > 0.5


def point_of(xy: NDArray) -> Point:
    return float(xy[0]), float(xy[1])


def _m(metres: float) -> str:
    return f"{metres:.3f} m"
