"""Files appear when they are complete; killed processes and full disks leave nothing that counts."""

import contextlib
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.__main__ import main
from lineseg_app.server import Settings
from lineseg_app.shelf.recent import Recent
from live import connect, page_of, serving
from waiting import SECONDS

from lineseg import FrameLabels, Recording, Scan, open_recording, read_labels, save_labels
from lineseg.readers import save_npz
from lineseg.unfinished import FILES, temporary_folder, whole_file, write_whole

WALLS = Path(__file__).parents[1] / "sample_scans" / "hallway.npz"


@pytest.fixture
def tiny(tmp_path) -> Iterator[Path]:
    """A disk with room for 128 kB."""
    folder = tmp_path / "tiny"
    folder.mkdir()
    made = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=128k", "tmpfs", folder], capture_output=True)
    if made.returncode:
        pytest.skip("mounting a small disk needs root")
    yield folder
    subprocess.run(["umount", "-l", folder], check=True)


HOLD = """
import sys
from pathlib import Path
from lineseg.unfinished import whole_file
with whole_file(Path(sys.argv[1])) as part:
    part.write_text("half")
    print("written", flush=True)
    input()
"""


def test_what_a_killed_process_left_is_removed_by_the_next_command(tmp_path, capsys):
    command = [sys.executable, "-c", HOLD, tmp_path / "out.jsonl"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "written\n"
        process.kill()
    (left,) = tmp_path.iterdir()
    os.utime(left, (0, 0))
    small = tmp_path / "small.npz"
    save_npz(Recording.from_scans([Scan.regular(np.ones(9), 0.0, 0.01)]), small)
    assert main(["extract", str(small), "-o", str(tmp_path / "other.csv")]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["other.csv", "other.csv.json", "small.npz"]
    capsys.readouterr()


def test_what_another_process_is_writing_stays(tmp_path):
    with whole_file(tmp_path / "one.txt") as one:
        one.write_text("1")
        os.utime(one, (0, 0))
        with whole_file(tmp_path / "two.txt") as two:
            two.write_text("2")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.txt", "two.txt"]


def test_an_error_leaves_the_former_file_and_nothing_else(tmp_path):
    path = tmp_path / "out.txt"
    path.write_text("former")
    path.chmod(0o600)
    with pytest.raises(ZeroDivisionError), whole_file(path) as part:
        part.write_text("new")
        raise ZeroDivisionError
    assert [each.read_text() for each in tmp_path.iterdir()] == ["former"]
    with whole_file(path) as part:
        part.write_text("new")
    assert (path.read_text(), path.stat().st_mode & 0o777) == ("new", 0o600)


def test_a_link_stays_a_link_and_a_pipe_a_pipe(tmp_path):
    (tmp_path / "far").mkdir()
    link = tmp_path / "link.txt"
    link.symlink_to("far/out.txt")
    write_whole(link, "new")
    assert (link.is_symlink(), (tmp_path / "far" / "out.txt").read_text()) == (True, "new")
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with ThreadPoolExecutor(1) as reader:
        told = reader.submit(pipe.read_text)
        write_whole(pipe, "said")
    assert (told.result(), pipe.is_fifo()) == ("said", True)


def test_a_recording_survives_a_larger_one_of_its_name_that_does_not_fit(tiny):
    path = tiny / "out.npz"
    save_npz(Recording.from_scans([Scan.regular(np.ones(9), 0.0, 0.01)]), path)
    noise = np.random.default_rng(1).uniform(1, 2, (60, 500))
    with pytest.raises(OSError, match="No space left on device") as error:
        save_npz(Recording.from_scans([Scan.regular(row, 0.0, 0.01) for row in noise]), path)
    assert (error.value.filename, list(tiny.iterdir())) == (str(path), [path])
    assert len(open_recording(path)) == 1


COMMANDS = [
    ("extract walls.npz -o out.csv", "out.csv.json"),
    ("compare walls.npz --methods region-growing --budget 0 -o out.md", "out.md"),
    ("sweep walls.npz --epsilon 0.01,0.02 -o out.csv --plot out.svg", "out.svg"),
]


@pytest.mark.parametrize(("command", "name"), COMMANDS)
def test_no_command_writes_into_the_former_file(tmp_path, monkeypatch, capsys, command, name):
    monkeypatch.chdir(tmp_path)
    save_npz(Recording.from_scans([Scan.regular(np.ones(30), 0.0, 0.01)] * 4), "walls.npz")
    Path(name).write_text("former")
    os.link(name, "held")
    assert main(command.split()) == 0, capsys.readouterr().err
    assert (Path("held").read_text(), Path(name).stat().st_size > 100) == ("former", True)


def test_a_temporary_folder_is_gone_at_the_end():
    with temporary_folder() as folder:
        (folder / "file").touch()
    assert not folder.exists()


@pytest.mark.parametrize(("command", "name"), [("extract", "out.jsonl"), ("record", "out.rrd")])
def test_a_full_disk_is_called_so_and_nothing_is_left_on_it(tiny, capsys, command, name):
    assert main([command, str(WALLS), "-o", str(tiny / name)]) == 2
    assert capsys.readouterr().err.strip() == f"lineseg: {tiny / name}: No space left on device."
    assert list(tiny.iterdir()) == []


def test_a_read_only_disk_is_told_with_the_name_of_the_file_that_was_asked_for(tiny, capsys):
    subprocess.run(["mount", "-o", "remount,ro", tiny], check=True)
    assert main(["extract", str(WALLS), "-o", str(tiny / "out.jsonl")]) == 2
    assert capsys.readouterr().err.strip() == f"lineseg: {tiny / 'out.jsonl'}: Read-only file system."


def test_labels_for_which_the_disk_has_no_space_name_their_file_and_the_former_ones_stay(tiny):
    walls = Recording.from_scans([Scan.regular(np.ones(9), 0.0, 0.01)])
    path = tiny / "walls.npz.lineseg.json"
    save_labels(path, walls, 0, FrameLabels(None, (), "former", 0))
    with pytest.raises(OSError, match="No space left on device") as error:
        save_labels(path, walls, 0, FrameLabels(None, (), "long" * 40_000, 1))
    assert error.value.filename == str(path)
    assert list(tiny.iterdir()) == [path]
    assert read_labels(path, walls)[0].note == "former"


def test_a_download_for_which_the_disk_has_no_space_is_refused_with_a_sentence(tiny, tmp_path, monkeypatch):
    with serving(Settings(files=(WALLS,), data_folder=tmp_path / "data")) as server, page_of(server) as page:
        page.hello()
        monkeypatch.setattr("tempfile.tempdir", str(tiny))
        answer = server.get("/api/recording", params={"session": page.welcome["session"]})
    assert answer.status_code == 507
    assert answer.json()["message"] == "the recording cannot be written: No space left on device."
    assert list(tiny.iterdir()) == []


def test_an_upload_for_which_the_disk_has_no_space_is_refused_with_a_sentence(tiny, tmp_path, monkeypatch):
    with serving(Settings(data_folder=tmp_path / "data")) as server:
        monkeypatch.setattr("tempfile.tempdir", str(tiny))
        for path, name in (("/api/upload", "walls.npz"), ("/api/lessons/file", "lesson.json")):
            answer = server.post(path, params={"name": name}, content=b"x" * 200_000)
            told = answer.json()["message"]
            assert (answer.status_code, told) == (507, f"{name} could not be stored: No space left on device")
        assert not [left for left in tiny.rglob("*") if left.is_file() and left.stat().st_size]


def test_tuning_for_whose_trials_the_disk_has_no_space_says_so(tiny):
    pytest.importorskip("optuna", reason="tuning needs the extra tune")
    wish = {"type": "auto", "job": 1, "objective": "label-free", "thresholds": ["epsilon"], "trials": 2, "params": {}}
    with serving(Settings(files=(WALLS,), data_folder=tiny)) as server, page_of(server) as page:
        page.hello()
        with (tiny / "full").open("wb", buffering=0) as full, contextlib.suppress(OSError):
            while True:
                full.write(bytes(4096))
        with connect(f"{server.ws}/api/tuning?session={page.welcome['session']}") as socket:
            socket.send(json.dumps(wish))
            while not (told := json.loads(socket.recv(SECONDS))).get("done"):
                pass
    assert re.fullmatch(r"[\w./-]+: No space left on device\.", told["message"].replace("the trials", "trials"))


def test_rerun_s_viewer_for_which_the_disk_has_no_space_is_refused_with_a_sentence(tiny, tmp_path, monkeypatch):
    pytest.importorskip("rerun", reason="the viewer needs the extra rerun")
    with serving(Settings(data_folder=tmp_path / "data")) as server:
        monkeypatch.setattr("tempfile.tempdir", str(tiny))
        answer = server.get("/rerun/re_viewer_bg.wasm")
    assert (answer.status_code, answer.json()["message"]) == (507, "rerun's viewer: No space left on device.")


def test_the_list_of_recent_files_is_whole_whatever_the_disk_says(tiny, tmp_path):
    recent = Recent(tiny)
    recent.add(tmp_path / "one.npz")
    for number in range(12):
        recent.add(tmp_path / f"{'long' * 5000}{number}.npz")
    assert Recent(tiny).paths()[-1] == tmp_path / "one.npz"
    assert [left.name for left in tiny.iterdir()] == ["recent.json"]
    left = tiny / FILES.replace("*", "of a killed process")
    left.touch()
    os.utime(left, (0, 0))
    Recent(tiny).add(tmp_path / "two.npz")
    assert not left.exists()


def test_the_list_of_recent_files_may_say_anything(tmp_path):
    paths = ["x" * 5000, "\ud800", "\0", "", 5, {"path": "x.npz", "reading": {"unit": []}}, {"path": []}, None]
    (tmp_path / "recent.json").write_text(json.dumps(paths))
    with serving(Settings(data_folder=tmp_path)) as server, page_of(server) as page:
        page.hello()
        recent = [entry for entry in page.welcome["recordings"] if entry["group"] == "Recent"]
        assert [entry["missing"] for entry in recent] == [True, True]
        assert "cannot be read: File name too long" in page.refused(recording=recent[0]["id"])["message"]
        assert page.change(frame=1)["frame"] == 1
