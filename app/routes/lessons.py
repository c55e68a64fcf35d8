"""Lessons that are offered or dropped on the page, their pictures, and new lessons of what a tab shows."""

from __future__ import annotations

import json
from typing import Annotated, Any

from fastapi import FastAPI, Request
from fastapi.responses import FileResponse, PlainTextResponse
from pydantic import Field
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from ..bounds import Message, Number
from ..session.sessions import Sessions
from ..shelf.lesson import Lessons, NamedLesson
from ..shelf.lesson_draft import drafted
from ..shelf.lesson_markup import MEDIA
from ..shelf.library import Library
from ..shelf.uploads import TooLargeError, TooManyError, TooSlowError

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
    shelf = library.lessons

    @app.get("/api/lessons")
    def lessons() -> Lessons:
        return shelf.told()

    @app.get("/api/lessons/one")
    def one(id: str = "") -> NamedLesson:
        lesson = shelf.find(id)
        if lesson is None:
            raise HTTPException(404, f"there is no lesson {id[:60]!r} on this server")
        return lesson

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
        length = request.headers.get("content-length", "")
        size = int(length) if length.isascii() and length.isdigit() else None
        try:
            return {"folder": await shelf.receive(name, size, request.stream(), into)}
        except (TooLargeError, TooManyError, TooSlowError) as error:
            raise HTTPException(413 if isinstance(error, TooLargeError) else 429, str(error)) from None
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        except OSError as error:
            raise HTTPException(507, f"{name[:80]} could not be stored: {error.strerror}") from None

    @app.post("/api/lessons/open")
    def open_dropped(folder: str = "") -> list[NamedLesson]:
        try:
            return shelf.open_dropped(folder)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None

    @app.post("/api/lessons/new")
    async def new(said: NewLesson, session: str = "") -> PlainTextResponse:
        """The file of a lesson of one step with a question, about what this tab shows."""
        shown = sessions.shown(session)
        try:
            made = await run_in_threadpool(drafted, shown.view, shown.found.scan, shown.found.trace, said.box)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        return PlainTextResponse(json.dumps(_with_texts(made, said), indent=2, ensure_ascii=False) + "\n")


def _with_texts(made: dict[str, Any], said: NewLesson) -> dict[str, Any]:
    step = {"text": said.text} | made["steps"][0]
    answers = [{"text": said.right, "right": True}, *({"text": each} for each in said.wrong)]
    task = {
        "text": said.question,
        "hint": HINT,
        "done": said.right,
        "choice": answers,
        **{name: step[name] for name in ("near",) if name in step},
    }
    scan = {"scan": made["scan"]} if "scan" in made else {}
    rest = {name: value for name, value in made.items() if name not in ("steps", "scan")}
    return {"title": said.title, "about": said.about, **rest, "steps": [step], "task": task, **scan}
