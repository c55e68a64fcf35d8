"""Numbers for formats without NaN and infinity, such as JSON."""

from __future__ import annotations

import math


def finite_or_none(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
