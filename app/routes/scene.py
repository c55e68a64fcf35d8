"""Routes about the picture that a tab shows: its shapes for a 2D canvas, and what lies at a place of it."""

from __future__ import annotations

from fastapi import FastAPI

from ..frame.geometry import beam_near
from ..scene.flat import flat
from ..session.sessions import Sessions
from ..told.answers import Near
from ..told.handout import FlatPicture


def add_scene(app: FastAPI, sessions: Sessions) -> None:
    """Routes of /api about the picture of a tab."""

    @app.get("/api/picture")
    def drawn(session: str = "") -> FlatPicture:
        return flat(sessions.shown(session).picture)

    @app.get("/api/beam")
    def beam(x: float, y: float, radius: float, session: str = "") -> Near:
        return {"beam": beam_near(sessions.shown(session).found.scan, (x, y), radius)}
