"""A short run of `tests/fuzz.py`."""

import contextlib
import json
import random
from collections.abc import Iterator
from pathlib import Path

import fuzz
import pytest
from lineseg_app.server import Settings
from live import Address, connect, page_of, serving
from waiting import SECONDS
from websockets.exceptions import WebSocketException

from lineseg import open_recording

CASES = 5000


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Address]:
    with serving(Settings(data_folder=tmp_path)) as address:
        yield address


def test_damaged_files_and_messages_open_or_are_refused_with_one_sentence(caplog: pytest.LogCaptureFixture):
    told = []
    counts = fuzz.run(0, CASES, tell=told.append)
    assert (counts["cases"], told) == (CASES, [])
    unexpected = [record.getMessage() for record in caplog.records if record.name == "lineseg.failing"]
    assert unexpected == []


MATRIX = "ranges = [1.2 1.3; 1.4 1.5];\n"
MESSAGE = "angle_min: -1.0\nangle_max: 1.0\nangle_increment: 0.01\nranges: [1.0, 2.0, "


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("word.m", MATRIX + "a" * 300_000),
        ("dots.m", MATRIX + "." * 300_000),
        ("brackets.m", MATRIX + "a = [" * 30_000),
        ("expression.m", MATRIX + "a = " + "(" * 300_000),
        ("statements.m", MATRIX + "".join(f"a{k} = {k};\n" for k in range(10_000))),
        ("lines.yaml", MESSAGE + "\n" * 300_000),
    ],
)
def test_a_long_run_is_not_read_again_for_each_of_its_characters(tmp_path: Path, name: str, text: str):
    # Otherwise this takes minutes, in which a server would answer nobody.
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match=name):
        open_recording(tmp_path / name)


@pytest.mark.parametrize(
    "statements",
    [
        pytest.param("".join(f"a{k} = linspace(0, 1, 16000000);\n" for k in range(100)), id="kept"),
        pytest.param("a = linspace(0, 1, 1000000) + nothing;\n" * 100, id="not kept"),
        pytest.param(f"a = [{'1;' * 400}1];\nb = a * linspace(0, 1, 1000000) * nothing;\n", id="column and row"),
    ],
)
def test_what_a_short_file_computes_is_bounded(tmp_path: Path, statements: str):
    path = tmp_path / "computed.m"
    path.write_text(MATRIX + statements)
    with pytest.raises(ValueError, match=r"computed\.m would have more than 256 MB"):
        open_recording(path)


def test_a_tab_goes_on_whatever_its_page_sends(server: Address, caplog: pytest.LogCaptureFixture):
    chance = random.Random(1)
    with page_of(server) as page:
        page.hello()
        for number in range(300):
            message = fuzz.mutant(json.dumps(fuzz.MESSAGES[1 + number % 4]).encode(), chance)
            page._socket.send(message if number % 3 else message.decode("utf-8", "replace"))
        # A topic that a mutant asked for, and that is still being looked for, is not in this recording.
        first = {"recording": page.welcome["recordings"][0]["id"], "topic": None, "frame": 1}
        page.say(type="link", rev=10**6, patch=first)
        assert page.drawn_or_told(10**6)["frame"] == 1
    for path in ("/api/tuning?session=x", "/api/scans/lidar", "/api/scans/l%C3%BC", "/s/x/viser"):
        with contextlib.suppress(WebSocketException), connect(server.ws + path) as socket:
            for message in (b"\xff\x00", "\U0001f600", "[" * 5000, '{"type": "\\ud800"}', "9" * 5000):
                socket.send(message)
            socket.recv(timeout=SECONDS)
    assert [record.getMessage() for record in caplog.records if record.levelname == "ERROR"] == []
