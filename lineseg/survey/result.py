"""What a survey gives back: the segments and the scores of all frames, in compact arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..doubt import SCORES
from ..knobs import Thresholds

# The fields are those of `Segment`; a frame's rows stand in the order of its `Extraction`.
SEGMENT = np.dtype(
    [
        *((name, np.float64) for name in ("a", "b", "c", "x1", "y1", "x2", "y2", "length")),
        ("rms", np.float32),
        *((name, np.int32) for name in ("first", "last", "points")),
    ]
)


@dataclass(frozen=True, eq=False)
class Survey:
    """What a method finds in every frame of a recording.

    segments: of SEGMENT, frame after frame; offsets: (frames + 1,) where the segments of each frame begin.
    scores: (frames, len(SCORES)) float32, a column for each of SCORES; None where they were not asked for. What takes
    many surveys is NaN, see `stability`.
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
            raise IndexError(f"frame {frame} of a survey of {len(self)} frames")
        frame %= len(self)
        return self.segments[self.offsets[frame] : self.offsets[frame + 1]]

    def score(self, name: str) -> NDArray[np.float32]:
        """(frames,) one score of every frame; the names are those of SCORES."""
        if name not in SCORES:
            raise ValueError(f"there is no score {name!r}; there are {', '.join(SCORES)}")
        if self.scores is None:
            raise ValueError("this survey was made without scores")
        return self.scores[:, list(SCORES).index(name)]


def joined(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """A new array of the same segments; copied field by field it would take ten times as long."""
    return np.concatenate([np.empty(0, np.uint8), *(part.view(np.uint8) for part in parts)]).view(SEGMENT)
