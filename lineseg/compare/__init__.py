"""Every method on the same frames: tuned alike on one half, reported on the other, timed in turns."""

from .comparison import Comparison, Row
from .halves import Halves, halves
from .tables import TABLE_WRITERS

__all__ = ["TABLE_WRITERS", "Comparison", "Halves", "Row", "halves"]
