"""What the page is told about a picture: the `state` of a `drawn` message."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from lineseg import Decision, FrameLabels, Recording, TrueLine, difference
from lineseg.writers.finite import finite_or_none

from ..live.ring import LiveRecording, first_of
from ..shelf.label_files import Known
from ..view import View
from ..wire import segments_json, topics_json
from .findings import Findings
from .geometry import Bounds, extent_of
from .judge import Judged, Reference, as_json


def state_of(
    view: View,
    recording: Recording,
    label: str,
    found: Findings,
    bounds: Bounds,
    reference: Reference,
    pinned: Findings | None = None,
    judged: Judged | None = None,
) -> dict[str, Any]:
    """Everything but the marks, which are long and change with the trace only, and how long the drawing took."""
    scan, trace = found.scan, found.trace
    chosen = trace[view.step] if view.step is not None else None
    return {
        "mode": view.mode,
        "recording": view.recording,
        "label": label,
        "format": recording.format,
        "pack": asdict(recording.pack) if recording.pack is not None else None,
        "topic": recording.topic,
        "topics": topics_json(recording),
        "frame": view.frame,
        "frames": len(recording),
        "live": view.live if isinstance(recording, LiveRecording) else None,
        "first": first_of(recording),
        "stamp": finite_or_none(scan.stamp),
        "frameId": scan.frame_id,
        "beams": len(scan),
        "valid": int(scan.valid.sum()),
        "covered": found.extraction.covered,
        "method": view.method,
        "params": view.params.numbers(),
        "step": view.step,
        "steps": len(trace),
        "layers": asdict(view.layers),
        "selected": view.selected,
        "camera": view.camera,
        "score": view.score,
        "against": view.against.numbers() if view.against is not None else None,
        "weights": view.all_weights,
        "difference": difference(pinned.extraction, found.extraction).counts if pinned is not None else None,
        "extent": extent_of(scan, bounds),
        "bounds": bounds,
        "segments": segments_json(found.extraction),
        "dropped": [_dropped(found, drop) for drop in found.drops],
        "decision": _decision(chosen),
        "explanation": _explanation(found, view.selected),
        "histograms": {name: asdict(histogram) for name, histogram in found.histograms.items()},
        "truth": recording.walls is not None and recording.poses is not None,
        "agreement": as_json(judged.matching.agreement) if judged is not None else None,
        "labels": _labels(reference.known, view.frame) if reference.known is not None else None,
        "reference": view.reference,
        "references": reference.available,
        "judgedBy": reference.chosen,
        "extractionUs": round(found.extraction_us, 1),
    }


def _dropped(found: Findings, drop: Decision) -> dict[str, Any]:
    start, end = found.ends(drop)
    across = end - start
    length = abs(drop.line[0] * across[1] - drop.line[1] * across[0])
    if not np.isfinite(length):
        length = np.hypot(*across)
    return {
        "first": drop.first,
        "last": drop.last,
        "points": drop.points,
        "length": float(length),
        "check": drop.check,
        "text": drop.text,
    }


def _decision(decision: Decision | None) -> dict[str, Any] | None:
    if decision is None:
        return None
    names = ("index", "kind", "phase", "text", "beam", "first", "last", "check", "direction", "points", "candidate")
    told = {name: getattr(decision, name) for name in names}
    if decision.kind == "line kept":
        # It passed every check; the last of them was its length.
        told["check"] = "min_length"
    return told | {
        "value": finite_or_none(decision.value),
        "limit": finite_or_none(decision.limit),
        "line": [finite_or_none(value) for value in decision.line],
    }


def _explanation(found: Findings, beam: int | None) -> dict[str, Any] | None:
    if beam is None:
        return None
    told = asdict(found.trace.explain(beam))
    told["at"] = found.scan.xy[beam].tolist() if found.scan.valid[beam] else None
    return told | {name: finite_or_none(told[name]) for name in ("value", "limit", "margin")}


def _labels(known: Known, frame: int) -> dict[str, Any]:
    return labels_json(known.of(frame)) | {
        "file": known.path.name,
        "folder": str(known.path.parent),
        "apart": known.apart,
        "stamp": known.stamp,
        "trouble": known.trouble,
    }


def labels_json(said: FrameLabels) -> dict[str, Any]:
    """What people say of a frame."""
    lines = None if said.lines is None else [_true_line(line) for line in said.lines]
    return {"revision": said.revision, "lines": lines, "tags": said.tags, "note": said.note}


def _true_line(line: TrueLine) -> dict[str, Any]:
    return {"first": line.first, "last": line.last, "start": line.start, "end": line.end}
