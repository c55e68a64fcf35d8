"""The files and commands that CONTRIBUTING and README name exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ROOMS = ("lineseg", "app", "static", "tests", "sample_scans", ".ci")


@pytest.mark.parametrize("page", ["CONTRIBUTING.md", "README.md"])
def test_each_path_that_is_named_is_there(page: str):
    named = re.findall(r"(?<![\w./-])((?:\.ci|[a-z_]+)/[\w./-]*\w/?)", (ROOT / page).read_text())
    paths = {path for path in named if path.split("/")[0] in ROOMS}
    assert paths
    assert [path for path in sorted(paths) if not (ROOT / path).exists()] == []


def test_each_target_of_make_that_is_named_is_there():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    assert set(re.findall(r"`?make ([a-z]+)", (ROOT / "CONTRIBUTING.md").read_text())) <= targets
