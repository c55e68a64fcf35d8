"""Combines scores into one: in how many lines a frame is probably wrong.

By default that is what the committee disputes (`lineseg/survey/committee.py`), and more where a frame has no line
before walls, lacks what its neighbours have, was knocked farther aside than the robot turns, or lost beams. Scores that
move with the robot, or are normal for a place, have the weight 0: they do not follow the truth
(`tests/benchmarks/suspicion.py`).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from .scores import COLUMN, SCORES

# A tenth of normally distributed numbers lie more than this many standard deviations above the median.
TENTH = 1.2816
# Cap on the doubt of one score, so that no single score decides.
MOST_DOUBT = 6.0
# Each frame is compared with this many frames around it, itself included.
AROUND = 11

WEIGHTS = {name: score.weight for name, score in SCORES.items()}


def doubts(scores: NDArray[np.floating]) -> NDArray[np.float64]:
    """(frames, len(SCORES)) how doubtful each frame is by each score; unknown scores give 0.

    A score that `counts` lines is itself the doubt. For the others it is from 0 to MOST_DOUBT, the mean of two numbers:
    how far the score stands out from the whole recording, and from the AROUND frames around it. Each is
    min(max((d − least) / spread, 0), MOST_DOUBT), where d is how much worse the score is than the median of the
    recording or of the frames around, `least` the smallest difference of this score that matters, and
    spread = max(the d that a tenth of all frames exceed / 1.2816, least). A jolt is first lessened by the turn that a
    tenth of all frames exceed.
    """
    scores = np.nan_to_num(np.asarray(scores, np.float64))
    if not len(scores):
        return np.zeros(scores.shape)
    # A robot that turns far between scans also turns back: only what exceeds that is a knock.
    scores[:, COLUMN.jolt] = np.maximum(scores[:, COLUMN.jolt] - np.quantile(scores[:, COLUMN.turn], 0.9), 0.0)
    signs = np.array([1.0 if score.worse == "higher" else -1.0 for score in SCORES.values()])
    worse = signs * scores
    outstanding = 0.5 * (_standing_out(worse - np.median(worse, axis=0)) + _standing_out(worse - _around(worse)))
    return np.where([score.counts for score in SCORES.values()], np.maximum(worse, 0.0), outstanding)


def _standing_out(by: NDArray[np.float64]) -> NDArray[np.float64]:
    least = np.array([score.least for score in SCORES.values()])
    spread = np.maximum(np.quantile(by, 0.9, axis=0) / TENTH, least)
    return np.clip((by - least) / spread, 0.0, MOST_DOUBT)


def _around(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """The median of the AROUND frames around each frame; near the ends, of the first or last AROUND frames."""
    width = min(AROUND, len(values))
    medians = np.median(sliding_window_view(values, width, axis=0), axis=-1)
    return medians[np.clip(np.arange(len(values)) - width // 2, 0, len(medians) - 1)]


def suspicion(scores: NDArray[np.floating], weights: Mapping[str, float] = WEIGHTS) -> NDArray[np.float64]:
    """(frames,) Σ weight·doubt over the scores (frames, len(SCORES)): in lines, if "disputed" has the weight 1.

    weights: by name of score; a score without a weight or without a known value does not count.
    """
    for name in weights:
        if name not in SCORES:
            raise ValueError(f"there is no score {name!r}; choose from {', '.join(SCORES)}")
    by_score = np.array([float(weights.get(name, 0.0)) for name in SCORES])
    if (by_score < 0).any() or not np.isfinite(by_score).all():
        raise ValueError("a weight must be a number ≥ 0")
    return doubts(scores) @ by_score


def worst_first(scores: NDArray[np.floating], weights: Mapping[str, float] = WEIGHTS) -> NDArray[np.intp]:
    """(frames,) the frames from most to least suspicious; ties in order of time."""
    return np.argsort(-suspicion(scores, weights), kind="stable")
