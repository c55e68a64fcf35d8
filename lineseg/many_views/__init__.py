"""A truth that nobody had to label: walls that many scans with poses agree on."""

from .finding import ManyViews, truth_by_many_views

__all__ = ["ManyViews", "truth_by_many_views"]
