"""Tabs that mirror another one: a class that looks at what its teacher shows."""

from __future__ import annotations

import secrets
import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Literal, Protocol

from ..view import View
from ..view_field import view_fields

# Theme, camera and layers stay the follower's own.
OWN = frozenset(name for name, entry in view_fields(View).items() if not entry.mirrored)

Presence = Literal["here", "away", "gone"]


class Follower(Protocol):
    """Who mirrors a presenter; both are called in threads of the presenter, one after the other, and do not wait."""

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
            follower.presenter_is(self._presence)
            if self._presence != "gone":
                self._followers.append(follower)
                if self._view is not None:
                    follower.mirror(self._view)
        return lambda: self._leave(follower)

    def _leave(self, follower: Follower) -> None:
        with self._lock:
            if follower in self._followers:
                self._followers.remove(follower)

    def show(self, view: View) -> None:
        """The presenter looks at this."""
        with self._lock:
            self._view = view
            for follower in self._followers:
                follower.mirror(view)

    def tell(self, presence: Presence) -> None:
        """Whether the presenter's page is there, away for a moment, or gone for good: its last word."""
        with self._lock:
            if self._presence in (presence, "gone"):
                return
            self._presence = presence
            for follower in self._followers:
                follower.presenter_is(presence)
            if presence == "gone":
                self._followers.clear()


def mirrored(own: View, shown: View) -> View:
    """A follower's View when its presenter looks at `shown`."""
    kept = [name for name, entry in view_fields(type(own)).items() if not entry.mirrored]
    return replace(shown, **{name: getattr(own, name) for name in kept})
