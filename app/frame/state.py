"""The `state` of a `drawn` message: everything the page shows about a picture."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from lineseg import Decision, FrameLabels, Recording, Segment, Thresholds, TrueLine, difference
from lineseg.failing import shown
from lineseg.poses import said_of
from lineseg.readers import Account
from lineseg.scan import PackAbout
from lineseg.writers.finite import finite_or_none

from ..live.ring import LiveRecording, numbering
from ..shelf.label_files import Known
from ..shelf.lesson import Looked
from ..told import drawn as told
from ..told.words import words_of
from ..view import View
from .findings import Findings, Histogram
from .framing import Framing, framing_near, framing_of
from .geometry import Bounds, extent_of
from .judge import Judged, Reference, agreement_told


def state_of(
    view: View,
    recording: Recording,
    label: str,
    found: Findings,
    bounds: Bounds,
    reference: Reference,
    since: float | None,
    pinned: Findings | None = None,
    judged: Judged | None = None,
    nodes: Iterable[str] = (),
    looked: Looked | None = None,
) -> told.Scene:
    """Everything except the drawing time and the marks, which are long and change only with the trace.

    nodes: names of what the scene shows. looked: at what the page of a lesson looks, if it is about this recording.
    """
    scan, trace, step = found.scan, found.trace, view.step
    return {
        **_of_view(view, recording),
        **_of_recording(view, recording, label),
        "stamp": finite_or_none(scan.stamp),
        "since": since,
        "frameId": scan.frame_id,
        "beams": len(scan),
        "valid": int(scan.valid.sum()),
        "covered": found.extraction.covered,
        "steps": len(trace),
        "difference": difference(pinned.extraction, found.extraction).counts if pinned is not None else None,
        "extent": extent_of(scan, bounds),
        "bounds": bounds,
        "segments": segments_told(found),
        "dropped": _dropped_once(found),
        "decision": _decision(trace[step], type(view.params)) if step is not None else None,
        "framing": _framed(found, view, step, looked),
        "ahead": _framed(found, view, step + 1, looked) if step is not None else None,
        "nodes": list(nodes),
        "world": None,
        "explanation": _explanation(found, view.selected) if view.selected is not None else None,
        "histograms": {name: _histogram(each) for name, each in found.histograms.items()},
        "agreement": agreement_told(judged.matching.agreement) if judged is not None else None,
        "labels": _labels(reference.known, view.frame) if reference.known is not None else None,
        "references": reference.available,
        "judgedBy": reference.chosen,
        "extractionUs": round(found.extraction_us, 1),
    }


def _of_view(view: View, recording: Recording) -> told.OfView:
    said = view.as_json()
    return {
        "view": said
        | {
            "topic": recording.topic if len(recording.topics) > 1 else None,
            # Of a recording that does not grow there is no newest frame to leave.
            "live": view.live or not isinstance(recording, LiveRecording),
        },
        "mode": view.mode,
        "frame": view.frame,
        "method": view.method,
        "params": said["params"],
        "step": view.step,
        "layers": said["layers"],
        "selected": view.selected,
        "camera": view.camera,
        "score": view.score,
        "against": said["against"],
        "weights": said["weights"],
        "reference": view.reference,
    }


def _of_recording(view: View, recording: Recording, label: str) -> told.OfRecording:
    first, every = numbering(recording)
    return {
        "recording": view.recording,
        "label": label,
        "format": recording.format,
        "pack": _pack(recording.pack) if recording.pack is not None else None,
        "topic": recording.topic,
        "topics": [{"name": topic.name, "scans": topic.scans} for topic in recording.topics],
        "place": view.place,
        "readAs": view.read_as.given(),
        "account": account_told(recording.account) if recording.account is not None else None,
        "frames": len(recording),
        "live": view.live if isinstance(recording, LiveRecording) else None,
        "first": first,
        "every": every,
        "growing": recording.partial,
        "mayHavePoses": recording.track is not None,
        "poses": said_of(recording.poses, recording.pose_source) if view.space == "world" else "",
        "truth": recording.walls is not None and recording.poses is not None,
        "byViews": recording.wall_source,
    }


def account_told(account: Account) -> told.Account:
    """What a file was taken for, as the page shows it."""
    return {
        "line": account.line,
        "used": account.used.given(),
        "guesses": [
            {"field": each.field, "value": each.value, "why": each.why, "change": each.change}
            for each in account.guesses
        ],
        "notices": [{"kind": each.kind, "text": each.text, "change": each.change} for each in account.notices],
        "skipped": account.skipped_text,
        "believable": account.believable,
    }


def _pack(about: PackAbout) -> told.Pack:
    return {
        "recording": about.recording,
        "frame": about.frame,
        "method": about.method,
        "params": about.params,
        "note": about.note,
    }


def segments_told(found: Findings) -> list[told.Segment]:
    """The segments, with their colours."""
    codes = ["#{:02x}{:02x}{:02x}".format(*colour) for colour in found.colours.tolist()]
    return [_segment(segment, code) for segment, code in zip(found.extraction.segments, codes, strict=True)]


def _segment(segment: Segment, colour: str) -> told.Segment:
    return {
        "start": segment.start,
        "end": segment.end,
        "first": segment.first,
        "last": segment.last,
        "line": segment.line,
        "points": segment.points,
        "length": segment.length,
        "rms": segment.rms,
        "colour": colour,
    }


def _dropped_once(found: Findings) -> list[told.Dropped]:
    """The dropped lines, each once: the longest of those that grew over mostly the same points from several seeds."""
    n = len(found.scan)
    first, last = found.drop_spans
    _, at = np.unique(first * n + last, return_index=True)
    first, length = first[at], (last[at] - first[at]) % n + 1
    ahead = (first - first[:, None]) % n
    shared = np.maximum(np.minimum(length[:, None], ahead + length) - ahead, 0)
    shared += np.maximum(np.minimum(length[:, None], ahead + length - n), 0)
    again = 2 * shared > length[:, None]
    left, kept = np.ones(len(first), np.bool_), list[int]()
    for k in np.argsort(-length, kind="stable").tolist():
        if left[k]:
            kept.append(k)
            left &= ~again[:, k]
    return _dropped(found, np.sort(at[kept]))


def _asked(found: Findings, first: NDArray[np.int64], last: NDArray[np.int64]) -> NDArray[np.int64]:
    """(lines,) a beam of each dropped line, in no segment if possible."""
    beams, line = found.trace.beams_of(first, last)
    free = found.extraction.labels[beams] < 0
    some = np.bincount(line[free], minlength=len(first)) > 0
    fitting = free | ~some[line]
    beams, counts = beams[fitting], np.bincount(line[fitting], minlength=len(first))
    if not len(beams):
        return first
    middle = np.cumsum(counts) - counts + counts // 2
    return np.where(counts > 0, beams.take(middle, mode="clip"), first)


def _dropped(found: Findings, which: NDArray[np.intp]) -> list[told.Dropped]:
    """Some of the dropped lines, by their numbers; much faster than from whole decisions."""
    indices, ends, checks = found.drops[which], found.drop_ends[which], found.trace.vocabulary.check_names
    rows = found.trace.log[indices]
    dx, dy = (ends[:, 1] - ends[:, 0]).T
    with np.errstate(invalid="ignore", over="ignore"):
        lengths = np.abs(rows["line"]["a"] * dy - rows["line"]["b"] * dx)
    lengths = np.where(np.isfinite(lengths), lengths, np.hypot(dx, dy))
    points = np.maximum(rows["last"] - rows["first"] + 1, 0)
    first, last = found.drop_spans[:, which]
    columns = ends, first, last, _asked(found, first, last), points, lengths, rows["check"]
    lines = zip(*(each.tolist() for each in columns), found.trace.texts(indices), strict=True)
    return [
        {
            "start": (start[0], start[1]),
            "end": (end[0], end[1]),
            "beam": beam,
            "first": first,
            "last": last,
            "points": many,
            "length": length,
            "check": checks[check],
            "text": text,
        }
        for (start, end), first, last, beam, many, length, check, text in lines
    ]


def _decision(decision: Decision, params: type[Thresholds]) -> told.Decision:
    a, b, c = decision.line
    return {
        "index": decision.index,
        "kind": decision.kind,
        "phase": decision.phase,
        "text": decision.text,
        "words": words_of(decision.text, params),
        "beam": decision.beam,
        "first": decision.first,
        "last": decision.last,
        # A kept line passed every check; the last one was its length.
        "check": "min_length" if decision.kind == "line kept" else decision.check,
        "direction": decision.direction,
        "points": decision.points,
        "candidate": decision.candidate,
        "value": finite_or_none(decision.value),
        "limit": finite_or_none(decision.limit),
        "line": (finite_or_none(a), finite_or_none(b), finite_or_none(c)),
    }


def _framed(found: Findings, view: View, step: int | None, looked: Looked | None) -> told.Framing | None:
    """The framing of a step, or of the page of a lesson that shows the whole result."""
    if view.mode != "learn" or view.closeup == "off":
        return None
    if step is not None:
        framing = framing_of(found, step) if step < len(found.trace) else None
    else:
        if looked is None:
            return None
        framing = framing_near(found, looked.near, looked.names)
    return framing and framing_told(framing, outcome=step is None or step == view.step)


def framing_told(framing: Framing, outcome: bool = True) -> told.Framing:
    """The view of a decision; without its outcome, it lacks what would answer a question about it."""
    return {
        "box": framing.box,
        "factor": framing.factor,
        "normal": framing.normal,
        "at": framing.at,
        "names": [{"text": name.text, "at": name.at} for name in framing.names if outcome or not name.tells],
        "measures": [
            {"text": each.text, "start": each.start, "end": each.end, "beside": each.beside}
            for each in framing.measures
            if outcome
        ],
    }


def _explanation(found: Findings, beam: int) -> told.Explanation:
    explained = found.trace.explain(beam)
    return {
        "beam": explained.beam,
        "text": explained.text,
        "words": words_of(explained.text, type(found.trace.params)),
        "segment": explained.segment,
        "check": explained.check,
        "value": finite_or_none(explained.value),
        "limit": finite_or_none(explained.limit),
        "margin": finite_or_none(explained.margin),
        "at": found.scan.xy[beam].tolist() if found.scan.valid[beam] else None,
    }


def _histogram(counted: Histogram) -> told.Histogram:
    return {
        "low": counted.low,
        "high": counted.high,
        "log": counted.log,
        "passed": counted.passed,
        "failed": counted.failed,
    }


def _labels(known: Known, frame: int) -> told.Labels:
    return {
        **labels_told(known.of(frame)),
        "file": shown(known.path.name),
        "folder": shown(known.path.parent),
        "apart": known.apart,
        "stamp": known.stamp,
        "trouble": known.trouble,
    }


def labels_told(said: FrameLabels) -> told.Labelled:
    """The labels of a frame."""
    lines = None if said.lines is None else [_true_line(line) for line in said.lines]
    return {"revision": said.revision, "lines": lines, "tags": said.tags, "note": said.note}


def _true_line(line: TrueLine) -> told.TrueLine:
    return {"first": line.first, "last": line.last, "start": line.start, "end": line.end}
