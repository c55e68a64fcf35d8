from __future__ import annotations

import gzip
import json
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from lineseg import Scan

Printed = list[list[float]]


@pytest.fixture
def printed(reference_dir: Path) -> Callable[[str, str], Iterator[tuple[Scan, Printed]]]:
    """Each scan of a reference recording, with the x1, y1, x2, y2, first, last that a program printed for it."""

    def frames(name: str, program: str) -> Iterator[tuple[Scan, Printed]]:
        with np.load(reference_dir / f"{name}.npz", allow_pickle=False) as archive:
            recording = {key: archive[key] for key in archive.files}
        angles = float(recording["angle_min"]), float(recording["angle_increment"])
        with gzip.open(reference_dir / f"{name}.{program}.jsonl.gz", "rt") as lines:
            for ranges, line in zip(recording["ranges"], lines, strict=True):
                yield Scan.regular(ranges, *angles, range_max=float(recording["range_max"])), json.loads(line)

    return frames
