"""Writes the results of a method for a recording, frame by frame, as a rerun recording."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from lineseg import EXTRACTORS, SCORES, Recording, Thresholds, Trace
from lineseg.rerun import dropped_strips, hue_of_beams, hues_of, raised, segment_strips
from lineseg.survey import survey
from lineseg.tracing.vocabulary import Kind
from lineseg.unfinished import whole_file

from ..scene.palette import LIGHT
from ..scene.picture import truth
from ..scene.replay import foot, is_line
from .closing import sweep
from .layout import POINTS_OF, announce
from .rows import Moments, send_rows, times

BLOCK = 128
LEAST_FREE = 1 << 16
# The decisions that create or remove lines. A frame has hundreds of others, which only `steps` records.
NOTABLE = ("line", "drop", "merge", "cut")
Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False)
class Run:
    """What to record. frames: of the recording; steps: whether to add every decision, on a timeline `step`.

    Rows have the numbers of frames in the file, of which the recording may be a part.
    """

    recording: Recording
    label: str
    method: str
    params: Thresholds
    frames: range
    steps: bool = False


def save(run: Run, path: Path, progress: Progress = lambda done, total: None) -> None:
    """Write `run` to a file; an existing file is replaced only when all is written.

    progress: called with (frames done, frames); an exception it raises ends the work and is passed on.
    """
    with whole_file(path) as part:
        stream = rr.RecordingStream("lineseg")
        try:
            stream.save(part)
            send(run, stream, progress)
            stream.flush()
            stream.disconnect()
            _check_space(path)
        except RuntimeError as error:
            _check_space(path)
            raise OSError(f"{path}: rerun cannot write this file: {error}.") from None
        finally:
            stream.disconnect()
            del stream
            sweep()


def _check_space(path: Path) -> None:
    """Raises OSError if the disk is full: rerun's SDK says nothing, or not why."""
    if shutil.disk_usage(path.parent).free < LEAST_FREE:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))


def send(run: Run, stream: rr.RecordingStream, progress: Progress = lambda done, total: None) -> None:
    """Send `run` to a stream of rerun."""
    announce(stream, run.recording, run.label, run.method, run.params, run.frames, run.steps)
    total, steps = len(run.frames), 0
    for start in range(0, total, BLOCK):
        frames = run.frames[start : start + BLOCK]
        traces = []
        for done, frame in enumerate(frames, start):
            progress(done, total)
            traces.append(EXTRACTORS[run.method].trace(run.recording[frame], run.params))
        begins = steps + np.cumsum([0, *map(len, traces)])
        steps = begins[-1]
        here = moments_of(run, frames)
        stepped = here._replace(step=begins[:-1]) if run.steps else here
        send_points(stream, traces, stepped)
        send_result(stream, traces, here)
        if run.recording.walls is not None and run.recording.poses is not None:
            walls = [truth(run.recording, frame, LIGHT).xyz for frame in frames]
            send_rows(stream, "laser/truth", here, rr.LineStrips3D.columns, strips=walls)
        send_decisions(stream, traces, stepped)
        if run.steps:
            send_replay(stream, traces, Moments(step=begins[:-1]))
    if run.frames:
        send_scores(stream, run)
    progress(total, total)


def moments_of(run: Run, frames: range) -> Moments:
    """Frames of the run on the timeline `frame` and, if the file has stamps, `stamp`."""
    stamps = np.asarray(run.recording.stamps, dtype=float)
    recorded = stamps[run.frames.start : run.frames.stop]
    # A file without stamps has the same stamp for every frame.
    stamped = np.isfinite(recorded).all() and np.ptp(recorded) > 0
    numbers = [run.recording.number(frame) for frame in frames]
    return Moments(np.array(numbers), stamps[frames.start : frames.stop] if stamped else None)


def send_points(stream: rr.RecordingStream, traces: Sequence[Trace], here: Moments) -> None:
    """The valid points, each in the class of its segment."""
    points = [raised(trace.scan.xy[trace.scan.valid]) for trace in traces]
    hues = [hue_of_beams(trace.extraction)[trace.scan.valid] for trace in traces]
    send_rows(stream, POINTS_OF["points"], here, rr.Points3D.columns, positions=points, class_ids=hues)


def send_result(stream: rr.RecordingStream, traces: Sequence[Trace], here: Moments) -> None:
    """The seeds, the segments, and the dropped candidates."""
    seeds = [raised(trace.scan.xy[seed_beams(trace)]) for trace in traces]
    send_rows(stream, POINTS_OF["seeds"], here, rr.Points3D.columns, positions=seeds)
    segments = [segment_strips(trace.extraction.segments) for trace in traces]
    hues = [hues_of(trace.extraction) for trace in traces]
    send_rows(stream, "laser/segments", here, rr.LineStrips3D.columns, strips=segments, class_ids=hues)
    dropped = [dropped_strips(trace.scan, trace.extraction.dropped) for trace in traces]
    send_rows(stream, "laser/dropped", here, rr.LineStrips3D.columns, strips=dropped)


def send_decisions(stream: rr.RecordingStream, traces: Sequence[Trace], here: Moments) -> None:
    """The decisions in words; all of them on the timeline `step`."""
    told = [notable(trace) if here.step is None else np.arange(len(trace)) for trace in traces]
    levels = np.array([level_of(kind) for kind in traces[0].vocabulary.kinds])
    kinds = np.concatenate([trace.log["kind"][indices] for trace, indices in zip(traces, told, strict=True)])
    texts = [text for trace, indices in zip(traces, told, strict=True) for text in trace.texts(indices)]
    if texts:
        moments = times(here.of_decisions(told))
        stream.send_columns("decisions", moments, rr.TextLog.columns(text=texts, level=levels[kinds]))


def send_replay(stream: rr.RecordingStream, traces: Sequence[Trace], begins: Moments) -> None:
    """The geometry of each decision, and the lines whenever they change; begins: the first decision of each frame."""
    if not any(map(len, traces)):
        return
    steps = times(begins.of_decisions([np.arange(len(trace)) for trace in traces]))
    lined, feet = map(np.concatenate, zip(*map(fitted_lines, traces), strict=True))
    strips = rr.LineStrips3D.columns(strips=raised(feet))
    stream.send_columns("laser/replay/line", steps, strips.partition(lined))
    pointed, points = map(np.concatenate, zip(*map(decided_points, traces), strict=True))
    positions = rr.Points3D.columns(positions=raised(points))
    stream.send_columns("laser/replay/beam", steps, positions.partition(pointed))
    changes = [np.union1d(np.arange(len(trace))[:1], notable(trace)) for trace in traces]
    lines = [standing_lines(trace, index) for trace, indices in zip(traces, changes, strict=True) for index in indices]
    send_rows(stream, "laser/replay/lines", begins.of_decisions(changes), rr.LineStrips3D.columns, strips=lines)


def fitted_lines(trace: Trace) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """(decisions,) whether a decision has a line; and (n, 2, 2) the part of each such line next to its window."""
    log = trace.log
    lines = np.array([log["line"][name] for name in "abc"])
    there = is_line(lines)
    ends = trace.as_beams(np.array([log["first"], log["last"]]))[:, there]
    return there, foot(trace.scan.xy[ends], lines[:, there]).swapaxes(0, 1)


def decided_points(trace: Trace) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """(decisions,) whether a decision is about one point; and (n, 2) these points."""
    beams = trace.as_beams(trace.log["beam"])
    there = beams >= 0
    return there, trace.scan.xy[beams[there]]


def standing_lines(trace: Trace, index: int) -> NDArray[np.float32]:
    """(n, 2, 3): the lines after a decision."""
    lines = trace.lines_at(index)
    ends = [foot(trace.scan.xy[[line.first, line.last]], line.line) for line in lines]
    return raised(np.array(ends).reshape(-1, 2, 2))


def send_scores(stream: rr.RecordingStream, run: Run) -> None:
    """The scores of every frame."""
    recording, frames = run.recording, run.frames
    # Some scores compare a frame with its neighbours.
    first, stop = max(frames.start - 1, 0), min(frames.stop + 1, len(recording))
    surveyed = survey(recording.only(np.arange(first, stop)), run.params)
    moments = times(moments_of(run, frames))
    for name in SCORES:
        values = surveyed.score(name)[frames.start - first : frames.stop - first]
        stream.send_columns(f"scores/{name}", moments, rr.Scalars.columns(scalars=values))


def notable(trace: Trace) -> NDArray[np.intp]:
    """Indices of the decisions that create or remove lines."""
    wanted = np.array([is_notable(kind) for kind in trace.vocabulary.kinds])
    return np.flatnonzero(wanted[trace.log["kind"]])


def is_notable(kind: Kind) -> bool:
    return kind.jump in NOTABLE or kind.name == "lines kept apart"


def level_of(kind: Kind) -> str:
    if kind.jump == "drop":
        return "WARN"
    return "INFO" if is_notable(kind) else "TRACE"


def seed_beams(trace: Trace) -> NDArray[np.int64]:
    """The beams of the seeds of the kept lines; none if the method has no seeds."""
    if "seed found" not in trace.vocabulary.names:
        return np.empty(0, np.int64)
    kept = set(trace.log["candidate"][trace.indices("endpoints")].tolist())
    found = trace.log[trace.indices("seed found")]
    windows = zip(*(found[name].tolist() for name in ("candidate", "first", "last")), strict=True)
    positions = [range(first, last + 1) for candidate, first, last in windows if candidate in kept]
    return trace.as_beams(np.array(list(chain.from_iterable(positions)), dtype=np.int64))
