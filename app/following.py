"""Tabs that mirror another one: a class that looks at what its teacher shows."""

from __future__ import annotations

import secrets
import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Literal, Protocol

from .view import View

# Theme, camera and layers stay the follower's own.
MIRRORED = (
    "recording", "topic", "frame", "method", "params", "step", "selected", "mode", "score", "against", "weights",
    "live",
)  # fmt: skip

Presence = Literal["here", "away", "gone"]


class Follower(Protocol):
    """Who mirrors a presenter; both are called in threads of the presenter."""

    def mirror(self, view: View) -> None: ...

    def presenter_is(self, presence: Presence) -> None: ...


class Presenter:
    """One side of it: whom a tab shows itself to, under an id of its own, which gives no control over the tab."""

    def __init__(self) -> None:
        self.id = secrets.token_urlsafe(12)
        self._followers: list[Follower] = []
        self._view: View | None = None
        self._presence: Presence = "here"
        self._lock = threading.Lock()

    def join(self, follower: Follower) -> Callable[[], None]:
        """Mirror to this follower too, from now on; the result ends that."""
        with self._lock:
            self._followers.append(follower)
            view, presence = self._view, self._presence
        follower.presenter_is(presence)
        if view is not None:
            follower.mirror(view)
        return lambda: self._leave(follower)

    def _leave(self, follower: Follower) -> None:
        with self._lock:
            if follower in self._followers:
                self._followers.remove(follower)

    def show(self, view: View) -> None:
        """The presenter looks at this."""
        with self._lock:
            self._view = view
            followers = list(self._followers)
        for follower in followers:
            follower.mirror(view)

    def tell(self, presence: Presence) -> None:
        """Whether the presenter's page is there, away for a moment, or gone for good."""
        with self._lock:
            if presence == self._presence:
                return
            self._presence = presence
            followers = list(self._followers)
        for follower in followers:
            follower.presenter_is(presence)


def mirrored(own: View, shown: View) -> View:
    """A follower's View when its presenter looks at `shown`."""
    return replace(own, **{name: getattr(shown, name) for name in MIRRORED})
