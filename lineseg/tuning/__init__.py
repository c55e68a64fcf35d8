"""Search for thresholds that fit recordings: objective, split, study."""

from .objective import Objective
from .parts import FileBlocks, RecordingBlocks
from .study import Trial, Tuning, Verdict

__all__ = ["FileBlocks", "Objective", "RecordingBlocks", "Trial", "Tuning", "Verdict"]
