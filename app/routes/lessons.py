"""Lessons that are offered or dropped on the page, their pictures, and new lessons of what a tab shows."""

from __future__ import annotations

import json
from typing import Annotated, Any
from urllib.parse import urlencode

import numpy as np
from fastapi import FastAPI, Request
from fastapi.responses import FileResponse, HTMLResponse, PlainTextResponse
from pydantic import Field
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg import EXTRACTORS, Params

from ..bounds import Message, Number
from ..frame.lesson_shown import decisions_of, frames_to_label, times_here
from ..handout.sheet import sheet_page
from ..session.sessions import Sessions
from ..shelf.lesson import USUAL, Lessons, NamedLesson
from ..shelf.lesson_draft import drafted
from ..shelf.lesson_markup import MEDIA
from ..shelf.lesson_shelf import LessonShelf
from ..shelf.library import Library
from ..told.answers import Fitted, FrameToLabel, TimesHere
from ..told.messages import TraceColumns
from ..tuning.fit import fit
from .body import announced_size, storing
from .slow import SlowWork

Short = Annotated[str, Field(min_length=1, max_length=300)]
HINT = "Go back and look again."


class NewLesson(Message):
    """The texts of a lesson that is made of what a tab shows. box: of the plan on the stage [m]."""

    title: Annotated[str, Field(min_length=1, max_length=60)]
    about: Annotated[str, Field(min_length=1, max_length=200)]
    text: Annotated[str, Field(min_length=1, max_length=2000)]
    question: Annotated[str, Field(min_length=1, max_length=2000)]
    right: Short
    wrong: Annotated[list[Short], Field(min_length=1, max_length=6)]
    box: tuple[Number, Number, Number, Number] | None = None


def add_lessons(app: FastAPI, library: Library, sessions: Sessions) -> None:
    """Routes of /api/lessons."""
    slow = SlowWork("measurements", 2, 60.0)
    _add_shelf(app, library.lessons, slow)
    _add_measured(app, sessions, slow)

    @app.post("/api/lessons/new")
    async def new(said: NewLesson, session: str = "") -> PlainTextResponse:
        """The file of a lesson of one step with a question, about what this tab shows."""
        shown = sessions.shown(session)
        try:
            made = await run_in_threadpool(drafted, shown.view, shown.found.scan, shown.found.trace, said.box)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        return PlainTextResponse(json.dumps(_with_texts(made, said), indent=2, ensure_ascii=False) + "\n")


def _add_shelf(app: FastAPI, shelf: LessonShelf, slow: SlowWork) -> None:
    """The lessons that are there, and their files."""
    opening = SlowWork("lessons that are opened", 4, 60.0)

    @app.get("/api/lessons")
    def lessons() -> Lessons:
        return shelf.told()

    @app.get("/api/lessons/one")
    def named(id: str = "") -> NamedLesson | None:
        """None, not an error: a browser's console would complain of every link to a lesson that is gone."""
        return shelf.find(id)

    def one(id: str) -> NamedLesson:
        lesson = shelf.find(id)
        if lesson is None:
            raise HTTPException(404, f"there is no lesson {id[:60]!r} on this server")
        return lesson

    @app.get("/lessons/{id:path}/print")
    async def sheet(id: str) -> HTMLResponse:
        """A lesson to print."""
        lesson = await run_in_threadpool(one, id)

        def address(name: str) -> str:
            return f"/api/lessons/picture?{urlencode({'id': id, 'name': name})}"

        return HTMLResponse(await slow.run(sheet_page, shelf, lesson, address))

    @app.get("/api/lessons/picture")
    def picture(id: str = "", name: str = "") -> FileResponse:
        try:
            path = shelf.picture(id, name)
        except ValueError as error:
            raise HTTPException(404, str(error)) from None
        return FileResponse(path, media_type=MEDIA[path.suffix.lower()])

    @app.post("/api/lessons/file")
    async def file(request: Request, name: str = "lesson.json", into: str = "") -> dict[str, str]:
        """into: the id of the folder of a lesson, for all of its files but the first."""
        with storing(name):
            return {"folder": await shelf.receive(name, announced_size(request), request.stream(), into)}

    @app.post("/api/lessons/open")
    async def open_dropped(folder: str = "") -> list[NamedLesson]:
        try:
            return await opening.run(shelf.open_dropped, folder)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None


def _add_measured(app: FastAPI, sessions: Sessions, slow: SlowWork) -> None:
    """What pages of lessons show about the recording of a tab."""

    @app.get("/api/lessons/noise")
    async def noise(session: str = "") -> Fitted:
        shown = sessions.shown(session)
        stop = np.zeros(1, np.bool_)
        return await slow.run(lambda: next(fit(shown.recording, shown.view.params, shown.view.method, stop)))

    @app.get("/api/lessons/times")
    async def times(session: str = "") -> TimesHere:
        return await slow.run(times_here, sessions.shown(session).recording)

    @app.get("/api/lessons/frames")
    async def frames(session: str = "") -> list[FrameToLabel]:
        shown = sessions.shown(session)
        return await run_in_threadpool(frames_to_label, shown.recording, Params().but(**USUAL))

    @app.get("/api/lessons/decisions")
    async def decisions(session: str = "", method: str = "") -> TraceColumns:
        """The decisions of another method, with its default thresholds, about the frame that a tab shows."""
        if method not in EXTRACTORS:
            raise HTTPException(400, f"there is no method {method[:40]!r}; choose from {', '.join(EXTRACTORS)}")
        return await run_in_threadpool(decisions_of, sessions.shown(session).found.scan, method)


def _with_texts(made: dict[str, Any], said: NewLesson) -> dict[str, Any]:
    step = {"text": said.text} | made["steps"][0]
    answers = [{"text": said.right, "right": True}, *({"text": each} for each in said.wrong)]
    task = {"text": said.question, "hint": HINT, "done": said.right, "choice": answers}
    if "near" in step:
        task["near"] = step["near"]
    scan = {"scan": made["scan"]} if "scan" in made else {}
    rest = {name: value for name, value in made.items() if name not in ("steps", "scan")}
    return {"title": said.title, "about": said.about, **rest, "steps": [step], "task": task, **scan}
