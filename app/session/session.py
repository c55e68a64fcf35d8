"""One browser tab: its View, and a worker that draws the newest View."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from lineseg import Recording, Survey
from lineseg.failing import mistake
from lineseg.readers import Cancelled

from ..frame.geometry import beam_near
from ..live.ring import LiveRecording
from ..newest import Newest
from ..scene.portless import Door
from ..scene.viser_scene import ViserScene
from ..shelf.label_files import LabelFiles
from ..shelf.library import Library
from ..shelf.preview import for_the_page
from ..told.drawn import Timings
from ..told.messages import Failure, Loading
from ..view import View
from .composing import Composer
from .following import Presence, Presenter, Pupil, mirrored
from .loading import refused
from .pace import quick, takes_long, turn_of, waits_for
from .page import NOBODY, Page, Told
from .reading_on import ReadingOn
from .shown import Origin, Painted, Request, Shown, Watch
from .strip import Strip, key_of
from .surroundings import Surroundings
from .turns import Rounds
from .warm_up import WarmUp

if TYPE_CHECKING:
    from lineseg.line_map import LineMap

log = logging.getLogger(__name__)
# Shortest time between redraws of a live recording [s]; no scan is lost.
FOLLOW_EVERY = 0.04
# Longest time that closing waits for a picture [s].
CLOSING_SECONDS = 10.0


class Session:
    """Every input changes the View and has it drawn; while a picture is drawn, only the newest request is kept.

    Short work on a recording that is open is done in the event loop that answers all tabs, in `rounds`; a worker thread
    does the rest, and all of it without `rounds`. Creating a session starts a viser server, and blocks for a moment.
    """

    def __init__(
        self,
        id: str,
        library: Library,
        files: LabelFiles,
        warm_up: WarmUp,
        view: View,
        watch: Watch | None = None,
        rounds: Rounds | None = None,
    ) -> None:
        self.id = id
        self._watch = watch
        self._rounds = rounds
        self._warm_up = warm_up
        self.last_input = time.monotonic()
        # None while a page is there, and while the first one is still greeted.
        self.detached_at: float | None = None
        self._library = library
        self._composer = Composer(library, files)
        self._page: Page | None = None
        self._told = Told()
        self._shown: Shown | None = None
        # Scans of the live recording on the screen that were passed over, because newer ones had arrived.
        self.not_drawn = 0
        self._broken: set[str] = set()
        self._wanted = Request(0, view, 0, "page")
        self._done = 0
        self._cancelled = self._closing = False
        self._lock = threading.RLock()
        # Held while a picture is drawn, in the thread or in the loop.
        self._alone = threading.Lock()
        self._in_loop = False
        self._scene = ViserScene(self._change_from_scene, self._pick, rounds and rounds.loop)
        self._drawing = Newest(f"session {id[:6]}", self._work)
        self._strip = Strip(f"strip {id[:6]}", warm_up.surveyed, self._tell, self._surveyed)
        self._surroundings = Surroundings(id[:6], library, self._made_more)
        self._reading = ReadingOn(f"reading {id[:6]}", library, self._tell, self._keep_up)
        self._followed = 0.0
        self.presenter = Presenter()
        self._leave_presenter: Callable[[], None] | None = None
        self._presence: Presence | None = None
        # The class that it came to by a link, also while it goes its own way.
        self.teacher: Presenter | None = None
        self.pupil = Pupil()
        self._forget_live = library.live.on_scan(self._keep_up)
        self._forget_labels = files.on_change(self._relabelled)

    @property
    def door(self) -> Door:
        return self._scene.door

    @property
    def view(self) -> View:
        with self._lock:
            return self._wanted.view

    @property
    def shown(self) -> Shown | None:
        with self._lock:
            return self._shown

    def attach(self, page: Page, rev: int | None = None) -> None:
        """A page has connected; send it everything. rev: the page's revision."""
        self._reading.forget()
        with self._lock:
            self.detached_at = None
            self.last_input = time.monotonic()
            self._page = page
            self._told.forget()
            self._strip.keep(None)
            self._ask(self._wanted.view, self._wanted.rev if rev is None else rev, "page")
        self.presenter.tell("here")

    def detach(self) -> None:
        with self._lock:
            self.detached_at = time.monotonic()
            self._page = None
        self._strip.keep(None)
        self.presenter.tell("away")

    @property
    def following(self) -> bool:
        return self._presence in ("here", "away")

    def follow(self, presenter: Presenter | None) -> None:
        """Mirror a presenter: its View replaces this one whenever it changes. None ends it."""
        if self._leave_presenter is not None:
            self._leave_presenter()
            self._leave_presenter = None
        self.presenter_is(None)
        if presenter is not None and presenter is not self.presenter:
            self._leave_presenter = presenter.join(self)
            self.teacher = presenter

    def mirror(self, view: View) -> None:
        with self._lock:
            self.last_input = time.monotonic()
            own = mirrored(self._wanted.view, view)
            if own != self._wanted.view:
                self._ask(own, self._wanted.rev, "scene")

    def presenter_is(self, presence: Presence | None) -> None:
        """Send this to the page with the next picture."""
        with self._lock:
            self._presence = presence
            self._ask(self._wanted.view, self._wanted.rev, "scene")

    def change(self, patch: Mapping[str, Any], rev: int | None = None, origin: Origin = "page") -> None:
        """Change the View. Raises ValueError, and leaves the View unchanged, for a bad value."""
        with self._lock:
            self.last_input = time.monotonic()
            view = self._wanted.view.patched(patch)
            self._ask(view, self._wanted.rev if rev is None else rev, origin)

    def restore(self, said: Mapping[str, Any], rev: int | None = None) -> str | None:
        """Change the View by all that can be had of what a link says; a complaint about the rest, if any."""
        with self._lock:
            self.last_input = time.monotonic()
            view, complaint = self._wanted.view.salvaged(said)
            self._ask(view, self._wanted.rev if rev is None else rev, "page")
        return complaint

    def cancel(self) -> None:
        """Stop reading; what is shown of a file stays."""
        if self._reading.stop():
            return
        with self._lock:
            self._cancelled = self._done != self._wanted.number

    def close(self) -> None:
        """Stop the worker and the viser server; blocks until they have ended."""
        with self._lock:
            self._closing = True
            page, self._page = self._page, None
        if page is not None:
            page.hang_up()
        self._forget_live()
        self._forget_labels()
        self._library.live.leave(self.id)
        self.follow(None)
        self.presenter.tell("gone")
        self._strip.close()
        self._surroundings.close()
        self._reading.close()
        self._drawing.close()
        self._alone.acquire(timeout=CLOSING_SECONDS)
        self._scene.stop()

    def _ask(self, view: View, rev: int, origin: Origin, due: float = 0.0) -> None:
        self._wanted = Request(self._wanted.number + 1, view, rev, origin)
        self._strip.keep(view)
        if due or not self._goes_round():
            self._drawing.put(self._wanted, due)

    def _goes_round(self) -> bool:
        """Whether what is wanted now is drawn in the event loop."""
        if self._in_loop or self._rounds is None or not self._at_hand(self._wanted.view):
            return self._in_loop
        self._in_loop = True
        self._rounds.start(self._go_round)
        return True

    async def _go_round(self) -> None:
        """Draw the newest View in the event loop for as long as it is at hand; leave the rest to the thread."""
        assert self._rounds is not None
        alone = self._alone.acquire(blocking=False)
        try:
            while alone:
                async with self._rounds:
                    painted = self._painted_round()
                if painted is None:
                    return
                page, messages = self._news(painted)
                for message in messages:
                    await page.tell(message)
                self._afterwards(painted)
        except Exception:
            # The thread fails in the same way, and tells why.
            log.debug("drawing %s failed", self._wanted.view, exc_info=True)
        finally:
            with self._lock:
                self._in_loop = False
                if self._done != self._wanted.number:
                    self._drawing.put(self._wanted)
            if alone:
                self._alone.release()

    def _painted_round(self) -> Painted | None:
        """The newest picture; None if there is none to draw, or if it is for the thread."""
        with self._lock:
            request, shown = self._wanted, self._shown
            if shown is None or self._done == request.number or not self._at_hand(request.view):
                return None
        view = request.view
        if self._library.open_already(view.recording, view.read_as) is not shown.recording:
            return None
        return self._paint(request, shown.recording)

    def _at_hand(self, view: View) -> bool:
        """Whether drawing the View is short and waits for nothing, unless its file has changed."""
        if self._shown is None or self._page is None or self._closing or self._watch is not None or takes_long(view):
            return False
        shown = self._shown.view
        if view.mode == "learn" and (shown.mode, shown.frame, shown.params) != (view.mode, view.frame, view.params):
            # To write a trace for the page takes longer than a picture.
            return False
        return shown.place == view.place and quick(self._shown.recording) and not self._shown.recording.partial

    def _change_from_scene(self, patch: Mapping[str, Any]) -> None:
        if self.following:
            return
        try:
            self.change(patch, origin="scene")
        except ValueError as error:
            log.debug("the scene sent an invalid change: %s", error)

    def _pick(self, point: tuple[float, float], radius: float, beside: bool) -> None:
        """Select the beam whose point is nearest to a click, or none if no point is near.

        beside: compare it with the selected one; a click where no point is near changes nothing.
        """
        shown = self.shown
        if shown is None:
            return
        beam = beam_near(shown.found.scan, point, radius)
        if beside and shown.view.selected is not None:
            if beam is not None:
                self._change_from_scene({"beside": beam})
        else:
            self._change_from_scene({"selected": beam})

    def _work(self, request: Request) -> None:
        with self._alone:
            with self._lock:
                self._cancelled = False
                if request.number <= self._done:
                    # Drawn in the event loop meanwhile.
                    return
            self._attempt(request)
        self._keep_up()

    def _attempt(self, request: Request) -> None:
        try:
            self._draw(request)
        except Cancelled:
            self._fall_back(request, None)
        except (ValueError, OSError) as error:
            self._fall_back(request, str(error))
        except Exception as error:
            log.exception("drawing %s failed", request.view)
            self._fall_back(request, mistake(error))

    def _keep_up(self) -> None:
        """Draw a recording that has grown, if nothing else is to be drawn."""
        with self._lock:
            if self._behind() and self._done == self._wanted.number:
                self._followed = max(self._followed + FOLLOW_EVERY, time.monotonic())
                self._ask(self._wanted.view, self._wanted.rev, "page", due=self._followed)

    def _relabelled(self, recording: str) -> None:
        """Handle saved labels of a recording, from this or another tab."""
        with self._lock:
            if self._wanted.view.recording == recording:
                self._ask(self._wanted.view, self._wanted.rev, "scene")

    def _behind(self) -> bool:
        """Whether a newer frame of the live recording should be shown, or more was read of the file."""
        shown, wanted = self._shown, self._wanted.view
        if self._page is None or shown is None:
            return False
        if shown.recording.partial:
            return shown.view.place == wanted.place and self._reading.newer(shown.recording)
        if not (wanted.live and isinstance(shown.recording, LiveRecording)):
            return False
        source = self._library.live.get(wanted.recording)
        return source is not None and source.ring.total != shown.recording.total

    def _draw(self, request: Request) -> None:
        recording = self._load(request)
        if not self._warm_up.done.is_set():
            view, note = request.view, self._warm_up.label
            label = self._library.label(view.recording)
            self._tell(Loading(recording=view.recording, label=label, done=0, total=0, note=note))
            self._warm_up.done.wait()
        painted = self._painted(request, recording)
        if painted is None:
            return
        page, messages = self._news(painted)
        for message in messages:
            page.send(message)
        view = painted.content.view
        self._library.remember(view.recording, view.read_as)
        if self._watch is not None:
            self._watch(view, recording, self._library.label(view.recording), painted.content.found)
        self._afterwards(painted)

    def _news(self, painted: Painted) -> tuple[Page, list[BaseModel]]:
        """Note what is on the screen now. Returns the page, and what it does not know yet."""
        request, content, recording = painted.request, painted.content, painted.recording
        view = content.view
        with self._lock:
            self.not_drawn = _not_drawn(self.not_drawn, self._shown and self._shown.view, view)
            self._shown = Shown(view, recording, content.found, content.picture)
            self._done = request.number
            if self._wanted.number == request.number:
                self._wanted = replace(request, view=view)
            page = self._page or NOBODY
            messages = [] if page is NOBODY else self._told.news(painted, self._presence)
        self._library.live.follow(self.id, view.recording, view.method, view.params)
        return page, messages

    def _afterwards(self, painted: Painted) -> None:
        self.presenter.show(painted.content.view)
        # After the status: the scene's iframe shares a thread with the page, and its rendering would delay the status.
        self._scene.flush()
        self._survey()

    def _painted(self, request: Request, recording: Recording) -> Painted | None:
        """Draws the newest View when its turn comes; None as for `_newest`."""
        with turn_of(request.view):
            return self._paint(request, recording)

    def _paint(self, request: Request, recording: Recording) -> Painted | None:
        newest = self._newest(request)
        if newest is None:
            return None
        if isinstance(recording, LiveRecording) and newest.view.live:
            newest = _at_the_end(newest, recording)
        begun = time.perf_counter()
        content = self._composer.compose(newest.view, recording, self._surroundings.around(newest.view, recording))
        drawn = time.perf_counter()
        self._scene.draw(content.picture, content.view.params, content.view.dark)
        # They are kept with what was found.
        _ = content.found.marks
        timings: Timings = {"pictureMs": _ms(drawn - begun), "drawMs": _ms(time.perf_counter() - drawn)}
        return Painted(newest, recording, content, timings)

    def _newest(self, request: Request) -> Request | None:
        """What to draw instead, if more was asked for while this waited; None if that waits for something else."""
        with self._lock:
            wanted = self._wanted
            if wanted.number == request.number:
                return request
            if waits_for(wanted.view) != waits_for(request.view):
                return None
            self._drawing.drop()
            return wanted

    def _survey(self) -> None:
        """Update the strip to match the screen."""
        with self._lock:
            shown = self._shown
            if shown is not None and self._page is not None:
                passing = key_of(self._wanted.view) != key_of(shown.view)
                self._strip.want(shown.view, shown.recording, self._wanted.rev, passing)
                self._surroundings.want(self._wanted.view, shown)

    def _surveyed(self, recording: Recording, survey: Survey) -> None:
        """Draw the lines of all frames where they are shown."""
        with self._lock:
            self._surroundings.surveyed(recording, survey)
            if self._shown is not None and self._page is not None:
                self._surroundings.want(self._wanted.view, self._shown)
            if self._wanted.view.space == "world" and self._wanted.view.layers.all_lines:
                self._ask(self._wanted.view, self._wanted.rev, "scene")

    def _made_more(self) -> None:
        """Draw what was made aside where it is shown."""
        with self._lock:
            if self._wanted.view.space == "world":
                self._ask(self._wanted.view, self._wanted.rev, "scene")

    @property
    def line_map(self) -> LineMap | None:
        """The map on the screen."""
        with self._lock:
            return self._surroundings.line_map(self._shown.recording) if self._shown is not None else None

    def known(self, shown: Shown) -> tuple[Survey | None, LineMap | None]:
        """The lines of all frames with the thresholds of what is shown, and their map, where they are there already."""
        with self._lock:
            return self._surroundings.known(shown.recording, shown.view.params)

    def _load(self, request: Request) -> Recording:
        view, shown = request.view, self.shown
        if shown is not None and shown.paused(view):
            return shown.recording

        def wanted() -> bool:
            with self._lock:
                now = self._wanted.view
                return now.place == view.place and not self._cancelled and not self._closing

        before = None if shown is None or shown.view.place != view.place else shown.recording
        return self._reading.recording(view, wanted, before if before is not None and before.partial else None)

    def _fall_back(self, request: Request, message: str | None) -> None:
        """Keep the present picture; if there is none, show the first recording that works."""
        view, rev = request.view, request.rev
        with self._lock:
            self._done = request.number
            cancelled, self._cancelled = self._cancelled, False
            now = self._wanted
            if message is None and not cancelled and now.number != request.number:
                # Given up for another recording; what is wanted now waits, even if it is the same recording again.
                return
            if now.view.place == view.place:
                # Whatever joined it meanwhile fails with it.
                rev = now.rev
                self._broken.add(view.recording)
                other = View(recording=self._library.instead_of(self._broken), dark=view.dark)
                self._wanted = replace(now, view=self._shown.view if self._shown else other)
                if self._shown is None and other.recording:
                    self._ask(other, rev, "page")
                else:
                    self._done = self._wanted.number
                    self._drawing.drop()
        if message is None and cancelled:
            message = f"loading {self._library.label(view.recording)} was cancelled"
        if message is not None:
            file = None if cancelled else refused(self._library, view, message)
            told = message if file is None else for_the_page(message)
            self._tell(Failure(where="recording", message=told, rev=rev, refused=file))
        self._survey()

    def _tell(self, message: BaseModel) -> None:
        with self._lock:
            page = self._page
        if page is not None:
            page.send(message)


def _ms(seconds: float) -> float:
    return round(1e3 * seconds, 2)


def _not_drawn(so_far: int, before: View | None, view: View) -> int:
    """With the scans between two views of a live recording that follow it; 0 for another recording."""
    if before is None or before.recording != view.recording:
        return 0
    passed = view.frame - before.frame - 1 if before.live and view.live else 0
    return so_far + max(passed, 0)


def _at_the_end(request: Request, recording: Recording) -> Request:
    """The request, for the newest frame."""
    return replace(request, view=replace(request.view, frame=recording.number(len(recording) - 1)))
