"""Scores against the truth."""

from .lines import SHORT, UNKNOWN, demands_of, near_lines, true_ends, true_lines
from .matching import Agreement, Matching, agreement, agreements, match, quality

__all__ = [
    "SHORT",
    "UNKNOWN",
    "Agreement",
    "Matching",
    "agreement",
    "agreements",
    "demands_of",
    "match",
    "near_lines",
    "quality",
    "true_ends",
    "true_lines",
]
