"""The samples that come with the project open in every format."""

from lineseg_app.places import data_folder

from lineseg.readers import open_recording


def test_every_sample_opens_and_shows_something():
    suffixes = {".npz", ".log", ".csv", ".mcap", ".db3", ".bag", ".gz"}
    files = [path for path in data_folder("sample_scans").rglob("*") if path.suffix in suffixes]
    formats = {open_recording(path).format for path in files}
    assert {"NPZ", "CARMEN log", "text"} < formats
    for path in files:
        recording = open_recording(path)
        assert all(scan.valid.mean() > 0.5 for scan in recording), path
