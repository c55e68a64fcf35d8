"""Extraction from every frame of a recording, on all cores, into compact arrays."""

from .result import SEGMENT, Survey
from .threads import BESIDE, cores, survey

__all__ = ["BESIDE", "SEGMENT", "Survey", "cores", "survey"]
