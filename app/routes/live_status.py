"""Sends a page the status of its live source, even while no scans arrive."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable

from starlette.websockets import WebSocketDisconnect

from ..live.hub import Live
from ..session.session import Session
from ..told.messages import LiveStatus

EVERY = 0.25


async def tell_live(tell: Callable[[LiveStatus], Awaitable[None]], session: Session, live: Live) -> None:
    """Send the status whenever it changes, until cancelled or until the page is gone."""
    told = None
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while True:
            source = live.get(session.view.recording)
            status = source.status(session.id, session.not_drawn) if source is not None else None
            if status is not None and status != told:
                await tell(status)
            told = status
            await asyncio.sleep(EVERY)
