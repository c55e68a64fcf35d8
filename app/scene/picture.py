"""View → Picture: everything that is drawn, as arrays. A pure function: the same View gives the same Picture."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording, Scan, Segment, Survey, difference
from lineseg.survey.difference import KEPT
from lineseg.survey.remark import Ghost

from ..frame.findings import Findings
from ..frame.geometry import Bounds, square_of, voids
from ..frame.judge import Judged
from ..view import View
from .beside import OtherLaser, bounds_around, scans_beside
from .palette import DARK, LIGHT, Colours, Theme
from .replay import State, decision_geometry, foot_between, state_at
from .shapes import Lines, Points, dashed, joined, lines_between, points_at
from .world import Pose, World

if TYPE_CHECKING:
    from lineseg.line_map import LineMap

DASH = 0.10
FALSE_DASH = 0.08
MISSED_DASH = 0.20
GHOST_DASH = 0.25
NORMAL = 0.3
FAR = 100.0
# Bounds and themes whose grid is kept.
CACHED = 64


@dataclass(frozen=True, eq=False)
class Picture:
    """Shapes by node name; missing nodes are hidden. bounds: x₁, y₁, x₂, y₂ of the recording [m].

    place: of the laser in the world; None if all is drawn in its own frame.
    """

    points: dict[str, Points]
    lines: dict[str, Lines]
    bounds: Bounds
    place: Place | None = None

    @property
    def nodes(self) -> list[str]:
        """The names of all that is to be seen."""
        return [name for name, shape in (*self.points.items(), *self.lines.items()) if len(shape.xyz)]


class Place(NamedTuple):
    """Where the laser is in the world, None if unknown; upside_down: whether its beams turn clockwise from above."""

    pose: Pose | None
    upside_down: bool


def picture_in_world(
    view: View,
    drawn: Picture,
    world: World,
    survey: Survey | None,
    line_map: LineMap | None = None,
    lasers: Sequence[OtherLaser] = (),
) -> Picture:
    """A picture of a frame in the world; without a pose, the frame is left out.

    survey, line_map: of all frames, if known; lasers: the others of the robot.
    """
    theme, layers = DARK if view.dark else LIGHT, view.layers
    bounds = bounds_around(world, lasers)
    frame = world.recording.position(view.frame)
    pose = world.pose(frame)
    points, lines = (drawn.points, drawn.lines) if pose is not None else ({}, {})
    points, lines = dict(points), {name: shape for name, shape in lines.items() if name != "grid"}
    if has_grid(view):
        lines["grid"] = grid(bounds, theme)
    if layers.trajectory:
        lines["trajectory"] = world.trajectory(theme)
    if layers.all_lines and survey is not None:
        lines["all lines"] = world.all_lines(survey, theme)
    if layers.line_map and line_map is not None:
        lines["line map"] = world.line_map(line_map, theme)
    if layers.past and view.past != "none":
        points["past"] = world.all_seen(theme) if view.past == "all" else world.last_seen(frame, int(view.past), theme)
    if layers.other_lasers and lasers:
        points["other lasers"] = scans_beside(lasers, float(world.recording.stamps[frame]), theme)
    if layers.laser and pose is not None:
        lines["laser"] = laser(bounds, theme)
    return Picture(points, lines, bounds, Place(pose, world.upside_down))


def picture(
    view: View,
    recording: Recording,
    found: Findings,
    bounds: Bounds,
    pinned: Findings | None = None,
    judged: Judged | None = None,
    ghosts: Sequence[Ghost] = (),
    theme: Theme | None = None,
) -> Picture:
    """The picture of a View, whose frame and step must be within the recording and the trace.

    pinned: the result of `view.against` in this frame; judged: its comparison with the truth;
    ghosts: lines that the frame probably misses. theme: if not that of the View.
    """
    theme = theme or (DARK if view.dark else LIGHT)
    state = state_at(found, view.step)
    points = _points(view, found, state, theme)
    lines = _lines(view, recording, found, state, bounds, theme)
    if pinned is not None:
        lines["pinned"] = pinned_lines(pinned, found, theme)
    if judged is not None and view.layers.verdicts and view.step is None:
        lines = {name: drawn for name, drawn in lines.items() if name != "segments"} | verdicts(found, judged, theme)
    if ghosts:
        ends = np.array(ghosts).reshape(-1, 2, 2)
        lines["ghosts"] = dashed(ends[:, 0], ends[:, 1], GHOST_DASH, theme.ghost)
    if view.step is not None and view.layers.replay:
        of_decision = decision_geometry(found, view.step, theme)
        points |= of_decision[0]
        lines |= of_decision[1]
    if view.selected is not None:
        chosen = [view.selected] if view.beside is None else [view.selected, view.beside]
        points["selected"], lines["selected ray"] = selected(found.scan, chosen, theme)
    return Picture(points, lines, bounds)


def _points(view: View, found: Findings, state: State, theme: Theme) -> dict[str, Points]:
    layers, points = view.layers, {}
    if layers.points:
        points["points"] = scan_points(found.scan, state, theme)
    if layers.endpoints:
        points["endpoints"] = points_at(np.concatenate((state.starts, state.ends)), np.tile(state.colours, (2, 1)))
    if layers.seeds:
        points["seeds"] = seed_points(found, state, theme)
    return points


def _lines(
    view: View, recording: Recording, found: Findings, state: State, bounds: Bounds, theme: Theme
) -> dict[str, Lines]:
    layers, lines = view.layers, {}
    if has_grid(view):
        lines["grid"] = grid(bounds, theme)
    if layers.laser:
        lines["laser"] = laser(bounds, theme)
    if layers.truth:
        lines["truth"] = truth(recording, recording.position(view.frame), theme)
    if layers.invalid:
        lines["invalid"] = invalid_beams(found.scan, bounds, theme)
    if layers.segments:
        lines["segments"] = segments(found.scan, state)
    if layers.dropped:
        lines["dropped"] = dropped_lines(found.drop_ends[: state.drops], theme)
    if layers.normals and view.step is None:
        lines["normals"] = normals(found.extraction.segments, state.colours)
    return lines


def scan_points(scan: Scan, state: State, theme: Theme) -> Points:
    """Every valid point in the colour of its line, or grey."""
    if scan not in _RETURNS:
        kept = np.flatnonzero(scan.valid & np.isfinite(scan.xy).all(axis=1))
        _RETURNS[scan] = kept, points_at(scan.xy[kept], theme.point).xyz
    beams, xyz = _RETURNS[scan]
    colours = np.concatenate((state.colours, np.array([theme.point], dtype=np.uint8)))
    return Points(xyz, colours[state.labels[beams]])


# The beams with a point, and these points: while a slider moves, the scan stays the same.
_RETURNS: WeakKeyDictionary[Scan, tuple[NDArray[np.intp], NDArray[np.float32]]] = WeakKeyDictionary()


def seed_points(found: Findings, state: State, theme: Theme) -> Points:
    """The seeds of the lines shown."""
    windows = [found.seeds[candidate] for candidate in state.candidates if candidate in found.seeds]
    beams, _ = found.trace.beams_of(*np.array(windows, int).reshape(-1, 2).T)
    return points_at(found.scan.xy[beams], theme.strong)


def segments(scan: Scan, state: State) -> Lines:
    """The lines, dashed across voids."""
    every = np.arange(len(state.starts))
    beams, at = voids(scan, state.labels)
    if not len(at):
        return lines_between(state.starts, state.ends, state.colours)
    cuts = foot_between(scan.xy[beams], state.starts[at][:, None], state.ends[at][:, None])
    # A line begins at its start and after each void, and ends before each void and at its end.
    begins, ends = np.concatenate((every, at)), np.concatenate((at, every))
    starts = np.concatenate((state.starts, cuts[:, 1]))[np.argsort(begins, kind="stable")]
    stops = np.concatenate((cuts[:, 0], state.ends))[np.argsort(ends, kind="stable")]
    solid = lines_between(starts, stops, state.colours[np.sort(begins)])
    return joined(solid, dashed(cuts[:, 0], cuts[:, 1], DASH, state.colours[at]))


def dropped_lines(ends: NDArray, theme: Theme) -> Lines:
    """Dropped candidates, dashed between their outermost points (lines, 2, 2)."""
    return dashed(ends[:, 0], ends[:, 1], DASH, theme.faint)


def pinned_lines(pinned: Findings, found: Findings, theme: Theme) -> Lines:
    """The segments of A as broad bands; those that changed are highlighted."""
    fates = difference(pinned.extraction, found.extraction).fates_a
    colours = np.where((fates == KEPT)[:, None], theme.pinned, theme.changed).astype(np.uint8)
    segments = pinned.extraction.segments
    starts, ends = (np.array([getattr(s, name) for s in segments]).reshape(-1, 2) for name in ("start", "end"))
    return lines_between(starts, ends, colours)


def verdicts(found: Findings, judged: Judged, theme: Theme) -> dict[str, Lines]:
    """Matched segments solid, false ones broad and dotted, missed true lines dashed, so that no colour is needed.

    A segment on a wall just short of P_min or L_min is neither right nor false, and is thin and grey.
    """
    segments = found.extraction.segments
    starts, ends = (np.array([getattr(s, name) for s in segments]).reshape(-1, 2) for name in ("start", "end"))
    matched, missed = judged.matching.line_of >= 0, judged.matching.segment_of < 0
    false = ~matched & ~judged.matching.neutral
    neither = ~matched & ~false
    return {
        "neither": lines_between(starts[neither], ends[neither], theme.point),
        "matched": lines_between(starts[matched], ends[matched], theme.matched),
        "false": dashed(starts[false], ends[false], FALSE_DASH, theme.false),
        "missed": dashed(judged.ends[missed, 0], judged.ends[missed, 1], MISSED_DASH, theme.missed),
    }


def normals(segments: Sequence[Segment], colours: Colours) -> Lines:
    """A shortened unit normal at the middle of each segment."""
    middles = np.array([np.add(s.start, s.end) / 2 for s in segments]).reshape(-1, 2)
    along = np.array([s.line[:2] for s in segments]).reshape(-1, 2)
    return lines_between(middles, middles + NORMAL * along, colours)


def invalid_beams(scan: Scan, bounds: Bounds, theme: Theme) -> Lines:
    """A tick around the middle of the picture in the direction of each beam without a return."""
    bearings = scan.bearings[~scan.valid]
    toward = np.column_stack((np.cos(bearings), np.sin(bearings)))
    radius = min(max(map(abs, bounds)), scan.range_max if math.isfinite(scan.range_max) else math.inf)
    return lines_between(0.96 * radius * toward, radius * toward, theme.invalid)


def selected(scan: Scan, beams: Sequence[int], theme: Theme) -> tuple[Points, Lines]:
    """The explained beams, from the laser to their points, or far out if they have no return."""
    points, bearings = scan.xy[beams], scan.bearings[beams]
    far = FAR * np.column_stack((np.cos(bearings), np.sin(bearings)))
    ends = np.where(scan.valid[beams][:, None], points, far)
    return points_at(points, theme.candidate), lines_between(np.zeros_like(ends), ends, theme.candidate)


def truth(recording: Recording, frame: int, theme: Theme) -> Lines:
    """The true walls as seen from the laser; none if unknown."""
    if recording.walls is None or recording.poses is None:
        return lines_between(np.empty((0, 2)), np.empty((0, 2)), theme.truth)
    x, y, heading = recording.poses[frame]
    cos, sin = math.cos(heading), math.sin(heading)
    ends = (recording.walls.reshape(-1, 2, 2) - (x, y)) @ np.array([[cos, -sin], [sin, cos]])
    return lines_between(ends[:, 0], ends[:, 1], theme.truth)


@lru_cache(maxsize=CACHED)
def laser(bounds: Bounds, theme: Theme) -> Lines:
    """The laser as an arrowhead along its x axis."""
    size = 0.012 * max(bounds[2] - bounds[0], bounds[3] - bounds[1])
    tip, left, notch, right = size * np.array([(1.4, 0.0), (-0.9, 0.8), (-0.4, 0.0), (-0.9, -0.8)])
    return lines_between([tip, left, notch, right], [left, notch, right, tip], theme.laser)


def has_grid(view: View) -> bool:
    """Whether the picture has a grid; that of the plan is drawn by the page at any zoom (static/stage/grid.js)."""
    return view.layers.grid and view.camera == "free"


@lru_cache(maxsize=CACHED)
def grid(bounds: Bounds, theme: Theme) -> Lines:
    """Grid lines `square_of` apart, with highlighted axes, also beyond the recording, since a stage may be wide."""
    spacing = square_of(bounds)
    beyond = max(bounds[2] - bounds[0], bounds[3] - bounds[1])
    x1, y1 = (spacing * math.floor((low - beyond) / spacing) for low in bounds[:2])
    x2, y2 = (spacing * math.ceil((high + beyond) / spacing) for high in bounds[2:])
    xs, ys = np.arange(x1, x2 + spacing / 2, spacing), np.arange(y1, y2 + spacing / 2, spacing)
    upright = _parallels(xs, lambda x: ((x, y1), (x, y2)), theme)
    level = _parallels(ys, lambda y: ((x1, y), (x2, y)), theme)
    return joined(upright, level)


def _parallels(places: NDArray, ends_at: Callable[[float], tuple], theme: Theme) -> Lines:
    colours = np.where(np.abs(places)[:, None] < 1e-9, theme.axis, theme.grid).astype(np.uint8)
    ends = np.array([ends_at(float(place)) for place in places])
    return lines_between(ends[:, 0], ends[:, 1], colours)
