"""The result of a survey: segments and scores of all frames, in compact arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..doubt import SCORES
from ..knobs import Thresholds

# The fields of `Segment`; the rows of a frame are in the order of its `Extraction`.
SEGMENT = np.dtype(
    [
        *((name, np.float64) for name in ("a", "b", "c", "x1", "y1", "x2", "y2", "length", "rms")),
        *((name, np.int32) for name in ("first", "last", "points")),
    ],
    align=True,
)


@dataclass(frozen=True, eq=False)
class Survey:
    """The segments and scores of every frame of a recording.

    segments: array of SEGMENT, frame after frame; offsets: (frames + 1,) where the segments of each frame start.
    scores: (frames, len(SCORES)) float32, a column for each score; None if they were not requested. A score that needs
    several surveys is NaN, see `stability`.
    """

    params: Thresholds
    segments: NDArray[np.void]
    offsets: NDArray[np.int64]
    scores: NDArray[np.float32] | None

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, frame: int) -> NDArray[np.void]:
        """The segments of one frame."""
        if not -len(self) <= frame < len(self):
            raise IndexError(f"frame {frame}: the survey has the frames 0 to {len(self) - 1}")
        frame %= len(self)
        return self.segments[self.offsets[frame] : self.offsets[frame + 1]]

    def score(self, name: str) -> NDArray[np.float32]:
        """(frames,) one of SCORES, by name, for every frame."""
        if name not in SCORES:
            raise ValueError(f"there is no score {name!r}; choose from {', '.join(SCORES)}")
        return self.need_scores()[:, list(SCORES).index(name)]

    def need_scores(self) -> NDArray[np.float32]:
        """(frames, len(SCORES)). Raises ValueError for a survey without scores."""
        if self.scores is None:
            raise ValueError("this survey has no scores; call survey with scores=True")
        return self.scores


def joined(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """A copy of the segments; copying field by field would take ten times as long."""
    return np.concatenate([np.empty(0, np.uint8), *(part.view(np.uint8) for part in parts)]).view(SEGMENT)
