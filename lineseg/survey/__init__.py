"""A whole recording at once: every frame, over all cores, in compact arrays."""

from .result import SEGMENT, Survey
from .threads import BESIDE, cores, survey

__all__ = ["BESIDE", "SEGMENT", "Survey", "cores", "survey"]
