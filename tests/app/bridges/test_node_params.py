"""Thresholds sent to a node over rosbridge, and read back."""

from __future__ import annotations

import socketserver
import threading
from collections.abc import Iterator

import pytest
from lineseg_app.bridges import node_params, websocket
from lineseg_app.server import Settings
from live import Address, serving
from rosbridge_peer import RosBridgePeer
from waiting import SECONDS

from lineseg import Params

NAMES = [knob.ros for _, _, knob in Params.knobs() if knob.ros]
NODE = {"least_thresh": 0.04, "predict_distance": 0.1, "seed_line_points": 6, "min_line_points": 12}


class Refusing(socketserver.BaseRequestHandler):
    """Speaks HTTP, but offers no WebSocket."""

    def handle(self) -> None:
        self.request.recv(4096)
        self.request.sendall(b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\n\r\n")


@pytest.fixture(scope="module")
def bridge() -> Iterator[RosBridgePeer]:
    peer = RosBridgePeer()
    yield peer
    peer.close()


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is sent is the same."""
    monkeypatch.setattr(websocket, "OPEN_SECONDS", SECONDS)
    monkeypatch.setattr(node_params, "ALL_SECONDS", SECONDS)


@pytest.fixture
def peer(bridge: RosBridgePeer) -> RosBridgePeer:
    bridge.nodes = {"/line_extraction": NODE | {"min_line_length": 0.5}}
    return bridge


@pytest.fixture(scope="module")
def server(bridge: RosBridgePeer, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Address]:
    """A server that may send to the bridge, to a port where nothing listens, and to one that is no rosbridge."""
    with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Refusing) as other:
        threading.Thread(target=other.serve_forever).start()
        may_send = (bridge.url, "ws://127.0.0.1:1", f"ws://127.0.0.1:{other.server_address[1]}")
        with serving(Settings(may_send=may_send, data_folder=tmp_path_factory.mktemp("data"))) as address:
            yield address
        other.shutdown()


def sent(server: Address, peer: RosBridgePeer, **asked) -> list[dict]:
    values = {"address": peer.url, "node": "/line_extraction", "params": {"epsilon": 0.02, "seed_points": 7}} | asked
    answer = server.post("/api/robot/params", json=values)
    assert answer.status_code == 200, answer.text
    return answer.json()["sent"]


def test_the_node_has_the_thresholds_afterwards(server: Address, peer: RosBridgePeer):
    rows = sent(server, peer)
    assert [row["name"] for row in rows] == NAMES
    assert all(row["taken"] and row["now"] == row["value"] and not row["reason"] for row in rows)
    assert peer.nodes["/line_extraction"]["least_thresh"] == 0.02
    assert peer.nodes["/line_extraction"]["seed_line_points"] == 7


def test_a_refusal_of_the_node_is_shown_in_its_words_with_its_values(server: Address, peer: RosBridgePeer):
    peer.nodes["/line_extraction"]["seed_line_points"] = 6.0
    rows = {row["threshold"]: row for row in sent(server, peer, extensions=True)}
    assert rows["epsilon"]["taken"]
    wrong, undeclared = rows["seed_points"], rows["max_gap"]
    assert (wrong["taken"], wrong["value"], wrong["now"]) == (False, 7, 6.0)
    assert wrong["reason"] == "Wrong parameter type, parameter {seed_line_points} is of type {double}"
    assert (undeclared["taken"], undeclared["now"]) == (False, None)
    assert undeclared["reason"] == "parameter 'max_gap' cannot be set because it was not declared"


def test_a_robot_of_ros_1_has_them_on_its_parameter_server(server: Address, peer: RosBridgePeer):
    rows = sent(server, peer, ros=1)
    assert all(row["taken"] for row in rows)
    assert peer.store["/line_extraction/least_thresh"] == "0.02"
    assert peer.store["/line_extraction/seed_line_points"] == "7"


@pytest.mark.parametrize(
    ("asked", "status", "sentence"),
    [
        ({"node": "/nobody"}, 400, "says: Service /nobody/set_parameters does not exist"),
        ({"address": "http://robot:9090"}, 400, "not the address of a robot; give one like ws://robot:9090"),
        ({"address": "ws://127.0.0.1:1"}, 502, "nothing listens at 127.0.0.1:1"),
        ({"address": "ws://" + 300 * "r"}, 422, "address: string should have at most 300 characters"),
        ({"turbo": True}, 422, "turbo: extra inputs are not permitted"),
        ({"node": "../etc"}, 400, "give an absolute ROS name such as /line_extraction"),
        ({"params": {"epsilon": -1}}, 400, "epsilon is -1"),
        ({"params": {"gamma": 1}}, 400, "there is no threshold 'gamma'"),
    ],
)
def test_a_send_that_fails_says_why(server: Address, peer: RosBridgePeer, asked: dict, status: int, sentence: str):
    values = {"address": peer.url, "node": "/line_extraction", "params": {}} | asked
    answer = server.post("/api/robot/params", json=values)
    assert answer.status_code == status
    assert sentence in answer.json()["message"]


def test_a_peer_that_does_not_speak_rosbridge_is_named(server: Address):
    address = server.get("/api/robot").json()["addresses"][2]
    values = {"address": address, "node": "/line_extraction", "params": {}}
    answer = server.post("/api/robot/params", json=values)
    assert answer.status_code == 502
    assert "does not offer a usable WebSocket" in answer.json()["message"]


@pytest.mark.parametrize(
    "address", ["ws://169.254.169.254", "ws://127.0.0.1:22", "ws://127.0.0.1:1/other", "wss://127.0.0.1:1"]
)
def test_only_robots_that_the_user_named_are_reached(server: Address, address: str):
    values = {"address": address, "node": "/line_extraction", "params": {}}
    answer = server.post("/api/robot/params", json=values)
    assert answer.status_code == 403
    assert f"start it with --robot {address}" in answer.json()["message"]


def test_a_named_robot_may_be_written_in_another_way(server: Address, bridge: RosBridgePeer):
    assert server.get("/api/robot").json()["addresses"][0] == bridge.url
    values = {"address": bridge.url.upper().replace("WS", "Ws") + "/", "node": "/nobody", "params": {}}
    assert "/nobody/set_parameters does not exist" in server.post("/api/robot/params", json=values).json()["message"]
