"""The files and commands that CONTRIBUTING and README name exist."""

import re
from pathlib import Path

import pytest

from lineseg.readers import READERS

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


@pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.format)
def test_the_readme_lists_each_format_that_is_read(reader):
    readme = (ROOT / "README.md").read_text().split("## Formats")[1]
    listed = next(row for row in readme.splitlines() if row.startswith("| ROS")).split(" | ")[0].lower()
    named = all(word in listed for word in reader.format.lower().split())
    assert named or any(re.search(rf"\{suffix}\b|\b{suffix[1:]}\b", listed) for suffix in reader.suffixes)
