"""Words for how long scans take to arrive, and from there until their segments are published."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..live.source import Spent


def latency(spent: Sequence[Spent]) -> str:
    """Medians, and what 95 % stay within: "delay 0.4 ms, published in 0.9 ms (95 %: 1.6 ms)"."""
    delays = [each.delay for each in spent if each.delay is not None]
    middle, most = np.percentile([each.publishing for each in spent], (50, 95))
    delay = f"delay {_ms(float(np.median(delays)))}, " if delays else ""
    return f"{delay}published in {_ms(middle)} (95 %: {_ms(most)})"


def _ms(seconds: float) -> str:
    return f"{1e3 * seconds:.{1 if abs(seconds) < 0.1 else 0}f} ms"
