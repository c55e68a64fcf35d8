"""The built wheel, installed in its own environment and used from a folder that contains another `app`."""

import json
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import venv
import zipfile
from pathlib import Path

import httpx
import pytest
from waiting import SECONDS

ROOT = Path(__file__).parents[1]
pytestmark = pytest.mark.server
PLACES = {"lineseg": "lineseg", "app": "lineseg_app", "static": "lineseg_app/static"}


def tracked(*folders: str) -> list[str]:
    command = ["git", "ls-files", "-z", *folders]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")
    return [name for name in listed if name and (ROOT / name).exists()]


@pytest.fixture(scope="module")
def dist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the sdist and the wheel that is built from it; made from a copy, so that the tree stays clean."""
    folder = tmp_path_factory.mktemp("dist")
    for name in tracked():
        (folder / "source" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "source" / name).write_bytes((ROOT / name).read_bytes())
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(folder / "source")]
    subprocess.run(command, check=True, capture_output=True)
    return folder


@pytest.fixture(scope="module")
def wheel(dist: Path) -> Path:
    (built,) = dist.glob("laser_lineseg-*.whl")
    return built


@pytest.fixture(scope="module")
def environment(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A virtual environment with only the wheel; its dependencies come from the running environment."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, symlinks=True)
    pip = [sys.executable, "-m", "pip", "--python", str(folder / "bin" / "python"), "install", "--quiet", "--no-deps"]
    subprocess.run([*pip, "--no-index", str(wheel)], check=True)
    borrowed = [path for path in sys.path if path.endswith("-packages")]
    packages = Path(sysconfig.get_path("purelib", vars={"base": str(folder)}))
    (packages / "borrowed.pth").write_text("\n".join(borrowed))
    return folder


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A folder with the `app` of another project."""
    (tmp_path / "app").mkdir()
    (tmp_path / "app" / "__init__.py").write_text("raise ImportError('this is the application of somebody else')")
    return tmp_path


def run(environment: Path, folder: Path, *arguments: str) -> str:
    done = subprocess.run(
        [environment / "bin" / arguments[0], *arguments[1:]],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=SECONDS,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_wheel_holds_every_module_page_and_sample_of_the_tree(wheel: Path):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    for source, installed in PLACES.items():
        for name in tracked(source):
            assert name.replace(source, installed, 1) in names
    assert "lineseg_app/sample_scans/hallway.npz" in names
    assert not [name for name in names if name.split("/")[0] == "app"]


def test_the_source_archive_holds_what_is_needed_to_build_and_to_test_it(dist: Path):
    (archive,) = dist.glob("laser_lineseg-*.tar.gz")
    with tarfile.open(archive) as opened:
        names = {name.partition("/")[2] for name in opened.getnames()}
    missing = set(tracked(*PLACES, "sample_scans", "tests", "pyproject.toml", "Makefile", "LICENSE")) - names
    assert missing == set()


def test_type_checkers_are_told_that_both_packages_have_types(wheel: Path):
    with zipfile.ZipFile(wheel) as archive:
        assert {"lineseg/py.typed", "lineseg_app/py.typed"} <= set(archive.namelist())


def test_the_wheel_extracts_beside_an_app_of_another_project(environment: Path, elsewhere: Path):
    sample = ROOT / "sample_scans" / "lessons" / "1_perfect_corner.npz"
    out = elsewhere / "lines.jsonl"
    run(environment, elsewhere, "python", "-m", "lineseg_app", "extract", str(sample), "-o", str(out))
    assert len(json.loads(out.read_text())["segments"]) == 2


def test_the_wheel_finds_its_page_and_its_samples(environment: Path, elsewhere: Path):
    code = (
        "from lineseg_app.places import data_folder\n"
        "print(*data_folder('static').iterdir(), *data_folder('sample_scans').iterdir())"
    )
    found = run(environment, elsewhere, "python", "-c", code)
    assert "index.html" in found
    assert "hallway.npz" in found
    assert str(environment) in found


def test_the_command_of_the_wheel_shows_the_page(environment: Path, elsewhere: Path):
    command = [environment / "bin" / "lineseg", "view", "--no-browser", "--port", "0"]
    surroundings = {**os.environ, "XDG_DATA_HOME": str(elsewhere)}
    with subprocess.Popen(command, cwd=elsewhere, env=surroundings, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            (address,) = re.findall(r"http://\S+/", server.stdout.readline())
            page = httpx.get(address, trust_env=False, timeout=SECONDS).raise_for_status().text
            modules = re.findall(r'<script type="module" src="([^"]+)"', page)
            assert modules
            for module in modules:
                script = httpx.get(httpx.URL(address).join(module), trust_env=False, timeout=SECONDS).raise_for_status()
                assert script.headers["content-type"].startswith("text/javascript")
        finally:
            server.terminate()


def test_the_wheel_tells_its_version(environment: Path, elsewhere: Path, wheel: Path):
    assert run(environment, elsewhere, "lineseg", "--version") == f"lineseg {wheel.name.split('-')[1]}\n"
