"""Scores without truth: how doubtful the extraction of a frame is, judged from the frame and its neighbours."""

from .scores import SCORES, Score

__all__ = ["SCORES", "Score"]
