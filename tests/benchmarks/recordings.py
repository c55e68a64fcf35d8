"""The recordings with truth that benchmarks are run on."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from lineseg import Recording, open_recording
from lineseg.simulate.worlds import WORLDS

ROOT = Path(__file__).parents[2]


def recordings(files: list[str]) -> Iterator[Recording]:
    """The samples, the simulated worlds, the real rooms beside LINESEG_DATA, and these files.

    Of a file without truth, it is that by many views.
    """
    for name in ("hallway", "laboratory"):
        yield open_recording(ROOT / "sample_scans" / f"{name}.npz")
    for name, drive in WORLDS.items():
        yield drive.recording(name)
    data = os.environ.get("LINESEG_DATA")
    rooms = sorted((Path(data).parent / "truth").glob("*.npz")) if data else []
    for file in (*rooms, *map(Path, files)):
        yield open_recording(file, walls="by-views")
