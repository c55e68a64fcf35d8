"""A running node is found by the page's server, and takes thresholds from it and from nobody else."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import pytest
from lineseg_app.node.door import open_door
from lineseg_app.node.offers import FOLDER, PATH, TOKEN, Offer
from lineseg_app.node.running import Running
from lineseg_app.server import Settings
from live import Address, serving
from waiting import SECONDS

from lineseg import EXTRACTORS, Params


@dataclass
class Here:
    """A server, and a node whose door is open."""

    server: Address
    running: Running
    told: list[str]
    prepared: list[str]
    offer: Offer

    def send(self, **asked: Any) -> httpx.Response:
        return self.server.post("/api/robot/node", json={"address": self.offer.address} | asked)


def offer_in(folder: Path) -> Offer:
    return Offer.model_validate_json(next((folder / FOLDER).glob("*.json")).read_text())


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def here(folder: Path) -> Iterator[Here]:
    running, told, prepared = Running("region-growing", Params()), [], []
    door = open_door("ros2:/scan", running, lambda method, params: prepared.append(method), told.append, folder)
    with serving(Settings(data_folder=folder)) as server, door:
        yield Here(server, running, told, prepared, offer_in(folder))


def test_a_running_node_is_offered_and_its_token_is_kept(here: Here):
    answer = here.server.get("/api/robot")
    assert answer.json() == {"addresses": [], "nodes": [{"address": here.offer.address, "source": "ros2:/scan"}]}
    assert here.offer.token not in answer.text


def test_the_node_runs_what_was_sent(here: Here):
    hough = EXTRACTORS["hough"].params_type(min_points=17)
    answer = here.send(method="hough", params=hough.numbers())
    assert answer.json() == {"source": "ros2:/scan", "method": "hough", "params": hough.numbers()}
    assert here.running.newest() == ("hough", hough)
    assert here.prepared[-1] == "hough"
    assert here.told[-1].startswith("sent from the page: hough, epsilon 0.03, ")


@pytest.mark.parametrize(
    ("asked", "status", "words"),
    [
        ({"params": {"epsilon": -1}}, 400, "epsilon is -1"),
        ({"params": {"self": 1}}, 400, "there is no threshold 'self'"),
        ({"method": "magic", "params": {}}, 400, "there is no method 'magic'; choose from region-growing"),
        ({"address": "http://127.0.0.1:1", "params": {}}, 404, "no node runs at http://127.0.0.1:1"),
    ],
)
def test_what_cannot_be_sent_is_told_and_changes_nothing(here: Here, asked: dict, status: int, words: str):
    before = here.running.now
    answer = here.send(**asked)
    assert (answer.status_code, here.running.now) == (status, before)
    assert words in answer.json()["message"]


@pytest.mark.parametrize(
    "headers",
    [{}, {"Authorization": "Bearer wrong"}, {"Origin": "http://127.0.0.1:8765"}, {"Host": "evil.example"}],
)
def test_nobody_else_gets_in(here: Here, headers: dict[str, str]):
    known = {} if "Authorization" in headers or not headers else {"Authorization": f"Bearer {here.offer.token}"}
    for answer in (
        httpx.get(here.offer.address + PATH, headers=known | headers, timeout=SECONDS),
        httpx.put(
            here.offer.address + PATH, headers=known | headers, json={"method": "hough", "params": {}}, timeout=SECONDS
        ),
    ):
        assert answer.status_code == 403
        assert answer.json()["message"]


def test_a_malformed_message_gets_a_sentence(here: Here):
    known = {"Authorization": f"Bearer {here.offer.token}"}
    for body in (b"", b"{", b'{"method": 1}', b'{"method": "hough", "params": {"epsilon": "wide"}}'):
        answer = httpx.put(here.offer.address + PATH, headers=known, content=body, timeout=SECONDS)
        assert (answer.status_code, "this is no message to a node" in answer.text) == (400, True)


def test_a_killed_node_is_forgotten_and_one_of_another_machine_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, here: Here
):
    left = tmp_path / FOLDER / "left.json"
    left.parent.mkdir()
    left.write_text(json.dumps({"address": "http://127.0.0.1:1", "token": "x", "source": "ros2:/scan"}))
    begun, half = left.with_name("begun.json"), left.with_name("half.json")
    begun.touch()
    half.write_text("{")
    os.utime(half, (0, 0))
    monkeypatch.setenv(TOKEN, "wrong")
    with serving(Settings(data_folder=tmp_path, may_send=(here.offer.address,))) as server:
        assert server.get("/api/robot").json() == {
            "addresses": [],
            "nodes": [{"address": here.offer.address, "source": ""}],
        }
        assert list(left.parent.iterdir()) == [begun]
        asked = {"address": here.offer.address, "params": {}}
        assert TOKEN in server.post("/api/robot/node", json=asked).json()["message"]
        monkeypatch.setenv(TOKEN, here.offer.token)
        assert server.post("/api/robot/node", json=asked).json()["method"] == "region-growing"


def test_the_announcement_goes_with_the_node(tmp_path: Path):
    running, told = Running("region-growing", Params()), []
    with open_door("zenoh:/scan", running, lambda method, params: None, told.append, tmp_path):
        file = next((tmp_path / FOLDER).iterdir())
        assert file.stat().st_mode & 0o777 == 0o600
    assert not file.exists()
