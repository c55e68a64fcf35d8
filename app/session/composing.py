"""From a View to its content: findings, judgement, the picture for the scene and the state for the page."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from lineseg import Recording, Survey
from lineseg.survey.disputes import lines_missed

from ..frame.clock import Clock
from ..frame.findings import Findings, findings_in
from ..frame.geometry import Bounds, bounds_of, united
from ..frame.judge import Reference, judged
from ..frame.state import state_of
from ..live.ring import LiveRecording
from ..scene.beside import OtherLaser, beside_told
from ..scene.palette import DARK, LIGHT
from ..scene.picture import Picture, picture, picture_in_world
from ..scene.world import World
from ..shelf.label_files import LabelFiles
from ..shelf.lesson import Looked
from ..shelf.library import Library
from ..told.drawn import Scene
from ..told.drawn import World as WorldState
from ..told.messages import Times
from ..view import View

if TYPE_CHECKING:
    from lineseg.line_map import LineMap

# While a slider is dragged each picture is new, and what is kept of it takes up to 200 kB in each tab.
FRAMES_KEPT = 8


@dataclass(frozen=True, eq=False)
class Content:
    """view: the requested View, with frame, beam and step limited to the existing ones."""

    view: View
    found: Findings
    picture: Picture
    state: Scene
    clock: Clock

    def times(self) -> Times:
        """When each frame was taken, to the millisecond."""
        since = None if self.clock.since is None else self.clock.since.round(3).tolist()
        return Times(place=self.view.place, since=since, why=self.clock.trouble)


@dataclass(frozen=True, eq=False)
class Around:
    """What is drawn around a frame in the world, made aside.

    lines: of all frames, if they are known. mapped: these, merged, or why they are not; None before it; percent: how
    much of it is made. lasers: the others of the robot.
    """

    lines: Survey | None = None
    mapped: LineMap | str | None = None
    percent: int = 0
    lasers: tuple[OtherLaser, ...] = ()

    @property
    def line_map(self) -> LineMap | None:
        return None if isinstance(self.mapped, str) else self.mapped

    def told(self, view: View, world: World, frame: int) -> WorldState:
        """What the page says of the world at a frame."""
        pose, theme = world.pose(frame), DARK if view.dark else LIGHT
        return {
            "pose": pose and list(pose),
            "upsideDown": world.upside_down,
            "map": self.line_map.text if self.line_map else str(self.mapped or ""),
            "mapPercent": self.percent,
            "lasers": beside_told(self.lasers, float(world.recording.stamps[frame]), theme),
        }


class Composer:
    """Caches the findings of the latest frames. Use it in one thread only."""

    def __init__(self, library: Library, files: LabelFiles) -> None:
        self._library, self._files = library, files
        # While a slider moves, the scan stays the same, and with it what is known of its points.
        self._scan = lru_cache(maxsize=2)(Recording.__getitem__)
        self._findings = lru_cache(maxsize=FRAMES_KEPT)(
            lambda recording, frame, method, params: findings_in(self._scan(recording, frame), method, params)
        )
        self._judged = lru_cache(maxsize=FRAMES_KEPT)(judged)
        self._ghosts = lru_cache(maxsize=FRAMES_KEPT)(lines_missed)
        self._clock = lru_cache(maxsize=4)(Clock.of)
        self._bounds = lru_cache(maxsize=4)(bounds_of)
        self._world = lru_cache(maxsize=2)(World.of)
        self._growing_bounds: tuple[str, int, Bounds] = ("", 0, (0.0, 0.0, 0.0, 0.0))

    def compose(self, view: View, recording: Recording, around: Around) -> Content:
        view = _inside(view, recording)
        frame = recording.position(view.frame)
        found = self._findings(recording, frame, view.method, view.params)
        view = _inside_trace(view, found)
        bounds = self._bounds_of(view, recording)
        pinned = view.against and self._findings(recording, frame, view.against.method, view.against.params)
        inspected = view.mode == "inspect" or view.layers.verdicts
        known = self._files.known(view.recording, recording) if inspected else None
        reference = Reference.of(view.reference, recording, known)
        said = reference.said.of(view.frame) if reference.said is not None else None
        judgement = self._judged(found, said) if inspected else None
        ghosts = self._ghosts(recording, frame, view.params) if _shows_ghosts(view, recording) else ()
        drawing = picture(view, recording, found, bounds, pinned, judgement, ghosts)
        world = self._world(recording) if view.space == "world" and view.mode != "learn" else None
        if world is not None:
            drawing = picture_in_world(view, drawing, world, around.lines, around.line_map, around.lasers)
            bounds = drawing.bounds
        label = self._library.label(view.recording)
        clock = self._clock(recording)
        since, nodes = clock.at(frame), drawing.nodes
        looked = self._looked_at(view)
        state = state_of(view, recording, label, found, bounds, reference, since, pinned, judgement, nodes, looked)
        if world is not None:
            state["world"] = around.told(view, world, frame)
        return Content(view, found, drawing, state, clock)

    def _looked_at(self, view: View) -> Looked | None:
        """At what the page of a lesson looks; None where nothing of that is shown."""
        if view.mode != "learn" or view.lesson is None or view.step is not None:
            return None
        recording, looked = self._library.lessons.looked_at(view.lesson, view.page) or ("", None)
        return looked if recording == view.recording else None

    def _bounds_of(self, view: View, recording: Recording) -> Bounds:
        """The bounds; those of a recording that grows only grow, and rarely, so that the grid stays still."""
        live = isinstance(recording, LiveRecording)
        if not (live or recording.partial):
            return self._bounds(recording)
        source, age, bounds = self._growing_bounds
        scans = recording.total if live else len(recording)
        if source != view.place or scans >= 2 * age or (live and scans >= age + 200):
            wider = bounds_of(recording)
            if source == view.place:
                wider = united(bounds, wider)
            self._growing_bounds = (view.place, scans, wider)
        return self._growing_bounds[2]


def _shows_ghosts(view: View, recording: Recording) -> bool:
    """Whether lines that the frame probably misses are drawn: where their sentences are read, and not while growing."""
    if isinstance(recording, LiveRecording) or recording.partial or view.step is not None:
        return False
    return view.mode == "inspect" and view.layers.ghosts


def _inside(view: View, recording: Recording) -> View:
    """The View with its frame and beam limited to the recording; of frames that were left out, the nearest one."""
    frame = recording.position(view.frame)
    beams = int(recording.offsets[frame + 1] - recording.offsets[frame])
    selected, beside = (each if each is not None and each < beams else None for each in (view.selected, view.beside))
    inside = replace(view, frame=recording.number(frame), selected=selected, beside=beside)
    return view if inside == view else inside


def _inside_trace(view: View, found: Findings) -> View:
    """The View with its step limited to the trace; a trace without decisions has no steps."""
    step = min(max(view.step, 0), len(found.trace) - 1) if view.step is not None and len(found.trace) else None
    return view if step == view.step else replace(view, step=step)
