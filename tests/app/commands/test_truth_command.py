"""`lineseg truth`: a recording with the walls that its scans agree on, and what it says of them."""

import json
from pathlib import Path

import pytest
from lineseg_app.__main__ import main

from lineseg import open_recording

SAMPLES = Path(__file__).parents[3] / "sample_scans"


def test_the_file_has_walls_and_can_be_scored(tmp_path, capsys):
    out = tmp_path / "walls.npz"
    assert main(["truth", str(SAMPLES / "hallway.log"), "-o", str(out), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["explained"] > 0.7
    found = open_recording(out)
    assert found.wall is not None
    assert found.walls is not None
    assert found.wall.max() == len(found.walls) - 1
    assert found.wall.min() == -2
    assert main(["score", str(out)]) == 0
    assert "true rate" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("file", "out", "sentence"),
    [
        ("hallway.csv", "walls.npz", "has no poses"),
        ("hallway.log", "walls.csv", "use a name that ends in .npz"),
        ("hallway.log", "missing/walls.npz", "does not exist"),
    ],
)
def test_what_cannot_be_done_gets_a_sentence(tmp_path, capsys, file, out, sentence):
    assert main(["truth", str(SAMPLES / file), "-o", str(tmp_path / out)]) == 2
    assert sentence in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
