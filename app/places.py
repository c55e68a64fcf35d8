"""Where the page and the samples are: next to `app/` in a working copy, inside `lineseg_app` in a wheel."""

from __future__ import annotations

from pathlib import Path

import platformdirs


def data_folder(name: str) -> Path:
    """The folder `name` ("static" or "sample_scans") of this installation."""
    here = Path(__file__).resolve().parent
    for place in (here / name, here.parent / name):
        if place.is_dir():
            return place
    raise FileNotFoundError(
        f"{name} is neither in {here} nor in {here.parent}; this installation is damaged, install again"
    )


def user_folder(chosen: Path | None = None) -> Path:
    """The folder for user data: the chosen one, or the system's default."""
    return chosen or Path(platformdirs.user_data_dir("lineseg", appauthor=False))
