from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from lineseg_app.routes import heard
from lineseg_app.server import Settings
from live import Address, Page, page_of, serving
from scenes import corner, wall_ahead
from waiting import SECONDS

from lineseg import Recording
from lineseg.readers import save_npz


@pytest.fixture(autouse=True)
def patient_server(monkeypatch: pytest.MonkeyPatch) -> None:
    """A test may open a page and speak with it later, after another has waited for its first picture."""
    monkeypatch.setattr(heard, "FIRST_SECONDS", SECONDS)


@pytest.fixture(scope="session")
def recordings(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with `walls.npz`, five frames of a wall that comes nearer, and `corner.npz`, two frames."""
    folder = tmp_path_factory.mktemp("recordings")
    walls = [wall_ahead(4.0 - frame / 2, 10.0, noise=0.005, seed=frame, stamp=float(frame)) for frame in range(5)]
    save_npz(Recording.from_scans(walls, name="walls"), folder / "walls.npz")
    corners = [corner(noise=0.005, seed=frame) for frame in range(2)]
    save_npz(Recording.from_scans(corners, name="corner"), folder / "corner.npz")
    return folder


@pytest.fixture(scope="session")
def server(recordings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Address]:
    """A server that was given two files on the command line; tests that need other settings start their own."""
    files = (recordings / "walls.npz", recordings / "corner.npz")
    with serving(Settings(files=files, data_folder=tmp_path_factory.mktemp("data"), upload_limit=1_000_000)) as address:
        yield address


@pytest.fixture
def page(server: Address) -> Iterator[Page]:
    with page_of(server) as page:
        yield page
