"""The built wheel, used from a folder that has an `app` of its own."""

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built from a copy, so that the tree stays clean."""
    folder = tmp_path_factory.mktemp("wheel")
    tracked = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split("\0")
    for name in filter(None, tracked):
        if (ROOT / name).exists():
            (folder / "source" / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / "source" / name).write_bytes((ROOT / name).read_bytes())
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "-w", str(folder)]
    subprocess.run([*command, str(folder / "source")], check=True)
    (built,) = folder.glob("lineseg-*.whl")
    return built


def run_elsewhere(wheel: Path, folder: Path, *arguments: str) -> str:
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder / "site")
    (folder / "app").mkdir()
    (folder / "app" / "__init__.py").write_text("raise ImportError('this is the application of somebody else')")
    environment = {**os.environ, "PYTHONPATH": str(folder / "site")}
    run = subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True, timeout=240
    )
    assert run.returncode == 0, run.stderr
    return run.stdout


def test_it_holds_each_module_page_and_sample_that_the_tree_holds(wheel: Path):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    for source, installed in {"lineseg": "lineseg", "app": "lineseg_app", "static": "lineseg_app/static"}.items():
        tracked = subprocess.run(["git", "ls-files", source], cwd=ROOT, capture_output=True, text=True, check=True)
        for name in tracked.stdout.split():
            assert name.replace(source, installed, 1) in names
    assert "lineseg_app/sample_scans/hallway.npz" in names
    assert not [name for name in names if name.split("/")[0] == "app"]


def test_it_extracts_beside_an_app_of_somebody_else(wheel: Path, tmp_path: Path):
    sample = ROOT / "sample_scans" / "lessons" / "1_perfect_corner.npz"
    out = tmp_path / "lines.jsonl"
    run_elsewhere(wheel, tmp_path, "-m", "lineseg_app", "extract", str(sample), "-o", str(out))
    assert len(json.loads(out.read_text())["segments"]) == 2


def test_it_finds_its_page_and_its_samples(wheel: Path, tmp_path: Path):
    code = (
        "from lineseg_app.places import data_folder\n"
        "print(*data_folder('static').iterdir(), *data_folder('sample_scans').iterdir())"
    )
    found = run_elsewhere(wheel, tmp_path, "-c", code)
    assert "index.html" in found
    assert "hallway.npz" in found
    assert str(tmp_path / "site") in found
