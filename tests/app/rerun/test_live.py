"""The live stream, tested with rerun's own server."""

from __future__ import annotations

import contextlib
import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from lineseg_app.frame.findings import findings
from lineseg_app.rerun.live import LiveRerun, answers, start_viewer
from lineseg_app.rerun.viewer import executable, quiet_environment
from lineseg_app.shelf.scratch import remove_leftovers
from lineseg_app.view import View
from live import Address, page_of
from ports import held_port
from rrd import rows_of
from scenes import wall_ahead
from waiting import SECONDS, eventually

from lineseg import Params, Recording


@contextlib.contextmanager
def rerun_server(port: int, file: Path) -> Iterator[None]:
    """rerun's own server, which writes what it hears to a file."""
    flags = ["--serve-grpc", "--bind", "127.0.0.1", "--port", str(port), "--save", str(file)]
    with subprocess.Popen([executable(), *flags], env=quiet_environment(file.parent)) as program:
        try:
            eventually(lambda: answers(port), "rerun's server to start", program.poll)
            yield
        finally:
            program.terminate()


@pytest.fixture
def walls() -> Recording:
    scans = [wall_ahead(4.0 - frame / 2, 10.0, noise=0.005, seed=frame, stamp=float(frame)) for frame in range(5)]
    return Recording.from_scans(scans, name="walls")


@pytest.fixture
def port() -> Iterator[int]:
    with held_port() as port:
        yield port


def frames_in(file: Path) -> list[int]:
    if not file.exists():
        return []
    with contextlib.suppress(Exception):
        return [row["frame"] for row in rows_of(file, "/laser/segments") if row.get("frame") is not None]
    return []


def heard(file: Path, frames: list[int]) -> None:
    eventually(lambda: frames_in(file) == frames, f"the frames {frames} in {file.name}", lambda: frames_in(file))


def test_a_viewer_hears_frames_and_thresholds_as_they_change_and_one_that_returns_hears_what_is_shown(
    walls: Recording, tmp_path: Path, port: int
):
    live = LiveRerun(port)

    def look(frame: int, **values: float) -> None:
        params = Params().but(**values)
        view = View(recording="walls", frame=frame, params=params)
        live.show(view, walls, "walls", findings(walls, frame, "region-growing", params))

    try:
        look(0)
        with rerun_server(port, tmp_path / "first.rrd"):
            heard(tmp_path / "first.rrd", [0])
            look(1)
            heard(tmp_path / "first.rrd", [0, 1])
            look(1, min_length=100.0)
            heard(tmp_path / "first.rrd", [0, 1, 1])
        look(2)
        with rerun_server(port, tmp_path / "second.rrd"):
            heard(tmp_path / "second.rrd", [2])
            look(3)
            heard(tmp_path / "second.rrd", [2, 3])
    finally:
        live.close()
    found = [len(row["strips"] or []) for row in rows_of(tmp_path / "first.rrd", "/laser/segments") if "frame" in row]
    assert found == [1, 1, 0]
    assert rows_of(tmp_path / "second.rrd", "/__properties/lineseg")


SILENT = """
import socket, sys
from lineseg_app.__main__ import main
from lineseg_app.rerun import live
silent = socket.create_server(("127.0.0.1", 0))
live.live_rerun.__wrapped__.__defaults__ = (silent.getsockname()[1],)
sys.exit(main(["view", "--no-browser", "--port", "0", "--rerun"]))
"""


def test_a_viewer_that_never_answers_is_told_once_and_does_not_hold_up_the_end(tmp_path: Path):
    silent, environment = subprocess.PIPE, os.environ | {"XDG_DATA_HOME": str(tmp_path), "TMPDIR": str(tmp_path)}
    server = subprocess.Popen([sys.executable, "-c", SILENT], stdout=silent, stderr=silent, text=True, env=environment)
    assert server.stdout is not None
    address = next(line for line in server.stdout if "http://" in line)
    port = int(re.search(r":(\d+)/", address)[1])  # type: ignore[index]
    try:
        with page_of(Address(port)) as page:
            page.hello()
            assert server.stderr is not None
            said = next(line for line in server.stderr if "does not take what it is sent" in line)
            for frame in range(1, 4):
                page.change(frame=frame)
                # In which it would try again, and then say so.
                time.sleep(0.2)
        server.terminate()
        said += server.communicate(timeout=SECONDS)[1]
    finally:
        server.kill()
    assert server.returncode == 0
    assert said.count("does not take what it is sent") == 1
    assert "Traceback" not in said


@pytest.mark.skipif(sys.platform == "win32", reason="files are locked in another way")
@pytest.mark.filterwarnings("ignore:subprocess .* is still running:ResourceWarning")
def test_the_settings_of_a_viewer_stay_while_it_runs_and_are_removed_after_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, port: int
):
    """A stand-in for rerun's viewer, which needs a display: it listens, and waits to be told to end."""
    viewer = tmp_path / "viewer"
    viewer.write_text(f"""#!{sys.executable}
import socket, sys
if "--port" in sys.argv:
    with socket.create_server(("127.0.0.1", int(sys.argv[sys.argv.index("--port") + 1]))) as server:
        while server.accept()[0].recv(1) != b"q":
            pass
""")
    viewer.chmod(0o755)
    monkeypatch.setenv("RERUN_CLI_PATH", str(viewer))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    start_viewer(port)
    (folder,) = (tmp_path / "temporary").iterdir()
    os.utime(folder, (0, 0))
    remove_leftovers(tmp_path / "user")
    assert folder.exists()
    with socket.create_connection(("127.0.0.1", port)) as viewer_told:
        viewer_told.send(b"q")

    def gone() -> bool:
        remove_leftovers(tmp_path / "user")
        return not folder.exists()

    eventually(gone, "the settings of a viewer that has ended to be removed")
