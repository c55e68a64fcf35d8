"""Search for thresholds that fit recordings: objective, judge, split, study."""

from .judge import judge_of
from .objective import Objective
from .parts import FileBlocks, RecordingBlocks
from .study import Gain, Trial, Tuning, Verdict

__all__ = ["FileBlocks", "Gain", "Objective", "RecordingBlocks", "Trial", "Tuning", "Verdict", "judge_of"]
