"""Each example runs unchanged and prints something."""

import runpy
from collections.abc import Iterator
from pathlib import Path

import pytest

from lineseg import EXTRACTORS, readers

ROOT = Path(__file__).parents[1]
EXAMPLES = sorted((ROOT / "lineseg" / "examples").glob("[0-9]*.py"))


@pytest.fixture(autouse=True)
def tables_as_before() -> Iterator[None]:
    """Examples add to the tables of methods and readers."""
    methods, known = dict(EXTRACTORS), readers.READERS
    yield
    EXTRACTORS.clear()
    EXTRACTORS.update(methods)
    readers.READERS = known


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.stem)
def test_an_example_runs_and_is_short(example: Path, tmp_path: Path, monkeypatch, capsys):
    (tmp_path / "sample_scans").symlink_to(ROOT / "sample_scans")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", [str(example)])
    runpy.run_path(str(example), run_name="__main__")
    assert 1 <= len(capsys.readouterr().out.splitlines()) <= 20
    assert len(example.read_text().splitlines()) < 40


def test_examples_are_numbered_without_a_gap():
    assert [int(example.stem[:2]) for example in EXAMPLES] == list(range(1, len(EXAMPLES) + 1))
    assert len(EXAMPLES) == 8
