"""A file that cannot be read at first, looked at under one Reading after another."""

from __future__ import annotations

import json
from pathlib import Path

from lineseg_app.shelf.preview import first_lines, for_the_page, named_in
from live import Address, Page, connect
from waiting import SECONDS

ROWS = "\n".join([",".join(["2.5"] * 97)] * 3).encode()


def test_a_file_that_needs_help_is_kept_tried_and_opened(server: Address, page: Page):
    page.hello()
    id = server.upload("odd.csv", ROWS).json()["recording"]
    refused = page.refused(recording=id)["refused"]
    assert (refused["label"], "angle_increment" in refused["named"]) == ("odd.csv", True)
    with connect(f"{server.ws}/api/reading") as socket:
        for job, reading in enumerate([{}, {"angle_increment": 0.02, "angle_min": "-0.96"}]):
            socket.send(json.dumps({"job": job, "recording": id, "reading": reading}))
        while (seen := json.loads(socket.recv(SECONDS)))["job"] != 1:
            pass
    assert seen["lines"][0].startswith("2.5,2.5,") and seen["lines"][0].endswith("…")
    assert (seen["message"], [len(points) for points in seen["scans"]]) == (None, [97, 97, 97])
    state = page.change(recording=id, reading={"angle_increment": 0.02, "angle_min": -0.96})
    assert (state["label"], state["readAs"]) == ("odd.csv", {"angle_increment": 0.02, "angle_min": -0.96})


def test_the_panel_is_offered_only_if_another_reading_could_help(server: Address, page: Page):
    page.hello()
    for name, content, helps in (
        ("letter.csv", b"Dear reader,\nthis is a letter.\n", False),
        ("table.mat", b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: " + bytes(99), False),
        ("other.json", b'{"a": [1, 2, 3]}', False),
        ("odd.csv", ROWS, True),
    ):
        refused = page.refused(recording=server.upload(name, content).json()["recording"])["refused"]
        assert (refused is not None) == helps, name


def test_fields_that_a_sentence_names_are_found():
    assert named_in("give angle_increment, or --unit mm and --skip-columns 1; columns of a file_name") == [
        "angle_increment", "unit", "skip_columns",
    ]  # fmt: skip


def test_fields_are_called_as_the_page_calls_them():
    said = "give --skip-columns 1 or --columns=-,x,y. The flag --unit says more; `ros2 topic echo --csv` is none."
    assert for_the_page(said) == (
        "give the field “columns to skip” 1 or the field “columns”: -,x,y. The field “unit of ranges” says more; "
        "`ros2 topic echo --csv` is none."
    )


def test_the_first_lines_are_those_of_text_in_any_encoding(tmp_path: Path):
    file = tmp_path / "any"
    for encoding in ("utf-8", "utf-8-sig", "utf-16", "latin-1"):
        file.write_bytes("Gerät\n1;2\n".encode(encoding))
        assert first_lines(file) == ["Gerät", "1;2"]
    file.write_bytes("é1,2\n".encode() * 9000)
    assert first_lines(file) == ["é1,2"] * 5
    file.write_bytes(b"PK\x03\x04\x00\x00")
    assert first_lines(file) == []
