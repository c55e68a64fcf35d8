"""A recording under one method and its thresholds, frame by frame, as a recording of rerun."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from lineseg import EXTRACTORS, SCORES, Extraction, Recording, Thresholds, Trace
from lineseg.colours import segment_hues
from lineseg.rerun import dropped_strips, hue_of_beams, raised, strips
from lineseg.survey import survey

from ..palette import LIGHT
from ..picture import truth
from ..replay import foot, is_line
from .layout import POINTS_OF, announce
from .rows import Moment, Rows

BLOCK = 128
# What becomes of lines; the other decisions come by the hundred in a frame, only a recording of all steps has them.
NOTABLE = ("line", "drop", "merge", "cut")
Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False)
class Run:
    """What is recorded. frames: of the recording; steps: with every decision, on a timeline of its own."""

    recording: Recording
    label: str
    method: str
    params: Thresholds
    frames: range
    steps: bool = False


def save(run: Run, path: Path, progress: Progress = lambda done, total: None) -> None:
    """Write `run` to a file; until all is written, a file that was there stays.

    progress: called with (frames done, frames); what it raises ends the work, and comes through.
    """
    part = path.with_name(f"{path.name}.part")
    part.touch()
    stream = rr.RecordingStream("lineseg")
    try:
        stream.save(part)
        send(run, stream, progress)
        stream.flush()
        stream.disconnect()
        part.replace(path)
    finally:
        stream.disconnect()
        part.unlink(missing_ok=True)


def send(run: Run, stream: rr.RecordingStream, progress: Progress = lambda done, total: None) -> None:
    """Send `run` to a stream of rerun."""
    announce(stream, run.recording, run.label, run.method, run.params, run.frames, run.steps)
    tables = Tables(run)
    for done, frame in enumerate(run.frames):
        progress(done, len(run.frames))
        tables.add(frame)
        if done % BLOCK == BLOCK - 1:
            tables.send(stream)
    tables.send(stream)
    for name, values in tables.scores().items():
        moments = [tables.moment(frame) for frame in run.frames]
        rows = Rows(f"scores/{name}", rr.Scalars.columns)
        for moment, value in zip(moments, values, strict=True):
            rows.add(moment, scalars=np.array([value], dtype=np.float64))
        rows.send(stream)
    progress(len(run.frames), len(run.frames))


class Tables:
    """The rows of every entity."""

    def __init__(self, run: Run) -> None:
        self._run = run
        stamps = np.asarray(run.recording.stamps)[run.frames.start : run.frames.stop]
        # A file without stamps has the same for every frame.
        self._stamped = bool(np.isfinite(stamps).all() and (np.ptp(stamps) > 0 if len(stamps) else False))
        self._steps = 0
        self._points = Rows(POINTS_OF["points"], rr.Points3D.columns)
        self._seeds = Rows(POINTS_OF["seeds"], rr.Points3D.columns)
        self._segments = Rows("laser/segments", rr.LineStrips3D.columns)
        self._dropped = Rows("laser/dropped", rr.LineStrips3D.columns)
        self._truth = Rows("laser/truth", rr.LineStrips3D.columns)
        self._decisions = Rows("decisions", rr.TextLog.columns)
        self._replay = Replay() if run.steps else None

    def moment(self, frame: int, step: int | None = None) -> Moment:
        stamp = float(self._run.recording.stamps[frame]) if self._stamped else None
        return Moment(frame, stamp, step if self._run.steps else None)

    def add(self, frame: int) -> None:
        run = self._run
        scan = run.recording[frame]
        trace = EXTRACTORS[run.method].trace(scan, run.params)
        found, here = trace.extraction, self.moment(frame)._replace(step=None)
        hues = hue_of_beams(found)[scan.valid]
        self._points.add(self.moment(frame, self._steps), positions=raised(scan.xy[scan.valid]), class_ids=hues)
        starts, ends = [s.start for s in found.segments], [s.end for s in found.segments]
        self._segments.add(here, strips=strips(starts, ends), class_ids=hues_of(found))
        self._dropped.add(here, strips=dropped_strips(scan, found.dropped))
        if run.recording.walls is not None and run.recording.poses is not None:
            self._truth.add(here, strips=truth(run.recording, frame, LIGHT).xyz)
        self._seeds.add(here, positions=raised(scan.xy[seed_beams(trace)]))
        for index in range(len(trace)) if run.steps else notable(trace):
            level = level_of(trace, trace.kind(index))
            self._decisions.add(self.moment(frame, self._steps + index), text=[trace.text(index)], level=[level])
        if self._replay is not None:
            self._replay.add(trace, self._steps)
            self._steps += len(trace)

    def send(self, stream: rr.RecordingStream) -> None:
        replay = () if self._replay is None else self._replay.rows
        for rows in (self._points, self._seeds, self._segments, self._dropped, self._truth, self._decisions, *replay):
            rows.send(stream)

    def scores(self) -> dict[str, NDArray]:
        """(frames,) by name."""
        recording, frames = self._run.recording, self._run.frames
        # Some scores compare a frame with those beside it.
        first, stop = max(frames.start - 1, 0), min(frames.stop + 1, len(recording))
        surveyed = survey(recording.only(np.arange(first, stop)), self._run.params)
        return {name: surveyed.score(name)[frames.start - first : frames.stop - first] for name in SCORES}


class Replay:
    """What a decision looks at, on the timeline `step` alone."""

    def __init__(self) -> None:
        self._line = Rows("laser/replay/line", rr.LineStrips3D.columns)
        self._beam = Rows("laser/replay/beam", rr.Points3D.columns)
        self._lines = Rows("laser/replay/lines", rr.LineStrips3D.columns)

    @property
    def rows(self) -> tuple[Rows, ...]:
        return self._line, self._beam, self._lines

    def add(self, trace: Trace, first_step: int) -> None:
        xy = trace.scan.xy
        for decision in trace:
            here = Moment(step=first_step + decision.index)
            ends = xy[[decision.first, decision.last]]
            shown = [foot(ends, decision.line)] if is_line(decision.line) else []
            self._line.add(here, strips=raised(np.array(shown).reshape(-1, 2, 2)))
            self._beam.add(here, positions=raised(xy[[decision.beam]] if decision.beam >= 0 else xy[:0]))
            if is_notable(trace, decision.kind) or decision.index == 0:
                lines = trace.lines_at(decision.index)
                ends = [foot(xy[[line.first, line.last]], line.line) for line in lines]
                self._lines.add(here, strips=raised(np.array(ends).reshape(-1, 2, 2)))


def hues_of(extraction: Extraction) -> NDArray[np.uint16]:
    """(segments,): as `hue_of_beams`."""
    return np.array(segment_hues(extraction.segments), dtype=np.uint16) + np.uint16(1)


def notable(trace: Trace) -> list[int]:
    """Indices of the decisions by which lines come and go."""
    wanted = [number for number, kind in enumerate(trace.vocabulary.names) if is_notable(trace, kind)]
    return np.flatnonzero(np.isin(trace.log["kind"], wanted)).tolist()


def is_notable(trace: Trace, kind: str) -> bool:
    return kind == "lines kept apart" or trace.vocabulary.jump_of(kind) in NOTABLE


def level_of(trace: Trace, kind: str) -> str:
    if trace.vocabulary.jump_of(kind) == "drop":
        return "WARN"
    return "INFO" if is_notable(trace, kind) else "TRACE"


def seed_beams(trace: Trace) -> NDArray[np.int64]:
    """The beams of the windows from which the lines grew that were kept to the end; none where there are no seeds."""
    if "seed found" not in trace.vocabulary.names:
        return np.empty(0, np.int64)
    kept = trace.log["candidate"][trace.indices("endpoints")]
    found = trace.log[trace.indices("seed found")]
    windows = found[np.isin(found["candidate"], kept)]
    first, points = windows["first"], windows["last"] - windows["first"] + 1
    within = np.arange(points.sum()) - np.repeat(np.cumsum(points) - points, points)
    return trace.as_beams(np.repeat(first, points) + within)
