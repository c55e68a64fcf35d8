"""Scans pushed by any program, by POST or over a WebSocket: bounded, and guarded like everything else."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from lineseg_app.live.hub import MOST_PUSHED
from lineseg_app.routes.push import LARGEST, MOST_A_SECOND, Pace, TooFastError
from lineseg_app.server import Settings
from live import Address, connect, page_of, serving
from robots import nearest, wall
from rosbridge_peer import scan_message
from rrd import rows_of
from waiting import SECONDS, eventually
from websockets.exceptions import ConnectionClosed, InvalidStatus


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Address]:
    with serving(Settings(data_folder=tmp_path, keep=3)) as address:
        yield address


def test_posted_scans_become_a_live_recording(server: Address):
    with page_of(server) as page:
        page.hello()
        answer = server.post("/api/scans/simulator", json=scan_message(wall(3.0)))
        assert answer.json() == {"recording": "live:simulator", "kept": 1, "dropped": 0}
        entries = page.hear_a("recordings")["recordings"]
        assert {
            "id": "live:simulator",
            "label": "simulator",
            "group": "Live",
            "missing": False,
            "reading": {},
        } in entries
        assert nearest(page.change(recording="live:simulator")) == pytest.approx(3.0, abs=1e-3)
        for distance in (2.5, 2.0, 1.5):
            answer = server.post("/api/scans/simulator", json=scan_message(wall(distance)))
        assert answer.json() == {"recording": "live:simulator", "kept": 3, "dropped": 1}
        last = page.heard("drawn", lambda m: m["state"]["first"] == 1)["state"]
        assert (last["live"], last["frame"], nearest(last)) == (True, 3, pytest.approx(1.5, abs=1e-3))


def test_a_socket_takes_scan_after_scan_and_names_what_is_not_one(server: Address):
    with connect(f"{server.ws}/api/scans/simulator") as socket:
        socket.send(json.dumps(scan_message(wall(3.0))))
        socket.send("hello")
        assert "this is not JSON" in json.loads(socket.recv(timeout=SECONDS))["error"]
        socket.send(json.dumps(scan_message(wall(2.0))).encode())
        with page_of(server) as page:
            state = page.hello(recording="live:simulator")
            while state["frames"] < 2:
                state = page.hear_a("drawn")["state"]
            assert nearest(state) == pytest.approx(2.0, abs=1e-3)
            assert page.heard("live", lambda m: m["refused"] == 1)["publishable"] is False


def test_a_live_recording_is_recorded_for_rerun_in_its_current_state(server: Address, tmp_path: Path):
    for distance in (3.0, 2.5):
        server.post("/api/scans/simulator", json=scan_message(wall(distance)))
    with page_of(server) as page:
        page.hello(recording="live:simulator")
        told = server.post("/api/rerun", params={"session": page.welcome["session"]}).text.splitlines()
        id = json.loads(told[-1])["recording"]
    (tmp_path / "run.rrd").write_bytes(server.get(f"/api/rerun/{id}.rrd").content)
    rows = [row for row in rows_of(tmp_path / "run.rrd", "/laser/points") if row.get("frame") is not None]
    assert [min(x for x, _, _ in row["positions"]) for row in rows] == pytest.approx([3.0, 2.5], abs=1e-3)


@pytest.mark.parametrize(
    ("name", "content", "status", "sentence"),
    [
        ("a", b"[1, 2]", 400, "a LaserScan is an object"),
        ("a", b"{", 400, "this is not JSON"),
        ("a", b'{"angle_min": 0, "angle_increment": 0.1, "ranges": []}', 400, "the scan has no ranges"),
        ("a", b'{"ranges": ' + b"[" * 100_000, 400, "this is not JSON"),
        ("a", b" " * (LARGEST + 1), 413, "at most"),
        ("a" * 65, b"{}", 400, "is not a valid name"),
        ("..", b"{}", 404, ""),
        ("a%2Fb", b"{}", 404, ""),
        ("%00", b"{}", 400, "is not a valid name"),
    ],
)
def test_an_invalid_scan_is_refused(server: Address, name: str, content: bytes, status: int, sentence: str):
    answer = server.post(f"/api/scans/{name}", content=content)
    assert answer.status_code == status
    assert sentence in answer.text


def test_too_many_beams_or_names_are_refused(server: Address):
    many = {"angle_min": 0, "angle_increment": 0.1, "ranges": [1] * 100_001}
    assert "100001 beams; send at most 100000" in server.post("/api/scans/a", json=many).json()["message"]
    answers = [server.post(f"/api/scans/name{k}", json=scan_message([1.0])) for k in range(MOST_PUSHED)]
    assert [answer.status_code for answer in answers] == [200] * (MOST_PUSHED - 1) + [429]
    with connect(f"{server.ws}/api/scans/another") as socket:
        assert "are pushed under" in json.loads(socket.recv(timeout=SECONDS))["error"]
        with pytest.raises(ConnectionClosed):
            socket.recv(timeout=SECONDS)


def test_scans_come_at_a_bounded_rate():
    pace = Pace()
    with pytest.raises(TooFastError, match="this scan was dropped"):
        for _ in range(10 * int(MOST_A_SECOND)):
            pace.step("a")
    pace.step("b")


def test_a_foreign_page_may_not_push(server: Address):
    foreign = {"Origin": "https://elsewhere.example"}
    assert server.post("/api/scans/a", json=scan_message([1.0]), headers=foreign).status_code == 403
    with pytest.raises(InvalidStatus), connect(f"{server.ws}/api/scans/a", origin=foreign["Origin"]):
        pass


def test_a_program_sends_the_token_as_bearer(tmp_path: Path):
    with serving(Settings(data_folder=tmp_path, token="correct horse")) as server:
        answers = [
            server.post("/api/scans/a", json=scan_message([1.0]), headers=headers)
            for headers in ({}, {"Authorization": "Bearer wrong"}, {"Authorization": "Bearer correct horse"})
        ]
        assert [answer.status_code for answer in answers] == [403, 403, 200]
        assert "Authorization: Bearer" in answers[0].json()["message"]
        bearer = {"Authorization": "Bearer correct horse"}
        with connect(f"{server.ws}/api/scans/a", additional_headers=bearer) as socket:
            socket.send("{")
            assert "not JSON" in json.loads(socket.recv(timeout=SECONDS))["error"]


def test_an_unknown_live_source_is_named(server: Address):
    with page_of(server) as page:
        page.hello()
        assert "push a scan under this name first" in page.refused(recording="live:nobody")["message"]


def test_scans_that_were_not_drawn_because_newer_ones_arrived_are_counted(server: Address):
    scans = 60
    with page_of(server) as page, connect(f"{server.ws}/api/scans/fast") as socket:
        socket.send(json.dumps(scan_message(wall(3.0))))
        page.hello()
        eventually(lambda: page.change(recording="live:fast")["frames"], "the first scan")
        first = page.last["drawn"]["state"]["frame"]
        for _ in range(scans):
            socket.send(json.dumps(scan_message(wall(2.0))))
        frames = [first]
        while frames[-1] < scans:
            frames.append(page.hear_a("drawn")["state"]["frame"])
        passed_over = scans - first - len(set(frames) - {first})
        assert page.heard("live", lambda m: m["notDrawn"] == passed_over)["total"] == scans + 1
