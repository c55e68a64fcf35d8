"""When the frames of a recording were taken, if its stamps can be believed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording
from lineseg.readers.plausible import trouble_of


@dataclass(frozen=True, eq=False)
class Clock:
    """since: (frames,) time since the first scan of the file [s], None if stamps cannot be believed; trouble: why."""

    since: NDArray[np.float64] | None
    trouble: str = ""

    @classmethod
    def of(cls, recording: Recording) -> Self:
        account, stamps = recording.account, recording.stamps
        trouble = (account.stamp_trouble if account is not None else "") or trouble_of(stamps)
        if trouble:
            return cls(None, trouble)
        began = stamps[0] if recording.began is None else recording.began
        return cls(np.asarray(stamps - began, np.float64))

    def at(self, frame: int) -> float | None:
        """Time since the first scan [s] of the scan at this position."""
        return None if self.since is None else float(self.since[frame])
