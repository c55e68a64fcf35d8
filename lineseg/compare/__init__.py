"""Compares all methods on the same frames: tuned on one half, judged on the other, timed in alternation."""

from .comparison import Comparison, Row
from .halves import Halves, halves
from .tables import TABLE_WRITERS

__all__ = ["TABLE_WRITERS", "Comparison", "Halves", "Row", "halves"]
