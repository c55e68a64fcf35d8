"""The decisions of region growing and their checks, as numbers for the rows of a `Log`."""

from __future__ import annotations

from ..params import Params
from ..tracing.vocabulary import Check

SEED_REJECTED, SEED_FOUND, POINT_ADDED, GROWTH_STOPPED, LINE_KEPT, LINE_DROPPED = range(6)
LINES_MERGED, LINES_KEPT_APART, OVERLAP_CUT, ENDPOINTS = range(6, 10)

# Every threshold that can refuse is a check; its sentence is in its declaration.
CHECKS = (
    Check(""),
    Check("end", "{edge}, {span}"),
    Check("nearer", "it lies {value:m} from its first shared point, the line that overlaps it {limit:m}"),
    *(Check(name, knob.refuses) for name, _, knob in Params.knobs() if knob.refuses),
)


def number_of(check: str) -> int:
    """The index in CHECKS."""
    return [each.name for each in CHECKS].index(check)


NONE, END, NEARER = range(3)
DELTA, EPSILON, MIN_POINTS = number_of("delta"), number_of("epsilon"), number_of("min_points")
MIN_LENGTH, MERGE_ANGLE = number_of("min_length"), number_of("merge_angle")
