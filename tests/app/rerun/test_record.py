"""What is recorded for rerun, read back with rerun's own SDK."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rerun as rr
from lineseg_app.__main__ import main
from lineseg_app.rerun.record import Run, notable, save
from lineseg_app.scene.replay import foot, is_line
from rerun.chunk import RrdReader
from rrd import rows_of
from waiting import SECONDS

import lineseg
import lineseg.rerun
from lineseg import EXTRACTORS, Params, Recording, extract, open_recording, survey, trace
from lineseg.installation import install_command

SAMPLE = Path(__file__).parents[3] / "sample_scans" / "hallway.npz"


@pytest.fixture(scope="module")
def hallway() -> Recording:
    return open_recording(SAMPLE)


@pytest.fixture(scope="module")
def recorded(hallway: Recording, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Frames 10 to 39 under ε = 0.02."""
    file = tmp_path_factory.mktemp("rerun") / "run.rrd"
    save(Run(hallway, "hallway", "region-growing", Params(epsilon=0.02), range(10, 40)), file)
    return file


def test_every_frame_has_the_segments_that_extract_finds(recorded: Path, hallway: Recording):
    rows = rows_of(recorded, "/laser/segments")
    framed = [row for row in rows if row.get("frame") is not None]
    assert [row["frame"] for row in framed] == list(range(10, 40))
    for row in framed:
        found = extract(hallway[row["frame"]], Params(epsilon=0.02)).segments
        ends = np.array([[(*segment.start, 0), (*segment.end, 0)] for segment in found], dtype=np.float32)
        np.testing.assert_array_equal(np.array(row["strips"], dtype=np.float32).reshape(-1, 2, 3), ends)


def test_every_valid_point_is_there_in_the_class_of_its_segment(recorded: Path, hallway: Recording):
    row = next(row for row in rows_of(recorded, "/laser/points") if row.get("frame") == 12)
    scan = hallway[12]
    found = extract(scan, Params(epsilon=0.02))
    np.testing.assert_array_equal(np.array(row["positions"])[:, :2], scan.xy[scan.valid].astype(np.float32))
    classes, labels = np.array(row["class_ids"]), found.labels[scan.valid]
    assert ((classes == 0) == (labels < 0)).all()
    assert all(len(set(classes[labels == label])) == 1 for label in range(len(found.segments)))


def test_scores_decisions_dropped_candidates_and_truth_are_logged_at_their_frames(recorded: Path, hallway: Recording):
    counts = {row["frame"]: row["scalars"] for row in rows_of(recorded, "/scores/segments")}
    assert counts == {frame: [len(extract(hallway[frame], Params(epsilon=0.02)).segments)] for frame in range(10, 40)}
    said = [row["text"][0] for row in rows_of(recorded, "/decisions") if row["frame"] == 11]
    traced = trace(hallway[11], Params(epsilon=0.02))
    assert said == [traced[index].text for index in notable(traced)]
    dropped = {row["frame"]: row["strips"] for row in rows_of(recorded, "/laser/dropped") if "frame" in row}
    assert len(dropped[11] or []) == len(extract(hallway[11], Params(epsilon=0.02)).dropped)
    assert len(next(row for row in rows_of(recorded, "/laser/truth") if row.get("frame") == 11)["strips"]) > 3


def test_scores_are_those_of_the_whole_recording_though_only_its_neighbourhood_is_surveyed(
    recorded: Path, hallway: Recording
):
    whole = survey(hallway, Params(epsilon=0.02))
    for name in ("change", "brief", "gone", "jump", "misses"):
        values = [row["scalars"][0] for row in rows_of(recorded, f"/scores/{name}")]
        np.testing.assert_array_equal(np.array(values, np.float32), whole.score(name)[10:40])


@pytest.mark.parametrize("method", [name for name in EXTRACTORS if name != "region-growing"])
def test_other_methods_are_recorded_like_region_growing(method: str, hallway: Recording, tmp_path: Path):
    file, params = tmp_path / "run.rrd", EXTRACTORS[method].params_type()
    save(Run(hallway, "hallway", method, params, range(7, 9), steps=True), file)
    found = [EXTRACTORS[method].trace(hallway[frame], params) for frame in (7, 8)]
    segments = [row["strips"] or [] for row in rows_of(file, "/laser/segments") if row.get("frame") is not None]
    assert [len(strips) for strips in segments] == [len(each.extraction.segments) for each in found]
    assert [row["text"][0] for row in rows_of(file, "/decisions")] == [each.text for one in found for each in one]
    counted = [row["scalars"][0] for row in rows_of(file, "/scores/segments")]
    assert counted == [len(each.extraction.segments) for each in found]


def test_the_thresholds_and_the_version_are_properties_of_the_recording(recorded: Path):
    properties: dict[str, Any] = {}
    for row in rows_of(recorded, "/__properties/lineseg"):
        properties |= row
    assert properties["epsilon"] == [0.02]
    assert properties["method"] == ["region-growing"]
    assert properties["frames"] == ["10:40"]
    assert RrdReader(recorded).blueprints()


def test_steps_are_a_timeline_of_all_decisions_that_ends_each_frame_in_its_segments(hallway: Recording, tmp_path: Path):
    file = tmp_path / "steps.rrd"
    save(Run(hallway, "hallway", "region-growing", Params(), range(2), steps=True), file)
    traces = [trace(hallway[frame]) for frame in range(2)]
    decisions = rows_of(file, "/decisions")
    assert [row["step"] for row in decisions] == list(range(sum(map(len, traces))))
    assert [row["text"][0] for row in decisions] == [each.text for one in traces for each in one]
    assert decisions[len(traces[0])]["frame"] == 1
    standing = [row for row in rows_of(file, "/laser/replay/lines") if row.get("step") is not None]
    last = max((row for row in standing if row["step"] < len(traces[0])), key=lambda row: row["step"])
    assert len(last["strips"]) == len(traces[0].extraction.segments)


def test_a_step_shows_the_line_beside_its_window_and_the_point_decided_on(hallway: Recording, tmp_path: Path):
    file = tmp_path / "steps.rrd"
    save(Run(hallway, "hallway", "region-growing", Params(), range(5, 6), steps=True), file)
    xy = hallway[5].xy
    lines, points = (
        {row["step"]: row for row in rows_of(file, f"/laser/replay/{name}") if row.get("step") is not None}
        for name in ("line", "beam")
    )
    for decision in trace(hallway[5]):
        window = xy[[decision.first, decision.last]]
        feet = [foot(window, decision.line)] if is_line(decision.line) else []
        shown = np.array(lines[decision.index]["strips"], dtype=float).reshape(-1, 2, 3)
        np.testing.assert_allclose(shown[..., :2], np.reshape(feet, (-1, 2, 2)), atol=1e-5)
        point = np.array(points[decision.index]["positions"], dtype=float).reshape(-1, 3)
        np.testing.assert_allclose(point[:, :2], xy[[decision.beam] if decision.beam >= 0 else []], atol=1e-5)


def test_a_recording_is_little_larger_than_the_arrays_in_it(recorded: Path, hallway: Recording):
    """The arrays in their smallest form: x, y and class of points, ends and class of segments, scores, and texts."""
    raw = 0
    for frame in range(10, 40):
        found = trace(hallway[frame], Params(epsilon=0.02))
        segments, dropped = len(found.extraction.segments), len(found.extraction.dropped)
        texts = sum(len(found[index].text.encode()) for index in notable(found))
        walls = len(hallway.walls) if hallway.walls is not None else 0
        raw += 10 * int(hallway[frame].valid.sum()) + 18 * segments + 16 * (dropped + walls) + 8 * 8 + texts
    fixed = 130_000  # classes, properties, layout, and a head for each entity, however long the recording
    assert recorded.stat().st_size < 1.2 * raw + fixed


def test_the_command_line_writes_the_frames_it_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    file = tmp_path / "run.rrd"
    assert main(["record", str(SAMPLE), "-o", str(file), "--frames", "3:6", "--min-length", "1"]) == 0
    framed = [row["frame"] for row in rows_of(file, "/laser/segments") if row.get("frame") is not None]
    assert framed == [3, 4, 5]
    assert list(tmp_path.iterdir()) == [file]
    for frames, complaint in [("nine", "give FIRST:STOP"), ("9000:", "which is empty")]:
        assert main(["record", str(SAMPLE), "-o", str(file), "--frames", frames]) == 2
        assert complaint in capsys.readouterr().err
    assert main(["record", str(SAMPLE), "-o", str(tmp_path / "run.bag")]) == 2
    assert "use a name that ends in .rrd" in capsys.readouterr().err
    assert main(["record", str(SAMPLE), "-o", str(file), "--method", "magic"]) == 2
    assert "there is no method 'magic'" in capsys.readouterr().err


def test_a_stopped_recording_leaves_the_existing_file(hallway: Recording, tmp_path: Path):
    file = tmp_path / "run.rrd"
    file.write_text("as it was")

    def stop(done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save(Run(hallway, "hallway", "region-growing", Params(), range(5)), file, stop)
    assert file.read_text() == "as it was"
    assert list(tmp_path.iterdir()) == [file]


def test_the_example_of_the_module_runs_and_logs_each_frame(tmp_path: Path):
    assert lineseg.rerun.__doc__ is not None
    example = textwrap.dedent(lineseg.rerun.__doc__.partition("\n\n")[2].partition("\n\nEverything")[0])
    script = example.replace("sample_scans/hallway.npz", SAMPLE.as_posix()).replace(", spawn=True", "")
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, timeout=SECONDS)
    assert done.returncode == 0, done.stderr
    rows = rows_of(tmp_path / "run.rrd", "/laser/segments")
    assert [row["frame"] for row in rows] == list(range(len(open_recording(SAMPLE))))


def test_one_line_adds_a_frame_to_your_own_recording(hallway: Recording, tmp_path: Path):
    stream = rr.RecordingStream("my_robot")
    stream.save(tmp_path / "own.rrd")
    lineseg.rerun.log("robot/laser", extract(hallway[0]), hallway[0], stream)
    stream.disconnect()
    (row,) = rows_of(tmp_path / "own.rrd", "/robot/laser/segments")
    assert len(row["strips"]) == len(row["colors"]) == len(extract(hallway[0]).segments)
    assert len(rows_of(tmp_path / "own.rrd", "/robot/laser/points")[0]["positions"]) == hallway[0].valid.sum()


WITHOUT_RERUN = """
import sys
sys.modules["rerun"] = None
from lineseg_app.__main__ import main
import lineseg, lineseg_app.server
print(lineseg.extract(lineseg.open_recording(sys.argv[1])[0]).covered > 0)
print(main(["extract", sys.argv[1], "-o", "segments.jsonl"]), main(["record", sys.argv[1], "-o", "run.rrd"]))
"""


def test_without_rerun_everything_else_works_and_a_sentence_says_what_to_install(tmp_path: Path):
    command = [sys.executable, "-c", WITHOUT_RERUN, str(SAMPLE)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=SECONDS)
    assert done.stdout.split() == ["True", "0", "2"], done.stderr
    assert done.stderr.strip() == f"lineseg: rerun is not installed; `{install_command('rerun')}` installs it"
    assert [file.name for file in tmp_path.iterdir()] == ["segments.jsonl"]


def test_rerun_is_imported_only_when_it_is_used():
    script = "import sys, lineseg, lineseg_app.server, lineseg_app.commands; print('rerun' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=SECONDS)
    assert done.stdout.strip() == "False", done.stderr


THREADS = """
import os, sys
from pathlib import Path
from lineseg import Params, open_recording
from lineseg_app.rerun.record import Run, save
from waiting import eventually
hallway, file = open_recording(sys.argv[1]), Path(sys.argv[2])
threads = lambda: os.listdir("/proc/self/task")
counts = []
for _ in range(4):
    save(Run(hallway, "hallway", "region-growing", Params(), range(2)), file)
    counts.append(len(threads()))
# Ended threads take a moment to go.
eventually(lambda: len(threads()) <= counts[0], f"threads to end, which were {counts}", threads)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux lists the threads of a process")
def test_recording_leaves_no_thread(tmp_path: Path):
    """In a process of its own, where nothing else starts threads."""
    command = [sys.executable, "-c", THREADS, str(SAMPLE), str(tmp_path / "run.rrd")]
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_rows_have_the_numbers_of_the_file_if_frames_are_left_out(tmp_path: Path):
    file = Path(__file__).parents[3] / "sample_scans" / "hallway.npz"
    part, out = open_recording(file, frames="5:20", every_scan=5), tmp_path / "part.rrd"
    save(Run(part, "hallway", "region-growing", Params(), range(3)), out)
    assert [row["frame"] for row in rows_of(out, "/scores/segments")] == [5, 10, 15]
