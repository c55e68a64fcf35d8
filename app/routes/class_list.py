"""Who is where in a class. Names and places stay in memory, and are told to the teacher's tab alone."""

from __future__ import annotations

from typing import Annotated

from fastapi import FastAPI
from pydantic import Field
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from ..bounds import Message
from ..session.following import Pupil
from ..session.session import Session
from ..session.sessions import Sessions
from ..shelf.library import Library
from ..told.answers import PupilPlace

LONGEST_NAME = 40
MOST_DONE = 999


class PupilSays(Message):
    """What a tab in a class says of itself."""

    name: Annotated[str, Field(max_length=LONGEST_NAME)]
    done: Annotated[int, Field(ge=0, le=MOST_DONE)] = 0


def add_class(app: FastAPI, library: Library, sessions: Sessions) -> None:
    """Routes of /api/class."""

    def session_of(id: str) -> Session:
        session = sessions.get(id)
        if session is None:
            raise HTTPException(404, "this tab is not known; reload the page")
        return session

    @app.post("/api/class/me")
    async def me(said: PupilSays, session: str = "") -> dict[str, bool]:
        pupil = session_of(session)
        if pupil.teacher is None:
            raise HTTPException(400, "this tab is in no class; open the link of a teacher first")
        pupil.pupil = Pupil(" ".join(said.name.split()), said.done)
        return {"told": True}

    @app.get("/api/class")
    async def class_list(session: str = "") -> list[PupilPlace]:
        pupils = sessions.class_of(session_of(session))
        places = await run_in_threadpool(lambda: [place_of(each, library) for each in pupils])
        return sorted(places, key=lambda place: (not place["name"], place["name"].casefold()))


def place_of(session: Session, library: Library) -> PupilPlace:
    view = session.view
    lesson = library.lessons.find(view.lesson) if view.lesson else None
    return {
        "name": session.pupil.name,
        "follows": session.following,
        "lesson": lesson.title if lesson else "",
        "page": view.page + 1 if lesson else 0,
        "pages": len(lesson.steps) + 1 if lesson else 0,
        "recording": library.label(view.recording),
        "frame": view.frame,
        "done": session.pupil.done,
    }
