"""The command line, as users call it."""

import csv
import json
import os
import re
import signal
import subprocess
import sys
import time
import urllib.request
from itertools import pairwise
from subprocess import PIPE

import numpy as np
import platformdirs
import pytest
from lineseg_app.__main__ import main
from lineseg_app.commands import COMMANDS
from lineseg_app.places import data_folder
from lineseg_app.stopping import interruptible
from processes import lineseg
from waiting import SECONDS, eventually

from lineseg import Params, extract, why_apart
from lineseg.readers import open_recording
from lineseg.unfinished import FILES
from lineseg.writers import params_text

TURN = 0.25 * np.pi / 180


@pytest.fixture
def hall(tmp_path):
    """Three scans of a hall with walls at y = ±1.5 m, and one beam lost."""
    bearings = np.deg2rad(-90) + TURN * np.arange(721)
    with np.errstate(divide="ignore"):
        ranges = np.minimum(np.abs(1.5 / np.sin(bearings)), 8.0 / np.cos(bearings)) * np.ones((3, 1))
    ranges[:, 300] = np.nan
    path = tmp_path / "hall.npz"
    np.savez(path, ranges=ranges, angle_min=bearings[0], angle_increment=TURN, stamps=[1.0, 1.5, 2.0], frame_id="laser")
    return path


@pytest.fixture
def run(capsys):
    def call(*arguments):
        code = main([str(argument) for argument in arguments])
        return code, *capsys.readouterr()

    return call


def test_extract_writes_the_segments_that_the_library_finds(run, hall, tmp_path):
    assert run("extract", hall, "-o", tmp_path / "out.jsonl") == (0, "", "")
    rows = [json.loads(line) for line in (tmp_path / "out.jsonl").read_text().splitlines()]
    recording = open_recording(hall)
    assert [(row["frame"], row["stamp"], row["frame_id"]) for row in rows] == [
        (0, 1.0, "laser"),
        (1, 1.5, "laser"),
        (2, 2.0, "laser"),
    ]
    for row, scan in zip(rows, recording, strict=True):
        found = [(each["first"], each["last"], each["points"]) for each in row["segments"]]
        assert found == [(each.first, each.last, each.points) for each in extract(scan).segments]
        assert found


def test_extract_writes_covariances_where_the_noise_is_given(run, hall, tmp_path):
    code, out, _ = run("extract", hall, "--range-noise", "0.01")
    first = json.loads(out.splitlines()[0])["segments"][0]
    (var_rho, cov), (_, var_theta) = first["covariance"]
    assert code == 0
    assert var_rho * var_theta > cov**2
    assert "covariance" not in run("extract", hall)[1]
    code, _, err = run("extract", hall, "--bearing-noise", "-1")
    assert (code, err) == (
        2,
        "lineseg: the noise of a bearing is -1; a standard deviation is 0 rad or more, and finite\n",
    )


def test_extract_writes_csv_and_standard_output(run, hall, tmp_path):
    run("extract", hall, "--out", tmp_path / "out.csv")
    with (tmp_path / "out.csv").open() as file:
        rows = list(csv.DictReader(file))
    code, out, _ = run("extract", hall)
    assert code == 0
    assert len(rows) == sum(len(json.loads(line)["segments"]) for line in out.splitlines()) > 0


def test_flags_win_over_the_file_of_thresholds(run, tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text(params_text(Params(epsilon=0.05, min_points=33), "ros2"))
    code, out, _ = run("params", "--params", path, "--epsilon", "0.07", "--to", "flags")
    assert code == 0
    assert out == params_text(Params(epsilon=0.07, min_points=33), "flags")


@pytest.mark.parametrize("format", ["ros2", "ros1", "python", "flags"])
def test_params_writes_each_format(run, format):
    assert run("params", "--to", format, "--seed-points", 7) == (0, params_text(Params(seed_points=7), format), "")


def test_every_threshold_is_a_flag_with_its_symbol_and_default(capsys):
    with pytest.raises(SystemExit) as raised:
        main(["extract", "--help"])
    assert raised.value.code == 0
    text = " ".join(capsys.readouterr().out.replace("│", " ").split())
    for name, _, knob in Params.knobs():
        assert re.search(rf"--{name.replace('_', '-')} \w+ {re.escape(knob.symbol)}", text), name
        assert f"(default: {getattr(Params(), name)})" in text


def test_the_list_of_commands_has_a_line_for_each(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    rows = re.findall(r"(?m)^[ │]*(\S+ \w+)", capsys.readouterr().out.partition("(required)")[2])
    assert [row.split() for row in rows] == [["•", command] for command in COMMANDS]


@pytest.mark.parametrize("command", COMMANDS)
def test_the_help_says_what_each_flag_does_and_nothing_that_only_python_knows(capsys, command):
    with pytest.raises(SystemExit):
        main([command, "--help"])
    text = capsys.readouterr().out
    flags = re.sub(r"(?m)^[^│]*$|│", "", text)
    assert not re.search(r"\{None|\bSTR\b|--no-no-|type: ignore|default: (\)|None)", text)
    for flag in re.split(r"(?m)^ +(?=-)", flags)[1:]:
        assert len(re.sub(r"\([\w: .-]*\)", "", flag).split()) > 2, flag


@pytest.mark.parametrize("command", COMMANDS)
def test_the_lines_of_the_help_fill_the_terminal_and_are_no_wider(capsys, monkeypatch, command):
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit):
        main([command, "--help"])
    text = capsys.readouterr().out
    assert [line for line in text.splitlines() if len(line) > 80] == []
    # The first word of the next line of the same flag would not have fitted.
    rows = [line[1:-1].rstrip() for line in text.splitlines()]
    pairs = [(row, after) for row, after in pairwise(rows) if row[:3].strip() == "" and after.startswith(" " * 15)]
    assert [(row, after) for row, after in pairs if len(row) + 1 + len(after.split()[0]) < 77] == []


def test_info_says_what_a_recording_holds(run, hall):
    code, out, _ = run("info", hall)
    assert code == 0
    facts = dict(
        re.split(r"\s{2,}", line, maxsplit=1) if "  " in line else line.rsplit(" ", 1) for line in out.splitlines()
    )
    assert (facts["format"], facts["scans"], facts["beams"]) == ("NPZ", "3", "721")
    assert (facts["field of view"], facts["invalid beams"]) == ("180.00°", "0.14%")


def test_info_offers_the_other_topics(run, data_dir):
    code, out, _ = run("info", data_dir / "ros1_two_urg04lx" / "scans_demo.bag", "--topic", "/front_scan")
    assert code == 0
    assert "/rear_scan (330 scans)\n" in out
    assert "/front_scan (331 scans) *\n" in out


def test_options_of_text_files_are_flags(run, tmp_path):
    path = tmp_path / "scan.txt"
    path.write_text(" ".join(["1500"] * 50))
    code, _, err = run("info", path)
    assert (code, err.startswith("lineseg: scan.txt: rows of 50 numbers")) == (2, True)
    code, out, _ = run("info", path, "--angle-increment", "0.02", "--unit", "mm")
    assert code == 0
    assert "1.500 m" in out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["nowhere.bag"], "lineseg: nowhere.bag: there is no such file or folder."),
        (["extract"], "lineseg: name one or more files."),
        (["extract", "nowhere.bag"], "lineseg: nowhere.bag: there is no such file or folder."),
        (["info", "nowhere.bag"], "lineseg: nowhere.bag: there is no such file or folder."),
        (["extract", "{hall}", "-o", "out.txt"], "lineseg: out.txt: use a name that ends in .jsonl, .csv, .geojson."),
        (
            ["extract", "{hall}", "-o", "no/such/out.csv"],
            "lineseg: no/such/out.csv: the folder no/such does not exist.",
        ),
        (["extract", "{hall}", "--topic", "/scan"], "lineseg: hall.npz has no laser array '/scan'; it has ranges."),
        (["extract", "{hall}", "--params", "no.yaml"], "lineseg: no.yaml: No such file or directory."),
        (
            ["params", "--params", "{hall}"],
            "lineseg: {hall}: this is not text; give a launch file, YAML or JSON.",
        ),
        (
            ["sweep", "{hall}", "--params", "{hall}", "-o", "out.csv"],
            "lineseg: {hall}: this is not text; give a launch file, YAML or JSON.",
        ),
        (
            ["tune", "{hall}", "--params", "{hall}"],
            "lineseg: {hall}: this is not text; give a launch file, YAML or JSON.",
        ),
        (
            ["params", "--seed-points", "2"],
            "lineseg: seed_points is 2; a seed needs 3 or more points, because any 2 points fit a line exactly",
        ),
    ],
)
def test_an_error_is_one_sentence_and_code_2(run, hall, arguments, sentence):
    code, out, err = run(*(argument.format(hall=hall) for argument in arguments))
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(sentence.format(hall=hall))


def test_wrong_flags_are_refused_with_code_2(capsys):
    for arguments in (
        ["extract", "--out"],
        ["params", "--to", "ros3"],
        ["params", "--epsilon", "wide"],
        ["view", "--nonsense"],
    ):
        with pytest.raises(SystemExit) as raised:
            main(arguments)
        assert raised.value.code == 2
        assert capsys.readouterr().err


def test_version_is_said(run):
    code, out, _ = run("--version")
    assert code == 0
    assert re.fullmatch(r"lineseg \d+\.\d+\.\d+\n", out)


def test_other_commands_do_not_load_what_only_the_page_needs():
    heavy = {"viser", "fastapi", "uvicorn", "rosbags", "rerun"}
    script = f"import sys, lineseg_app.__main__; print(*{heavy} & set(sys.modules))"
    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == ""


def test_the_reader_of_a_pipe_may_stop_early(hall):
    command = f"{sys.executable} -m lineseg_app extract {hall} | head -n 1"
    found = subprocess.run(["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True, check=True)
    assert (found.stdout.count("\n"), found.stderr) == (1, "")


def test_ctrl_c_ends_an_extraction_without_a_trace(tmp_path):
    folder = tmp_path / "out"
    # So many files that it is at work when it is stopped.
    for number in range(5000):
        (tmp_path / f"{number}.npz").symlink_to(data_folder("sample_scans") / "hallway.npz")
    process = lineseg("extract", tmp_path / "*.npz", "-o", folder)
    eventually(lambda: folder.exists() and list(folder.iterdir()), "a first file", process.poll)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=SECONDS)
    assert (process.returncode, err) == (130, "lineseg: stopped.\n")
    assert not list(folder.glob(FILES))


@pytest.mark.parametrize(("number", "raised"), [(signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, SystemExit)])
def test_a_signal_in_a_finaliser_ends_the_work_a_moment_later(capsys, number, raised):
    class Finalised:
        def __del__(self):
            signal.raise_signal(number)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(raised), interruptible(0):
            Finalised()
            time.sleep(SECONDS)
    finally:
        signal.signal(signal.SIGINT, before)
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("arguments", [["view"], []], ids=["view FILE", "FILE"])
def test_a_file_alone_is_viewed_until_ctrl_c(hall, tmp_path, arguments):
    places = {"HOME": str(tmp_path), "XDG_DATA_HOME": str(tmp_path), "XDG_STATE_HOME": str(tmp_path)}
    environment = os.environ | places | {"XDG_CACHE_HOME": platformdirs.user_cache_dir()}
    process = lineseg(*arguments, hall, "--port", 0, "--no-browser", env=environment)
    assert process.stdout
    try:
        address = re.search(r"http://\S+", process.stdout.readline())
        assert address
        with urllib.request.urlopen(address[0], timeout=SECONDS) as page:
            assert page.status == 200
    finally:
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=SECONDS)
    assert "Traceback" not in err
    assert process.returncode == 130


LOADS_NO_FURTHER = """
import sys
class Held:
    def find_spec(self, name, path=None, target=None):
        if name == "lineseg_app.command_line":
            print("loading", flush=True)
            sys.stdin.read()
sys.meta_path.insert(0, Held())
import runpy
runpy.run_module("lineseg_app", run_name="__main__")
"""


@pytest.mark.parametrize(
    ("command", "code"), [("view --port 0 --no-browser", 0), ("node ws://127.0.0.1:1", 0), ("extract -", 143)]
)
def test_sigterm_ends_a_command_that_still_loads(command, code):
    """What it loads is held until the signal comes."""
    held = [sys.executable, "-c", LOADS_NO_FURTHER, *command.split()]
    with subprocess.Popen(held, stdin=PIPE, stdout=PIPE, stderr=PIPE, text=True) as process:
        assert process.stdout and process.stdout.readline() == "loading\n"
        process.send_signal(signal.SIGTERM)
        said = process.stdout.read(), process.stderr.read()
        assert (*said, process.wait(SECONDS)) == ("", "", code)


def test_sigterm_ends_the_page_and_the_file_with_its_token_is_gone(tmp_path):
    places = {"HOME": str(tmp_path), "XDG_DATA_HOME": str(tmp_path), "XDG_CACHE_HOME": platformdirs.user_cache_dir()}
    process = lineseg("view", "--port", 0, env=os.environ | places | {"LINESEG_TOKEN": "secret", "BROWSER": "true"})
    assert process.stdout
    process.stdout.readline()
    assert list(tmp_path.rglob("open-*.html"))
    process.send_signal(signal.SIGTERM)
    _, err = process.communicate(timeout=SECONDS)
    assert (err, process.returncode) == ("", 0)
    assert not list(tmp_path.rglob("open-*.html"))


def test_a_node_needs_two_topics_for_two_types(run):
    code, _, error = run("node", "ws://robot:9090", "--markers", "/x", "--cloud", "/x")
    assert (code, error) == (2, "lineseg: --markers and --cloud are both /x; messages of two types need two topics\n")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("ws://",), "'ws://' is not the address of a robot; give one like ws://robot:9090"),
        (("view", "ws://robot:99999"), "not the address of a robot"),
        (("ws://robot:9090", "--keep", "0"), "--keep is 0; allowed: 1 to 20000 scans"),
        (("view", "--robot", "robot"), "'robot' is not the address of a robot"),
        (("view", "--allow-embedding", "course.example.org"), "--allow-embedding is 'course.example.org'; give scheme"),
        (("view", "--port", "99999"), "--port is 99999; give one from 1 to 65535"),
        (("view", "--port", "-1"), "--port is -1; give one from 1 to 65535"),
    ],
)
def test_an_address_that_cannot_be_is_named(run, arguments, sentence):
    code, _, error = run(*arguments, "--no-browser")
    assert code == 2
    assert sentence in error


def test_explain_says_why_a_beam_is_in_a_line_and_why_two_beams_are_in_two(run, hall):
    code, said, _ = run("explain", hall, "1", "300")
    assert (code, said.splitlines()[0]) == (0, "beam 300 has no return: its range is nan")
    code, said, _ = run("explain", hall, "1", "20", "--beside", "700")
    assert code == 0
    relation = why_apart(open_recording(hall)[1], 20, 700)
    assert said.splitlines() == [relation.text, *(change.text for change in relation.changes)]
    assert "there is no frame 7; it has 3, from 0" in run("explain", hall, "7", "20")[2]
