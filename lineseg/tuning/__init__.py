"""Search for thresholds that fit recordings: objective, judges, split, study."""

from .judges import judges
from .objective import Objective
from .parts import FileBlocks, RecordingBlocks
from .study import Gain, Trial, Tuning, Verdict

__all__ = ["FileBlocks", "Gain", "Objective", "RecordingBlocks", "Trial", "Tuning", "Verdict", "judges"]
