"""The viser side of a tab: its page, its relayed socket, its sliders and clicks."""

from __future__ import annotations

import threading

import msgspec
import numpy as np
import pytest
import zstandard
from lineseg_app.frame.findings import findings
from lineseg_app.frame.geometry import bounds_of
from lineseg_app.scene.palette import linear
from lineseg_app.scene.picture import picture
from lineseg_app.scene.viser_scene import ViserScene
from lineseg_app.view import View
from live import Address, Page, connect, page_of
from scenes import wall_ahead
from viser._messages import Message, ScenePointerMessage, ShareUrlRequest, ViewerCameraMessage
from waiting import SECONDS
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection

from lineseg import Params, Recording


def window_of(data: bytes) -> list[dict]:
    """The messages of one window of viser's wire format."""
    compressed = int.from_bytes(data[8:16], "little")
    return msgspec.msgpack.decode(zstandard.ZstdDecompressor().decompress(data[16 : 16 + compressed]))["messages"]


def hear(socket: ClientConnection, type: str, **fields) -> dict:
    while True:
        data = socket.recv(timeout=SECONDS)
        assert isinstance(data, bytes)
        for message in window_of(data):
            if message["type"] == type and all(message.get(name) == value for name, value in fields.items()):
                return message


def say(socket: ClientConnection, message: Message) -> None:
    socket.send(msgspec.msgpack.encode(message.as_serializable_dict()))


def scene_of(server: Address, page: Page):
    path = page.welcome["viser"].rstrip("/")
    return connect(server.ws + path, subprotocols=["viser-v1.1.1"])  # pyright: ignore


def camera(height: float = 100.0) -> ViewerCameraMessage:
    return ViewerCameraMessage(
        wxyz=(0.0, 1.0, 0.0, 0.0), position=(0.0, 0.0, height), fov=0.17, near=0.5, far=1000.0,
        image_height=800, image_width=1200, look_at=(0.0, 0.0, 0.0), up_direction=(0.0, 1.0, 0.0),
    )  # fmt: skip


def test_the_scene_is_relayed_with_its_subprotocol(server: Address, page: Page):
    page.hello()
    with scene_of(server, page) as socket:
        assert socket.subprotocol == "viser-v1.1.1"
        assert hear(socket, "PointCloudMessage", name="/seen/points")


def test_changes_reach_the_scene(server: Address, page: Page):
    page.hello()
    with scene_of(server, page) as socket:
        hear(socket, "ReplayDoneMessage")
        page.change(frame=2)
        assert "points" in hear(socket, "SceneNodeUpdateMessage", name="/seen/points")["updates"]


def test_unchanged_things_are_not_sent_again(server: Address, page: Page):
    page.hello()
    with scene_of(server, page) as socket:
        hear(socket, "ReplayDoneMessage")
        page.change(selected=20)
        data = socket.recv(timeout=SECONDS)
        assert isinstance(data, bytes)
        names = {message.get("name") for message in window_of(data)}
        assert names <= {"/seen/selected", "/seen/selected_ray"}


def test_a_click_in_the_scene_selects_the_nearest_beam(server: Address, page: Page):
    page.hello()
    with scene_of(server, page) as socket:
        say(socket, camera())
        hear(socket, "ReplayDoneMessage")
        hear(socket, "SceneNodeUpdateMessage", name="/seen/points")
        point = wall_ahead(4.0, 10.0).xy[30]
        say(socket, click(point + 0.001))
        drawn = page.hear_a("drawn")
        assert (drawn["origin"], drawn["state"]["selected"], drawn["rev"]) == ("scene", 30, 0)
        say(socket, click(point + 50))
        assert page.hear_a("drawn")["state"]["selected"] is None


def click(xy: np.ndarray) -> ScenePointerMessage:
    return ScenePointerMessage(
        event_type="click", ray_origin=(float(xy[0]), float(xy[1]), 100.0), ray_direction=(0.0, 0.0, -1.0),
        screen_pos=((0.5, 0.5),), modifier=None,
    )  # fmt: skip


def test_the_socket_of_a_closed_scene_is_refused(server: Address):
    with pytest.raises(InvalidStatus), connect(f"{server.ws}/s/nobody/viser"):
        pass
    assert server.get("/s/nobody/viser/").status_code == 404


def test_the_end_of_a_session_ends_its_scene(server: Address):
    with page_of(server) as page:
        page.hello()
        with scene_of(server, page) as socket:
            hear(socket, "ReplayDoneMessage")
            page.say(type="close")
            with pytest.raises(ConnectionClosed):
                while True:
                    socket.recv(timeout=SECONDS)


def test_the_scenes_page_is_cached_by_its_etag(server: Address, page: Page):
    page.hello()
    first = server.get(page.welcome["viser"])
    assert first.headers["content-encoding"] == "gzip"
    assert "Viser" in first.text
    assert server.get(page.welcome["viser"], headers={"If-None-Match": first.headers["etag"]}).status_code == 304


def test_no_share_tunnel_can_be_asked_for(server: Address, page: Page):
    page.hello()
    with scene_of(server, page) as socket:
        hear(socket, "ReplayDoneMessage")
        say(socket, ShareUrlRequest())
        page.change(frame=1)
        hear(socket, "SceneNodeUpdateMessage", name="/seen/points")
    assert not [thread for thread in threading.enumerate() if "tunnel" in thread.name.lower()]


@pytest.fixture
def scene():
    changes: list[dict] = []
    scene = ViserScene(changes.append, lambda point, radius: None)
    yield scene, changes
    scene.stop()


def test_drawing_moves_the_sliders_and_moving_them_back_is_no_change(scene, capsys):
    drawn, changes = scene
    recording = Recording.from_scans([wall_ahead()])
    view = View(params=Params(epsilon=0.05, min_points=500))
    found = findings(recording, 0, view.method, view.params)
    drawn.draw(picture(view, recording, found, bounds_of(recording)), view.params, view.dark)
    assert drawn._sliders["epsilon"].value == 0.05
    assert drawn._sliders["min_points"].value == 500
    further = view.params.but(epsilon=0.9)
    drawn.draw(picture(view, recording, found, bounds_of(recording)), further, view.dark)
    assert (drawn._sliders["epsilon"].value, drawn._sliders["epsilon"].max) == (0.9, 1.0)
    assert changes == []
    assert capsys.readouterr().out == ""


def test_after_many_pictures_a_scene_has_what_the_last_one_shows(scene):
    drawn, _ = scene
    recording = Recording.from_scans([wall_ahead(), wall_ahead(distance=3.0)])
    for frame, epsilon, layers in (
        (0, 0.03, {}),
        (1, 0.03, {}),
        (1, 0.001, {"seeds": False}),
        (0, 0.02, {"laser": False}),
    ):
        view = View(frame=frame, params=Params(epsilon=epsilon), dark=frame == 0).patched({"layers": layers})
        shown = picture(view, recording, findings(recording, frame, view.method, view.params), bounds_of(recording))
        drawn.draw(shown, view.params, view.dark)
        for name, handle in drawn._clouds.items():
            each = shown.points.get(name)
            assert handle.visible == (each is not None and len(each.xyz) > 0)
            if each is not None and len(each.xyz):
                np.testing.assert_array_equal(handle.points, each.xyz, strict=True)
                np.testing.assert_array_equal(handle.colors, each.colours, strict=True)
        for name, handle in drawn._lines.items():
            each = shown.lines.get(name)
            assert handle.visible == (each is not None and len(each.xyz) > 0)
            if each is not None and len(each.xyz):
                np.testing.assert_array_equal(handle.points, each.xyz, strict=True)
                colours = np.repeat(linear(each.colours)[:, None], 2, axis=1)
                np.testing.assert_array_equal(handle.colors, colours, strict=True)


def test_a_slider_that_was_moved_in_vain_goes_back_with_the_next_picture(scene):
    drawn, _ = scene
    recording = Recording.from_scans([wall_ahead()])
    view = View()
    shown = picture(view, recording, findings(recording, 0, view.method, view.params), bounds_of(recording))
    drawn.draw(shown, view.params, view.dark)
    slider = drawn._sliders["epsilon"]
    slider.value = 0.07
    drawn._moved.add("epsilon")
    drawn.draw(shown, view.params, view.dark)
    assert slider.value == view.params.epsilon
