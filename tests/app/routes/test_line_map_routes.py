"""The line map in a tab: made while its layer is shown, with its lines for the pointer, and exported with progress."""

import base64
import json

import numpy as np
import pytest
from lineseg_app.places import data_folder
from lineseg_app.server import Settings
from live import page_of, serving

from lineseg import open_recording
from lineseg.line_map import line_map

HALLWAY = data_folder("sample_scans") / "hallway.log"


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with serving(Settings(files=(HALLWAY,), data_folder=tmp_path_factory.mktemp("user"))) as client:
        yield client


def lines_of(server, session, to):
    answer = server.post("/api/line-map", params={"session": session, "to": to})
    return answer.status_code, [json.loads(line) for line in answer.text.splitlines()]


def test_the_map_is_drawn_while_its_layer_is_shown(server):
    with page_of(server) as page:
        page.hello(space="world")
        session = page.welcome["session"]
        assert server.get("/api/line-map", params={"session": session}).status_code == 404
        page.change(layers={"line_map": True})
        state = page.until(lambda state: state["world"] and state["world"]["map"])
        assert "line map" in state["nodes"]
        found = line_map(open_recording(HALLWAY))
        assert state["world"]["map"] == found.text
        told = server.get("/api/line-map", params={"session": session}).json()
        assert np.allclose(told["ends"], found.ends, atol=1e-4)
        assert told["seen"] == found.seen.tolist()
        _, answers = lines_of(server, session, "geojson")
        assert [list(answer) for answer in answers] == [["done", "total"], ["name", "content", "text"]]
        assert answers[-1]["text"] == found.text
        page.change(params={"min_length": 2.0})
        _, answers = lines_of(server, session, "geojson")
        assert answers[-1]["text"] != found.text
        state = page.change(layers={"line_map": False})
        assert "line map" not in state["nodes"]
        assert state["world"]["map"] == ""


def test_the_map_is_exported_after_telling_its_progress(server):
    with page_of(server) as page:
        page.hello()
        code, told = lines_of(server, page.welcome["session"], "geojson")
        assert code == 200
        assert {"done", "total"} <= set(told[0])
        assert told[-1]["name"] == "hallway.log_map.metres.geojson"
        content = json.loads(base64.b64decode(told[-1]["content"]))
        assert len(content["features"]) == len(line_map(open_recording(HALLWAY)))
        code, told = lines_of(server, page.welcome["session"], "png")
        assert (code, told[0]["message"][:24]) == (400, "a map cannot be written ")


def test_without_poses_the_export_says_why(server):
    with page_of(server) as page:
        page.hello(recording="sample:hallway.csv")
        _, told = lines_of(server, page.welcome["session"], "svg")
        assert "has no poses" in told[-1]["message"]
