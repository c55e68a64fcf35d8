"""A recording of any length."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from lineseg_app.places import data_folder

from lineseg import Recording, open_recording


def long_hallway(frames: int, seed: int = 0, every: int = 1) -> Recording:
    """The hallway again and again, each time a little different. every: of so many beams, one is taken."""
    hallway = open_recording(data_folder("sample_scans") / "hallway.npz")
    rng = np.random.default_rng(seed)
    which = np.arange(frames) % len(hallway)
    ranges = hallway.ranges.reshape(len(hallway), -1)[which, ::every]
    stretched = ranges * (1 + 0.002 * rng.standard_normal((frames, 1), dtype=np.float32))
    noisy = stretched + 0.003 * rng.standard_normal(ranges.shape, dtype=np.float32)
    return replace(
        hallway,
        name="long",
        ranges=noisy.astype(np.float32).ravel(),
        offsets=ranges.shape[1] * np.arange(frames + 1),
        angle_min=hallway.angle_min[which],
        angle_increment=every * hallway.angle_increment[which],
        range_min=hallway.range_min[which],
        range_max=hallway.range_max[which],
        stamps=0.1 * np.arange(frames),
        frame_ids=("laser",) * frames,
        wall=None,
        track=None,
        walls=None,
    )
