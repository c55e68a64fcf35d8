"""All tabs of a server: opens, finds and closes their sessions."""

from __future__ import annotations

import asyncio
import secrets
import time
from dataclasses import dataclass

from starlette.exceptions import HTTPException

from ..memory import give_back
from ..shelf.label_files import LabelFiles
from ..shelf.library import Library
from ..view import View
from .following import Presenter
from .session import Session
from .shown import Shown, Watch
from .turns import Rounds
from .warm_up import WarmUp

REAP_EVERY = 5.0


class TooManySessionsError(ValueError):
    """Too many tabs are open."""


@dataclass(frozen=True)
class SessionLimits:
    """most: tabs at once. grace: how long a tab may be disconnected [s]; idle: how long a tab may have no input [s]."""

    most: int = 64
    grace: float = 120.0
    idle: float = 3600.0


class Sessions:
    """Use it in the event loop only; blocking work runs in threads."""

    def __init__(
        self,
        library: Library,
        files: LabelFiles,
        warm_up: WarmUp,
        limits: SessionLimits,
        watch: Watch | None = None,
    ) -> None:
        self._library = library
        self._files = files
        self._warm_up = warm_up
        self._limits = limits
        self._watch = watch
        self._sessions: dict[str, Session] = {}
        self._rounds: Rounds | None = None
        self._opening = 0
        self._closed = 0

    def __len__(self) -> int:
        return len(self._sessions)

    def get(self, id: str) -> Session | None:
        return self._sessions.get(id)

    def seen(self, id: str) -> Shown | None:
        """What a tab shows; None if there is no such tab or it shows nothing."""
        session = self._sessions.get(id)
        return session.shown if session is not None else None

    def shown(self, id: str) -> Shown:
        """What a tab shows, for an HTTP response; 404 if there is no such tab or it shows nothing."""
        shown = self.seen(id)
        if shown is None:
            raise HTTPException(404, "this tab shows no recording; reload the page")
        return shown

    def presenter(self, id: str) -> Presenter:
        """The presenter with this id. Raises ValueError if there is none."""
        for session in self._sessions.values():
            if secrets.compare_digest(session.presenter.id.encode(), id.encode()):
                return session.presenter
        raise ValueError("the presenter of this link is gone; ask for a new link")

    def class_of(self, teacher: Session) -> list[Session]:
        """The tabs that came by the link of this one and whose page is there."""
        return [
            session
            for session in self._sessions.values()
            if session.teacher is teacher.presenter and session.detached_at is None
        ]

    def resume(self, id: str | None) -> Session | None:
        """An earlier session whose page has disconnected; a session with a page is never shared."""
        session = self._sessions.get(id or "")
        return session if session is not None and session.detached_at is not None else None

    async def open(self, view: View) -> Session:
        """A new session. If there are too many, closes one without a page, or raises TooManySessionsError."""
        while len(self._sessions) + self._opening >= self._limits.most:
            away = [session for session in self._sessions.values() if session.detached_at is not None]
            if not away:
                raise TooManySessionsError(
                    f"{self._limits.most} tabs are open, which is the limit; close one and reload"
                )
            await self.close(min(away, key=lambda session: session.detached_at or 0.0))
        self._opening += 1
        try:
            self._rounds = self._rounds or Rounds(asyncio.get_running_loop())
            given = self._library, self._files, self._warm_up, view, self._watch, self._rounds
            session = await asyncio.to_thread(Session, secrets.token_urlsafe(16), *given)
        finally:
            self._opening -= 1
        # It took a while to make, in which nobody could have said anything.
        session.last_input = time.monotonic()
        self._sessions[session.id] = session
        return session

    async def close(self, session: Session) -> None:
        if self._sessions.pop(session.id, None) is not None:
            await asyncio.to_thread(session.close)
            self._closed += 1

    async def close_all(self) -> None:
        await asyncio.gather(*(self.close(session) for session in list(self._sessions.values())))

    async def reap(self) -> None:
        """Close unused sessions periodically."""
        while True:
            await asyncio.sleep(min(REAP_EVERY, self._limits.grace, self._limits.idle))
            # A while after the tabs were closed, when nothing refers to them any more.
            if self._closed:
                self._closed = 0
                await asyncio.to_thread(give_back)
            await asyncio.gather(*map(self.close, self._outdated()))

    def _outdated(self) -> list[Session]:
        now = time.monotonic()
        return [
            session
            for session in self._sessions.values()
            if (session.detached_at is not None and now - session.detached_at > self._limits.grace)
            or now - session.last_input > self._limits.idle
        ]
