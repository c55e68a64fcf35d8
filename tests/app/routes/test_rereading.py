"""A file that cannot be read at first, looked at under one Reading after another."""

from __future__ import annotations

import json

from lineseg_app.shelf.preview import named_in
from live import Address, Page
from websockets.sync.client import connect

ROWS = "\n".join([",".join(["2.5"] * 97)] * 3).encode()


def test_a_file_that_needs_help_is_kept_tried_and_opened(server: Address, page: Page):
    page.hello()
    id = server.upload("odd.csv", ROWS).json()["recording"]
    refused = page.refused(recording=id)["refused"]
    assert (refused["label"], "angle_increment" in refused["named"]) == ("odd.csv", True)
    with connect(f"{server.ws}/api/reading") as socket:
        for job, reading in enumerate([{}, {"angle_increment": 0.02, "angle_min": "-0.96"}]):
            socket.send(json.dumps({"job": job, "recording": id, "reading": reading}))
        while (seen := json.loads(socket.recv(60)))["job"] != 1:
            pass
    assert (seen["message"], [len(points) for points in seen["scans"]]) == (None, [97, 97, 97])
    state = page.change(recording=id, reading={"angle_increment": 0.02, "angle_min": -0.96})
    assert (state["label"], state["readAs"]) == ("odd.csv", {"angle_increment": 0.02, "angle_min": -0.96})


def test_fields_that_a_sentence_names_are_found():
    assert named_in("give angle_increment, or --unit mm and --skip-columns 1; columns of a file_name") == [
        "angle_increment", "unit", "skip_columns",
    ]  # fmt: skip
