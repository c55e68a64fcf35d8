"""Describes in words what looks wrong in a frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_recording
from ..doubt.misses import misses, why_none
from ..doubt.neighbours import VOTES, mark_frame, moved, views_of
from ..doubt.scores import LOOSER, NEAR_EPSILON, SCORES, find_splits
from ..doubt.suspicion import AROUND, WEIGHTS, doubts
from ..doubt.visible import is_there, shows_enough
from ..extractors import extract, trace
from ..knobs import Thresholds
from ..params import Params
from ..region_growing.limits import limits_of
from ..scan import Recording, Scan
from ..truth import demands_of
from .committee import Committee, disputed, judges_of
from .disputes import confirmed, disputes
from .frame_by_frame import judge_of
from .remark import Remark
from .result import Survey
from .stability import changes
from .threads import survey

# A score that every frame has is mentioned from this doubt on.
STANDS_OUT = 1.0
# The other scores are told by their label and value.
WITH_SENTENCE = frozenset(
    [
        "segments",
        "coverage",
        "invalid",
        "rms",
        "splits",
        "gap",
        "misses",
        "change",
        "near",
        "brief",
        "gone",
        "jump",
        "jolt",
        "unstable",
        "disputed",
        "lapsed",
        "blank",
    ]
)


def why(
    recording: Recording, frame: int, params: Thresholds | None = None, scores: NDArray[np.floating] | None = None
) -> tuple[Remark, ...]:
    """What looks wrong in a frame, most doubtful first; empty if nothing does.

    params: select the method; only region growing says in full why a line was not found.

    scores: (frames, len(SCORES)) of the whole recording; without, only the frames around are surveyed, and the frame is
    measured against them.
    """
    need_recording(recording)
    if not 0 <= frame < len(recording):
        raise IndexError(f"frame {frame}: the recording has the frames 0 to {len(recording) - 1}")
    first = max(frame - AROUND, 0)
    part = recording.only(np.arange(first, min(frame + AROUND + 1, len(recording))))
    panel = Committee.of_some(part, judges_of(recording))
    found = disputed(part, survey(part, params), panel, np.arange(len(part)))
    scene = _Scene(part, found, frame - first, params or Params(), panel)
    known = (found.need_scores(), frame - first) if scores is None else (scores, frame)
    doubt = dict(zip(SCORES, doubts(known[0])[known[1]].tolist(), strict=True))
    remarks = [*_lines(scene), *_beside(scene), *_whole(scene, doubt), *_stability(scene)]
    weighted = [replace(each, doubt=WEIGHTS[each.score] * doubt[each.score]) for each in remarks]
    # Each dispute is about one line, so it has its own share of the doubt.
    disputed_lines = [replace(each, doubt=WEIGHTS[each.score] * each.doubt) for each in _disputes(scene)]
    return tuple(sorted((*disputed_lines, *weighted), key=lambda each: -each.doubt))


class _Scene:
    """A frame and the surveyed frames around it."""

    def __init__(
        self, recording: Recording, found: Survey, frame: int, params: Thresholds, committee: Committee
    ) -> None:
        self.recording, self.found, self.frame, self.params = recording, found, frame, params
        self.committee = committee
        self.judge = judge_of(params)
        self.scan: Scan = recording[frame]
        self.rows = found[frame]

    def score(self, name: str) -> float:
        return float(self.found.score(name)[self.frame])

    def around(self, name: str) -> float:
        """The median of the frames around."""
        return float(np.median(self.found.score(name)))

    def points_of(self, row: np.void) -> NDArray[np.intp]:
        """The valid beams of a segment."""
        beams = (row["first"] + np.arange((row["last"] - row["first"]) % len(self.scan) + 1)) % len(self.scan)
        return beams[self._in_lines[beams]]

    def misses(self, ends: tuple[float, float, float, float]) -> bool:
        """Whether the frame should have a line between these ends, and does not have it in another way."""
        scan, wanted = self.scan, demands_of(self.params)
        limits = scan.range_min, scan.range_max, float(wanted.min_points), wanted.min_length
        rays = np.ravel(scan.rays)
        return bool(shows_enough(ends, rays, scan.ranges, *limits)) and not is_there(ends, self.rows, rays, scan.ranges)

    @cached_property
    def _in_lines(self) -> NDArray[np.bool_]:
        """(n,) the valid beams; for region growing without those on objects that lines pass behind."""
        return extract(self.scan, self.params).labels >= 0 if type(self.params) is Params else self.scan.valid


def _disputes(scene: _Scene) -> Iterator[Remark]:
    """Lines that others find, and lines that others do not find."""
    yield from disputes(
        scene.scan, scene.rows, scene.params, scene.committee.judges, scene.committee.walls_in(scene.frame)
    )


def _lines(scene: _Scene) -> Iterator[Remark]:
    """Doubts about single lines."""
    rows = scene.rows
    yield from _misses(scene)
    pairs = np.empty(len(rows), np.int64)
    for i in pairs[: find_splits(rows, scene.scan.full_circle, limits_of(scene.judge), pairs)].tolist():
        one, other = rows[i], rows[(i + 1) % len(rows)]
        cut = f"cut in two between beams {one['last']} and {other['first']}"
        text = f"segments {i} and {(i + 1) % len(rows)} are one line, {cut}"
        yield Remark("splits", text, int(one["first"]), int(other["last"]))
    for i, row in enumerate(rows):
        epsilon = scene.judge.epsilon_at(0.5 * np.hypot(row["x1"] + row["x2"], row["y1"] + row["y2"]))
        if row["rms"] > NEAR_EPSILON * epsilon:
            text = f"segment {i} only just fits: its rms distance is {row['rms']:.3f} m, ε = {epsilon:.3f} m"
            yield Remark("near", text, int(row["first"]), int(row["last"]))
        yield from _gap(scene, i, row)


def _misses(scene: _Scene) -> Iterator[Remark]:
    if isinstance(scene.params, Params):
        for miss in misses(scene.scan, scene.params):
            yield Remark("misses", miss.text, miss.first, miss.last)
    elif count := int(scene.score("misses")):
        lines = f"{count} line{'s' if count > 1 else ''}"
        yield Remark(
            "misses", f"region growing with ε and δ {LOOSER:g} times as large finds {lines} in the remaining points"
        )


def _gap(scene: _Scene, i: int, row: np.void) -> Iterator[Remark]:
    beams = scene.points_of(row)
    steps = np.concatenate(([0.0], np.hypot(*np.diff(scene.scan.xy[beams], axis=0).T), [0.0]))
    excess = steps[1:-1] - np.maximum(steps[:-2], steps[2:])
    if len(excess) and excess.max() >= SCORES["gap"].least:
        k = int(np.argmax(excess))
        where = f"between beams {beams[k]} and {beams[k + 1]}"
        text = f"segment {i} bridges a gap of {steps[k + 1]:.2f} m {where}"
        yield Remark("gap", text, int(beams[k]), int(beams[k + 1]))


def _beside(scene: _Scene) -> Iterator[Remark]:
    """Doubts from comparing with the previous and the next frame."""
    if not 0 < scene.frame < len(scene.found) - 1:
        return
    before, behind = scene.found[scene.frame - 1], scene.found[scene.frame + 1]
    brief, gone = np.zeros(len(scene.rows), np.bool_), np.zeros(len(before), np.bool_)
    view = views_of(scene.recording)[scene.frame]
    to_here, to_behind = mark_frame(before, scene.rows, behind, view, np.empty(VOTES), brief, gone)
    for i in np.flatnonzero(brief):
        row = scene.rows[i]
        text = f"segment {i}, {row['length']:.1f} m, appears only in this frame"
        yield Remark("brief", text, int(row["first"]), int(row["last"]))
    walls, beams_before = scene.committee.walls_in(scene.frame - 1), len(scene.recording[scene.frame - 1])
    traced = trace(scene.scan, scene.params) if gone.any() else None
    for row in before[gone]:
        ends = moved(row, to_here)
        beams = _beams_to(scene.scan, ends)
        place = f"beams {beams[0]}–{beams[-1]}" if len(beams) else "between two beams"
        reason = why_none(traced, beams) if traced is not None and len(beams) else ""
        because = f" – {reason}" if reason else ""
        text = f"a {row['length']:.1f} m line of both neighbouring frames is missing, {place}{because}"
        span = (int(beams[0]), int(beams[-1])) if len(beams) else (-1, -1)
        sure = confirmed(row, walls, scene.params, beams_before) and scene.misses(ends)
        yield Remark("lapsed" if sure else "gone", text, *span, ghosts=(ends,))
    if scene.score("jump") > SCORES["jump"].least:
        counts = f"{len(before)} in the previous frame, {len(behind)} in the next"
        yield Remark("jump", f"{len(scene.rows)} segments here, {counts}")
    if scene.score("jolt") > SCORES["jolt"].least:
        come, go = (-np.degrees(np.arctan2(sin, cos)) for cos, sin, _, _ in (to_here, to_behind))
        turns = f"{come:+.0f}° to this frame and {go:+.0f}° to the next".replace("-", "−")
        yield Remark("jolt", f"the sensor jolted or turned unevenly: {turns}")


def _beams_to(scan: Scan, ends: tuple[float, float, float, float]) -> NDArray[np.intp]:
    """The beams that point at a line between two points, in scan order."""
    one, other = np.arctan2(ends[1], ends[0]), np.arctan2(ends[3], ends[2])
    across = (other - one + np.pi) % (2 * np.pi) - np.pi
    start = one if across > 0 else other
    inside = np.flatnonzero((scan.bearings - start) % (2 * np.pi) <= abs(across))
    # Across the seam of a full circle the later beams come first.
    breaks = np.flatnonzero(np.diff(inside) > 1)
    return np.roll(inside, -int(breaks[0]) - 1) if len(breaks) else inside


def _whole(scene: _Scene, doubt: dict[str, float]) -> Iterator[Remark]:
    """Doubts from scores that every frame has, if they stand out in this frame."""
    if doubt["coverage"] >= STANDS_OUT:
        cover = f"{scene.score('coverage'):.0%} of the valid beams"
        yield Remark("coverage", f"segments cover {cover}; nearby frames: {scene.around('coverage'):.0%}")
    if doubt["invalid"] >= STANDS_OUT:
        first, last = _longest_run(~scene.scan.valid)
        share, around = f"{scene.score('invalid'):.0%}", f"nearby frames: {scene.around('invalid'):.0%}"
        text = f"{share} of the beams have no return ({around}); the longest run is beams {first}–{last}"
        yield Remark("invalid", text, first, last)
    if doubt["change"] >= STANDS_OUT:
        share = f"{scene.score('change'):.0%} of the covered bearings"
        yield Remark("change", f"{share} changed segment since the previous frame")
    if doubt["rms"] >= STANDS_OUT and len(scene.rows):
        row = scene.rows[np.argmax(scene.rows["rms"])]
        text = f"the worst fit has an rms of {row['rms']:.3f} m; nearby frames: {scene.around('rms'):.3f} m"
        yield Remark("rms", text, int(row["first"]), int(row["last"]))
    for name, score in SCORES.items():
        if name not in WITH_SENTENCE and doubt[name] >= STANDS_OUT:
            value, around = (f"{each:.3g} {score.unit}".strip() for each in (scene.score(name), scene.around(name)))
            yield Remark(name, f"{score.label}: {value}; nearby frames: {around}")


def _stability(scene: _Scene) -> Iterator[Remark]:
    """The threshold to which the segments are most sensitive."""
    alone = scene.recording.only(np.array([scene.frame]))
    base = survey(alone, scene.found.params, scores=False)
    name, params, count = max(changes(alone, base), key=lambda each: each[2][0])
    if count[0]:
        symbol = next(knob.symbol for each, _, knob in params.knobs() if each == name)
        value = f"{symbol} = {getattr(params, name):g} instead of {getattr(base.params, name):g}"
        yield Remark(
            "unstable", f"with {value}, {count[0]} segment{'s' if count[0] > 1 else ''} would appear or disappear"
        )


def _longest_run(flags: NDArray[np.bool_]) -> tuple[int, int]:
    """First and last index of the longest run of true flags; at least one flag must be true."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], flags, [0]))))
    runs = edges.reshape(-1, 2)
    first, stop = runs[np.argmax(runs[:, 1] - runs[:, 0])]
    return int(first), int(stop) - 1
