"""Draws a Picture in viser: one server per session, with nodes updated in place."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray
from viser._messages import SceneNodeUpdateMessage

from lineseg import Knob, Params, Thresholds
from lineseg.poses import seen_from

from ..frame.geometry import Bounds
from .looks import CLOUDS, IN_THE_WORLD, LINES, ORDER
from .palette import linear
from .picture import Picture, Place
from .portless import Door, PortlessServer
from .shapes import Lines, Points

PLAN_FOV = math.radians(10)
NEAR, FAR = 0.5, 20_000.0
PICK_PIXELS = 20.0

# Higher nodes hide lower ones; seen from the plan camera, 20 mm of height makes no visible difference.
LEVEL = 0.02
HEIGHTS = {name: LEVEL * level for level, name in enumerate(ORDER)}

LASER = "/seen"

Change = Callable[[dict[str, Any]], None]
Pick = Callable[[tuple[float, float], float, bool], None]


class ViserScene:
    """Draws Pictures; clicks and viser's own sliders become changes of the View.

    change: called with a patch of the View. pick: called with the clicked point of the plane
    z = 0, a radius around it [m], and whether Shift was held.
    Both are called in viser's threads. loop: see PortlessServer. Starting blocks for a moment, so start it in a thread.
    """

    def __init__(self, change: Change, pick: Pick, loop: asyncio.AbstractEventLoop | None = None) -> None:
        self._server = PortlessServer(loop)
        self._metres_per_pixel = 0.02
        self._dark: bool | None = None
        self._bounds: Bounds | None = None
        # The last shapes of each node, and the names of those that are to be seen.
        self._shown = Picture({}, {}, (0.0, 0.0, 0.0, 0.0))
        self._visible = set[str]()
        nodes = self._server.scene
        # What the laser sees hangs on it.
        self._laser = nodes.add_frame(LASER, show_axes=False)
        self._place: Place | None = None
        no_points, no_lines = np.zeros((1, 3), np.float32), np.zeros((1, 2, 3), np.float32)
        self._clouds = {
            name: nodes.add_point_cloud(
                _path(name), no_points, no_points.astype(np.uint8),
                point_size=size * self._metres_per_pixel, point_shape=shape,
                precision="float32", point_shading="flat", position=(0.0, 0.0, HEIGHTS[name]), visible=False,
            )
            for name, (size, shape) in CLOUDS.items()
        }  # fmt: skip
        self._lines = {
            name: nodes.add_line_segments(
                _path(name), no_lines, no_lines.astype(np.uint8),
                thickness=width, thickness_units="screen", position=(0.0, 0.0, HEIGHTS[name]), visible=False,
            )
            for name, width in LINES.items()
        }  # fmt: skip
        # Never seen: tells the page how large a pixel was taken for.
        self._pixel = nodes.add_point_cloud(
            "/pixel", no_points, no_points.astype(np.uint8), point_size=self._metres_per_pixel, visible=False
        )
        nodes.world_axes.visible = False
        self._keep_shaders()
        self._change = change
        self._params: Thresholds | None = None
        self._sliders: dict[str, Any] = {}
        # Names of sliders that were moved in the scene.
        self._moved: set[str] = set()
        self._set_sliders(Params())
        self._listen_to_clicks(pick)
        self._server.on_client_connect(self._follow_camera)

    @property
    def door(self) -> Door:
        return self._server.door

    def draw(self, picture: Picture, params: Thresholds, dark: bool) -> None:
        """Pass the picture to viser; only changes are sent, within 16 ms or with `flush`."""
        with self._server.atomic():
            self._set_theme(dark)
            self._set_bounds(picture.bounds)
            self._set_place(picture.place)
            nodes = set(picture.nodes)
            for name, points in picture.points.items():
                if name in nodes:
                    _show_points(self._clouds[name], points, self._shown.points.get(name))
            for name, lines in picture.lines.items():
                if name in nodes:
                    _show_lines(self._lines[name], lines, self._shown.lines.get(name))
            for name in nodes ^ self._visible:
                (self._clouds.get(name) or self._lines[name]).visible = name in nodes
            self._visible = nodes
            self._shown = Picture(
                self._shown.points | picture.points, self._shown.lines | picture.lines, picture.bounds
            )
            self._set_sliders(params)

    def flush(self) -> None:
        """Send all changes now."""
        self._server.flush()

    def stop(self) -> None:
        self._server.stop()

    def _keep_shaders(self) -> None:
        """Two invisibly small point clouds that never change.

        viser makes a new material whenever the colours of a cloud change. When the last material with a shader goes,
        the shader goes too, and compiling it again stalls a browser for 10 to 300 ms. A cloud of one point has a
        different shader from larger ones, hence two.
        """
        for count in (1, 2):
            black = np.zeros((count, 3), dtype=np.uint8)
            self._server.scene.add_point_cloud(
                f"/shader_{count}", np.zeros((count, 3), np.float32), black, point_size=1e-9, precision="float32",
                point_shading="flat",
            )  # fmt: skip

    def _set_theme(self, dark: bool) -> None:
        if dark != self._dark:
            self._dark = dark
            self._server.gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)

    def _set_place(self, place: Place | None) -> None:
        """Move what the laser sees to where it is in the world; a laser that hangs upside down has it below itself."""
        if place == self._place:
            return
        upside_down = place is not None and place.upside_down
        if upside_down != (self._place is not None and self._place.upside_down):
            for name, handle in (*self._clouds.items(), *self._lines.items()):
                if name not in IN_THE_WORLD:
                    handle.position = (0.0, 0.0, -HEIGHTS[name] if upside_down else HEIGHTS[name])
        self._place = place
        x, y, heading = (place and place.pose) or (0.0, 0.0, 0.0)
        cos, sin = math.cos(heading / 2), math.sin(heading / 2)
        self._laser.position = (x, y, 0.0)
        self._laser.wxyz = (0.0, cos, sin, 0.0) if upside_down else (cos, 0.0, 0.0, sin)

    def _set_bounds(self, bounds: Bounds) -> None:
        """The initial camera of a view opened by itself: above the middle, high enough to see everything."""
        if bounds == self._bounds:
            return
        self._bounds = bounds
        x1, y1, x2, y2 = bounds
        middle = ((x1 + x2) / 2, (y1 + y2) / 2, 0.0)
        height = 1.1 * max(x2 - x1, y2 - y1, 1.0) / 2 / math.tan(PLAN_FOV / 2)
        camera = self._server.initial_camera
        camera.fov, camera.near, camera.far = PLAN_FOV, NEAR, FAR
        camera.up = (0.0, 1.0, 0.0)
        camera.look_at = middle
        camera.position = (middle[0], middle[1], height)

    def _set_sliders(self, params: Thresholds) -> None:
        """viser's own sliders, for a view opened by itself; the page hides them."""
        last, self._params = self._params, params
        if type(params) is not type(last):
            for widget in self._sliders.values():
                widget.remove()
            self._sliders = {name: self._slider(name, kind, knob, params) for name, kind, knob in params.knobs()}
            return
        moved, self._moved = self._moved, set()
        for name, _, knob in params.knobs():
            value = getattr(params, name)
            if value == getattr(last, name) and name not in moved:
                continue
            slider = self._sliders[name]
            if isinstance(slider, viser.GuiSliderHandle):
                reaching = knob.reaching(value, slider.min, slider.max)
                if (slider.min, slider.max) != (reaching.low, reaching.high):
                    slider.min, slider.max = type(value)(reaching.low), type(value)(reaching.high)
            if slider.value != value:
                slider.value = value

    def _slider(self, name: str, kind: type, knob: Knob, params: Thresholds) -> Any:
        """The slider of a threshold, or the checkbox of a switch."""
        label = f"{knob.symbol} [{knob.unit}]" if knob.unit else knob.symbol
        value = getattr(params, name)
        if kind is bool:
            widget = self._server.gui.add_checkbox(label, initial_value=value, hint=knob.help)
        else:
            reaching = knob.reaching(value)
            low, high, step = kind(reaching.low), kind(reaching.high), kind(knob.step)
            widget = self._server.gui.add_slider(
                label, min=low, max=high, step=step, initial_value=value, hint=knob.help
            )

        def moved(event: viser.GuiEvent) -> None:
            # Without a client, this is the echo of our own assignment.
            if event.client is not None:
                self._moved.add(name)
                self._change({"params": {name: event.target.value}})

        widget.on_update(moved)
        return widget

    def _listen_to_clicks(self, pick: Pick) -> None:
        def clicked(event: viser.SceneClickEvent) -> None:
            x, y, z = event.ray_origin
            dx, dy, dz = event.ray_direction
            if abs(dz) > 1e-9 and z / -dz > 0:
                at = (x - dx * z / dz, y - dy * z / dz)
                self._picked(at, event.modifier == "shift", pick)

        self._server.scene.on_click()(clicked)
        self._server.scene.on_click(modifier="shift")(clicked)

    def _picked(self, at: tuple[float, float], shift: bool, pick: Pick) -> None:
        """Tell which point of the laser's frame was clicked; nothing while the laser has no place in the world."""
        place = self._place
        if place is not None:
            if place.pose is None:
                return
            x, y = seen_from(np.array([at]), np.array(place.pose), place.upside_down)[0].tolist()
            at = (x, y)
        pick(at, PICK_PIXELS * self._metres_per_pixel, shift)

    def _follow_camera(self, client: viser.ClientHandle) -> None:
        """Keep the size of points on the screen at any zoom."""
        client.camera.on_update(self._size_points)
        # The page may have moved it before this was heard.
        self._size_points(client.camera)

    def _size_points(self, camera: viser.CameraHandle) -> None:
        distance = float(np.linalg.norm(camera.position - camera.look_at))
        metres = 2 * distance * math.tan(camera.fov / 2) / max(camera.image_height, 1)
        # In steps of 12 %, to avoid a message for every frame of a zoom.
        rounded = math.exp(round(math.log(max(metres, 1e-5)) / 0.12) * 0.12)
        if rounded == self._metres_per_pixel:
            return
        self._metres_per_pixel = rounded
        with self._server.atomic():
            self._pixel.point_size = rounded
            for name, handle in self._clouds.items():
                handle.point_size = CLOUDS[name][0] * rounded


def _path(name: str) -> str:
    return ("/" if name in IN_THE_WORLD else f"{LASER}/") + name.replace(" ", "_")


def _show_points(handle: viser.PointCloudHandle, points: Points, last: Points | None) -> None:
    """last: what the handle has."""
    if points is not last:
        arrays = {}
        if last is None or not _same(points.xyz, last.xyz):
            arrays["points"] = points.xyz
        if last is None or not _same(points.colours, last.colours):
            arrays["colors"] = points.colours
        _assign(handle, arrays)


def _show_lines(handle: viser.LineSegmentsHandle, lines: Lines, last: Lines | None) -> None:
    """last: what the handle has."""
    if lines is not last:
        arrays = {}
        if last is None or not _same(lines.xyz, last.xyz):
            arrays["points"] = lines.xyz
        if last is None or not _same(lines.colours, last.colours):
            arrays["colors"] = np.repeat(linear(lines.colours)[:, None, :], 2, axis=1)
        _assign(handle, arrays)


def _same(one: NDArray, other: NDArray) -> bool:
    return one is other or (one.shape == other.shape and one.tobytes() == other.tobytes())


def _assign(handle: viser.SceneNodeHandle, arrays: dict[str, NDArray]) -> None:
    """Assign arrays of viser's types that nobody changes; viser's own assignment takes ten times as long.

    It casts, compares and copies each array three times, and sends each by itself.
    """
    if arrays:
        vars(handle._impl.props).update(arrays)
        handle._impl.api._queue_scene_message(SceneNodeUpdateMessage(handle.name, arrays))
