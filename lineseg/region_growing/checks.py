"""What is decided in region growing, and by which checks; numbers for the rows of a `Log`."""

from __future__ import annotations

SEED_REJECTED, SEED_FOUND, POINT_ADDED, GROWTH_STOPPED, LINE_KEPT, LINE_DROPPED = range(6)
LINES_MERGED, LINES_KEPT_APART, OVERLAP_CUT, ENDPOINTS = range(6, 10)
NONE, DELTA, EPSILON, MAX_DROPOUT, MAX_GAP, END, MIN_POINTS, MIN_LENGTH, MERGE_ANGLE, NEARER, MERGE_RMS = range(11)
CHECKS = (
    "",
    "delta",
    "epsilon",
    "max_dropout",
    "max_gap",
    "end",
    "min_points",
    "min_length",
    "merge_angle",
    "nearer",
    "merge_rms",
)
