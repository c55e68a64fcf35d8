"""Routes about what a tab shows: which thresholds change an answer, agreement with the truth, what looks wrong."""

from __future__ import annotations

from fastapi import FastAPI
from starlette.exceptions import HTTPException

from lineseg import Relation, Remark, Thresholds, what_if, why, why_apart

from ..frame.judge import Reference, agreement_told, judged, judged_recording
from ..session.sessions import Sessions
from ..session.shown import Shown
from ..shelf.label_files import LabelFiles
from ..told.answers import Apart, Finding, Judgement, Truth, WhatIfs, Whys
from ..told.words import words_of
from ..view import View

# Largest number of rows in view in the list of frames.
MOST_ROWS = 60


def _apart(view: View, selected: int, beside: int, relation: Relation) -> Apart:
    kind = type(view.params)
    return {
        "frame": view.frame,
        "selected": selected,
        "beside": beside,
        "method": view.method,
        "params": view.params.numbers(),
        "together": relation.together,
        "one": relation.one,
        "other": relation.other,
        "words": words_of(relation.text, kind),
        "changes": [
            {"values": each.values, "words": words_of(each.text, kind), "first": each.first, "last": each.last}
            for each in relation.changes
        ],
    }


def _finding(remark: Remark, params: type[Thresholds]) -> Finding:
    return {
        "score": remark.score,
        "words": words_of(remark.text, params, remark.ghosts),
        "first": remark.first,
        "last": remark.last,
        "ghosts": list(remark.ghosts),
    }


def add_inspection(app: FastAPI, sessions: Sessions, files: LabelFiles) -> None:
    """Routes of /api that inspect what a tab shows."""
    _add_reasons(app, sessions)
    _add_agreement(app, sessions, files)


def _add_reasons(app: FastAPI, sessions: Sessions) -> None:
    """What would change, why two beams are apart, and what looks wrong."""

    @app.get("/api/what-if")
    def what_would_change(session: str = "") -> WhatIfs:
        shown = sessions.shown(session)
        view, beam = shown.view, shown.view.selected
        changes = () if beam is None else what_if(shown.found.scan, beam, view.params, view.method)
        return {
            "frame": view.frame,
            "beam": beam,
            "method": view.method,
            "params": view.params.numbers(),
            "changes": list(changes),
        }

    @app.get("/api/apart")
    def why_two_beams_are_apart(session: str = "") -> Apart:
        shown = sessions.shown(session)
        view = shown.view
        if view.selected is None or view.beside is None:
            raise HTTPException(400, "two beams are compared; select another one beside the selected one")
        return _apart(
            view,
            view.selected,
            view.beside,
            why_apart(shown.found.scan, view.selected, view.beside, view.params, view.method),
        )

    @app.get("/api/why")
    def what_looks_wrong(session: str = "", frames: str = "") -> Whys:
        shown = sessions.shown(session)
        view, recording = shown.view, shown.recording
        try:
            wanted = [int(frame) for frame in frames.split(",")[:MOST_ROWS] if recording.has(int(frame))]
        except ValueError:
            raise HTTPException(400, f"frames is {frames[:60]!r}; give numbers separated by commas") from None
        if len(recording) < 2:
            wanted = []
        found = dict[int, list[Finding]]()
        for frame in wanted:
            now = sessions.shown(session)
            if now.recording is not recording or now.view.params != view.params:
                break
            remarks = why(recording, recording.position(frame), view.params)
            found[frame] = [_finding(each, type(view.params)) for each in remarks]
        return {
            "place": view.place,
            "method": view.method,
            "params": view.params.numbers(),
            "found": found,
            "whole": len(found) == len(wanted),
        }


def _add_agreement(app: FastAPI, sessions: Sessions, files: LabelFiles) -> None:
    """How well the segments agree with the true lines, in one frame and in all."""

    def reference_of(session: str) -> tuple[Shown, Reference]:
        """What a tab shows, and the true lines with which it is compared."""
        shown = sessions.shown(session)
        known = files.known(shown.view.recording, shown.recording)
        return shown, Reference.of(shown.view.reference, shown.recording, known)

    @app.get("/api/judged")
    def judged_frame(session: str = "") -> Judgement:
        shown, reference = reference_of(session)
        view = shown.view
        said = reference.said.of(view.frame) if reference.said is not None else None
        found = judged(shown.found, said) if reference.chosen else None
        return {
            "frame": view.frame,
            "method": view.method,
            "params": view.params.numbers(),
            "agreement": None if found is None else agreement_told(found.matching.agreement),
            "byViews": reference.chosen == "wall" and bool(shown.recording.wall_source),
        }

    @app.get("/api/truth")
    def truth(session: str = "") -> Truth:
        shown, reference = reference_of(session)
        view = shown.view
        if not reference.chosen:
            raise HTTPException(404, "the true lines of this recording are not known; label some frames first")
        said = reference.said
        agreement, stride = judged_recording(shown.recording, view.method, view.params, said and said.labels)
        return {
            "recording": view.recording,
            "method": view.method,
            "params": view.params.numbers(),
            "judgedBy": reference.chosen,
            "labelled": said.stamp if said else "",
            "agreement": agreement_told(agreement),
            "stride": stride,
        }
