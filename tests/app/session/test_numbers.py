"""A frame has one number everywhere, that of its file, also if some frames of the file are left out."""

from __future__ import annotations

import io
import json
import shutil
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from lineseg_app.server import Settings
from live import Address, Page, page_of, serving

from lineseg import open_recording, read_labels


@pytest.fixture
def file(recordings: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(recordings / "walls.npz", tmp_path / "walls.npz"))


@pytest.fixture
def own(file: Path, tmp_path: Path) -> Iterator[Address]:
    with serving(Settings(files=(file,), data_folder=tmp_path / "user", upload_limit=1_000_000)) as address:
        yield address


@pytest.fixture
def page(own: Address) -> Iterator[Page]:
    with page_of(own) as page:
        yield page


def test_the_view_the_times_and_the_survey_count_as_the_file_does(page: Page):
    whole = page.hello(frame=2)
    assert page.heard("times", lambda m: m["since"] == [0, 1, 2, 3, 4])["why"] == ""
    third = page.change(reading={"frames": "1:", "every_scan": 2}, frame=4)
    assert (third["frame"], third["first"], third["every"], third["frames"]) == (4, 2, 2, 2)
    assert (third["since"], third["stamp"]) == (4, 4)
    assert third["segments"] != whole["segments"]
    assert page.heard("times", lambda m: m["place"] == third["place"])["since"] == [2, 4]
    surveyed = page.heard("survey", lambda m: m["place"] == third["place"])
    assert (surveyed["first"], surveyed["every"]) == (2, 2)
    # Of a frame that is left out, the nearest is shown.
    assert page.change(frame=99)["frame"] == 4
    assert page.change(frame=0)["frame"] == 2


def test_exports_and_labels_have_the_number_of_the_file(own: Address, page: Page, file: Path):
    state = page.hello(reading={"every_scan": 2}, frame=4, mode="inspect")
    session = {"session": page.welcome["session"]}
    svg = own.get("/api/figure", params=session)
    assert "walls_4.svg" in svg.headers["content-disposition"].replace(".npz", "")
    assert "frame 4 of 0–4" in svg.text
    rows = [json.loads(line) for line in own.get("/api/segments", params=session).text.splitlines()]
    assert [row["frame"] for row in rows if "frame" in row] == [0, 2, 4]
    assert set(own.get("/api/why", params={**session, "frames": "0,1,4"}).json()["found"]) == {"0", "4"}

    said = {"recording": state["recording"], "reading": state["readAs"], "revision": 0, "tags": ["door"], "note": ""}
    line = {"first": 20, "last": 90}
    assert own.put("/api/labels", json=said | {"frame": 4, "lines": [line]}).status_code == 200
    page.until(lambda s: s["labels"]["tags"] == ["door"])
    refused = own.put("/api/labels", json=said | {"frame": 3, "lines": [line]})
    assert "not all of them are read" in refused.json()["message"]
    # The labels belong to the frame, whichever others are read with it.
    sidecar, recording = file.with_name("walls.npz.lineseg.json"), open_recording(file)
    assert list(read_labels(sidecar, recording)) == [4]
    assert page.change(reading={"every_scan": None}, frame=4)["labels"]["tags"] == ["door"]
    assert own.put("/api/labels", json=said | {"reading": {}, "frame": 3, "lines": []}).status_code == 200
    assert list(read_labels(sidecar, recording)) == [3, 4]
    assert list(read_labels(sidecar, open_recording(file, every_scan=2))) == [4]


def test_the_frame_of_a_failure_pack_keeps_its_number(own: Address, page: Page, tmp_path: Path):
    page.hello(reading={"every_scan": 2}, frame=4)
    pack = own.post("/api/pack", params={"session": page.welcome["session"]}, content=b"odd")
    assert "_4.zip" in pack.headers["content-disposition"]
    (tmp_path / "odd.zip").write_bytes(pack.content)
    rows = zipfile.ZipFile(io.BytesIO(pack.content)).read("segments.jsonl").decode().splitlines()
    assert json.loads(rows[-1])["frame"] == 4
    opened = open_recording(tmp_path / "odd.zip")
    assert (opened.number(0), len(opened), opened.position(4)) == (4, 1, 0)
