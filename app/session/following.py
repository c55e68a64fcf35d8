"""Tabs that mirror another tab, as for a class that follows its teacher."""

from __future__ import annotations

import secrets
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, Protocol

from ..view import View
from ..view_field import view_fields

# Followers keep their own theme, camera and layers.
OWN = frozenset(name for name, entry in view_fields(View).items() if not entry.mirrored)

Presence = Literal["here", "away", "gone"]


@dataclass(frozen=True)
class Pupil:
    """What a tab in a class says of itself. name: "" if it gives none; done: number of lessons that are done."""

    name: str = ""
    done: int = 0


class Follower(Protocol):
    """A follower of a presenter. Both callbacks run in the presenter's threads, never at once, and must not block."""

    def mirror(self, view: View) -> None: ...

    def presenter_is(self, presence: Presence) -> None: ...


class Presenter:
    """A tab as presenter, with its followers. Its public id gives no control over the tab."""

    def __init__(self) -> None:
        self.id = secrets.token_urlsafe(12)
        self._followers: list[Follower] = []
        self._view: View | None = None
        self._presence: Presence = "here"
        self._lock = threading.Lock()

    def join(self, follower: Follower) -> Callable[[], None]:
        """Mirror to this follower from now on. Returns a function that ends it."""
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
        """Send the presenter's new View to the followers."""
        with self._lock:
            self._view = view
            for follower in self._followers:
                follower.mirror(view)

    def tell(self, presence: Presence) -> None:
        """Tell followers whether the presenter's page is there, briefly away, or gone for good."""
        with self._lock:
            if self._presence in (presence, "gone"):
                return
            self._presence = presence
            for follower in self._followers:
                follower.presenter_is(presence)
            if presence == "gone":
                self._followers.clear()


def mirrored(own: View, shown: View) -> View:
    """The View of a follower when its presenter shows `shown`."""
    kept = [name for name, entry in view_fields(type(own)).items() if not entry.mirrored]
    return replace(shown, **{name: getattr(own, name) for name in kept})
