"""Says where the committee finds other lines than a frame has, and which other methods agree with it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ..extractors import EXTRACTORS, extract, method_of
from ..knobs import Thresholds
from ..params import Params
from ..proposal import scaled
from ..scan import Recording, Scan
from ..truth import SHORT, demands_of
from .committee import CONFIRMING, Committee, judges_of, known_committee
from .difference import length_of, shared_beams
from .remark import Ghost, Remark

Span = tuple[int, int]
# Methods that begin a line differently are asked whether they agree.
OTHERS = ("split-and-merge-textbook", "line-tracking", "hough", "ransac")


def disputes(
    scan: Scan, rows: NDArray[np.void], params: Thresholds, judges: Sequence[Params], walls: Sequence[NDArray[np.void]]
) -> Iterator[Remark]:
    """What most judges hold for missed or false in a frame.

    rows: its segments, found with `params`; walls: the lines of each judge there. doubt: the share of the judges.
    """
    beams, own = len(scan), [_span(row) for row in rows]
    wanted = demands_of(params)
    missed = _missed([_enough(each, wanted) for each in walls], own, beams)
    # A wall that just misses the demands does not make a segment on it false.
    found = [_enough(each, wanted, 1.0 - SHORT) for each in walls]
    unsure = [
        (k, votes)
        for k, span in enumerate(own)
        if 2 * (votes := sum(not _among(span, each, beams) for each in found)) >= len(found)
    ]
    if not missed and not unsure:
        return
    others = dict(_others(scan, params, judges))
    explained = set[int]()
    for wall, votes in missed:
        span = _span(wall)
        parts = [
            k for k, segment in enumerate(own) if 2 * shared_beams(span, segment, beams) > length_of(segment, beams)
        ]
        explained.update(parts)
        who = _who([name for name, spans in others.items() if _matches(span, spans, beams)])
        length, ghost = float(wall["length"]), _ghost(wall)
        line = f"{who} a {length:.1f} m line at beams {span[0]}–{span[1]}"
        text = f"{line}, {_instead(span, own, parts, beams)}"
        score = "disputed" if len(rows) else "blank"
        yield Remark(score, text, *span, votes / len(walls), (ghost,))
    for k, votes in unsure:
        if k in explained:
            continue
        span = own[k]
        without = [name for name, spans in others.items() if not _matches(span, spans, beams)]
        text = f"{_who(without)} no line like segment {k} ({rows[k]['length']:.1f} m, beams {span[0]}–{span[1]})"
        yield Remark("disputed", text, *span, votes / len(walls))


def lines_missed(recording: Recording, frame: int, params: Thresholds | None = None) -> tuple[Ghost, ...]:
    """The lines of a frame that at least half of the judges find and the method does not, as `why` says."""
    params = Params() if params is None else params
    scan = recording[frame]
    own = [(segment.first, segment.last) for segment in extract(scan, params).segments]
    committee, at = known_committee(recording), frame
    if committee is None:
        committee, at = Committee.of_some(recording.only(np.array([frame])), judges_of(recording)), 0
    found = [_enough(walls, demands_of(params)) for walls in committee.walls_in(at)]
    return tuple(_ghost(wall) for wall, _ in _missed(found, own, len(scan)))


def _span(row: np.void) -> Span:
    return int(row["first"]), int(row["last"])


def _ghost(wall: np.void) -> Ghost:
    return float(wall["x1"]), float(wall["y1"]), float(wall["x2"]), float(wall["y2"])


def _enough(walls: NDArray[np.void], wanted: Params, share: float = 1.0) -> NDArray[np.void]:
    """The walls that have this share of the points and of the length of a line."""
    return walls[(walls["points"] >= share * wanted.min_points) & (walls["length"] >= share * wanted.min_length)]


def _same(one: Span, other: Span, beams: int) -> bool:
    shared = shared_beams(one, other, beams)
    return 2 * shared > length_of(one, beams) + length_of(other, beams) - shared


def _matches(span: Span, spans: Sequence[Span], beams: int) -> bool:
    return any(_same(span, other, beams) for other in spans)


def _among(span: Span, walls: NDArray[np.void], beams: int) -> bool:
    return _matches(span, [_span(wall) for wall in walls], beams)


def confirmed(row: np.void, walls: Sequence[NDArray[np.void]], params: Thresholds, beams: int) -> bool:
    """Whether at least CONFIRMING judges find this segment."""
    wanted = demands_of(params)
    return sum(_among(_span(row), _enough(each, wanted), beams) for each in walls) >= CONFIRMING


def _missed(found: Sequence[NDArray[np.void]], own: Sequence[Span], beams: int) -> list[tuple[np.void, int]]:
    """Each wall that at least half of the judges find and the frame has not, once, with the number of these judges."""
    told: list[tuple[np.void, int]] = []
    # The judge at the ε that fits comes first: its line stands for those of the others.
    for judge in sorted(range(len(found)), key=lambda k: (k != 1, k)):
        for wall in found[judge]:
            span = _span(wall)
            if _matches(span, own, beams) or any(_same(span, _span(other), beams) for other, _ in told):
                continue
            votes = sum(_among(span, each, beams) for each in found)
            if 2 * votes >= len(found):
                told.append((wall, votes))
    return told


def _others(scan: Scan, params: Thresholds, judges: Sequence[Params]) -> Iterator[tuple[str, list[Span]]]:
    """The lines of the other methods, at thresholds that fit the laser."""
    wanted, present = demands_of(params), method_of(params).name
    for name in OTHERS:
        if name == present:
            continue
        method = EXTRACTORS[name]
        fitting = scaled(method.params_type(), judges[1].epsilon)
        fitting = fitting.but(min_points=wanted.min_points, min_length=wanted.min_length)
        yield method.label.partition(" (")[0], [(s.first, s.last) for s in method.extract(scan, fitting).segments]


def _who(names: Sequence[str]) -> str:
    """The subject of a sentence, with its verb."""
    if not names:
        return "careful extractions, with an ε that fits this laser, find"
    if len(names) == len(OTHERS):
        return "all other methods find"
    *first, last = names
    return f"{', '.join(first)} and {last} find" if first else f"{last} finds"


def _instead(span: Span, own: Sequence[Span], parts: Sequence[int], beams: int) -> str:
    """What the frame has at the beams of a line that it lacks."""
    if len(parts) > 1:
        return f"where there are {len(parts)} segments"
    if parts:
        first, last = own[parts[0]]
        return f"of which segment {parts[0]} has only beams {first}–{last}"
    for k, segment in enumerate(own):
        if 2 * shared_beams(span, segment, beams) > length_of(span, beams):
            return f"which is a part of segment {k}, beams {segment[0]}–{segment[1]}"
    return "where there is none"
