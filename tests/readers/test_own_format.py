"""A format is one class and its line in READERS, for files, folders and gzip files alike."""

import gzip

import numpy as np
import pytest

from lineseg import Recording, Scan, open_recording, readers
from lineseg.readers.source import Reader


class Dashes(Reader):
    """A line of ranges after two dashes; in a folder, the file `scan`."""

    format = "dashes"
    suffixes = (".dash",)
    expects = "two dashes at its beginning"

    @staticmethod
    def recognises(head):
        return head.startswith(b"--")

    @staticmethod
    def recognises_folder(folder):
        return (folder / "scan").is_file()

    @staticmethod
    def read(source):
        path = source.path / "scan" if source.path.is_dir() else source.path
        ranges = np.array(path.read_bytes()[2:].split(), float)
        return Recording.from_scans([Scan.regular(ranges, 0.0, 0.01)], name=source.name)


@pytest.fixture(autouse=True)
def known(monkeypatch):
    monkeypatch.setattr(readers, "READERS", (Dashes, *readers.READERS))


@pytest.mark.parametrize("kind", ["file", "folder", "packed"])
def test_a_custom_format_is_opened(tmp_path, kind):
    path = tmp_path / "own.dash"
    if kind == "folder":
        path.mkdir()
    content = b"-- 1.0 2.0 3.0"
    (path / "scan" if kind == "folder" else path).write_bytes(gzip.compress(content) if kind == "packed" else content)
    assert open_recording(path)[0].ranges.tolist() == [1.0, 2.0, 3.0]
