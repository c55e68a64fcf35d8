"""The nearest value of each threshold that would change the answer for one beam, found by running the method."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arguments import need_scan, need_thresholds
from .extractors import EXTRACTORS
from .knobs import Knob, Thresholds
from .scan import Scan
from .segment import Extraction

# Widest step of the search, as a share of the range of a knob. A change that reverts within one step is missed.
WIDEST = 1 / 24


@dataclass(frozen=True)
class WhatIf:
    """The nearest value of a threshold that changes the answer for a beam; None if no value in its range does.

    segment: the beam's segment at this value; first, last: the beams of that segment; −1 for none.
    """

    name: str
    value: int | float | None
    segment: int
    first: int
    last: int
    text: str


def what_if(
    scan: Scan, beam: int, params: Thresholds | None = None, method: str = "region-growing"
) -> tuple[WhatIf, ...]:
    """For each threshold, changed alone, the nearest value at which `beam` is in a line or in none, or in another line.

    Two segments are the same line if the intersection over union of their beams is more than one half. Only values that
    the slider can take are tried, and distances are measured on its scale, linear or logarithmic. The search moves
    outward from the present value in growing steps, then bisects the step that changed the answer.
    Raises ValueError for a beam outside the scan.
    """
    need_scan(scan)
    if not 0 <= beam < len(scan):
        raise ValueError(f"beam {beam}: the scan has the beams 0 to {len(scan) - 1}")
    extractor = EXTRACTORS[method]
    params = extractor.params_type() if params is None else params
    need_thresholds(params, extractor.params_type)
    now = extractor.extract(scan, params)
    line = _line_of(beam, now)

    def find(name: str, kind: type, knob: Knob) -> WhatIf:
        def run(value: int | float) -> Extraction:
            return extractor.extract(scan, params.but(**{name: value}))

        value = nearest(getattr(params, name), kind, knob, lambda value: not _same(line, _line_of(beam, run(value))))
        return _unchanged(beam, name, knob) if value is None else _changed(beam, name, knob, value, run(value), now)

    return tuple(find(*each) if scan.valid[beam] else _unchanged(beam, each[0], each[2]) for each in params.knobs())


def nearest(value: float, kind: type, knob: Knob, differs: Callable[[int | float], bool]) -> int | float | None:
    """The nearest different value of the knob, or None."""
    place = math.log if knob.log else float
    knob = knob.reaching(value)
    settable = knob.step * np.arange(round(knob.low / knob.step), round(knob.high / knob.step) + 1)
    settable = settable[(settable >= knob.least) & ((settable > 0) | (not knob.log))]
    widest = WIDEST * (place(knob.high) - place(knob.low))
    best, reach = None, math.inf
    for side in (settable[settable > value + 1e-9], settable[settable < value - 1e-9][::-1]):
        ladder = [kind(round(each, 9)) for each in side.tolist()]
        apart = np.array([abs(place(each) - place(value)) for each in ladder])
        apart = apart[apart < reach]
        found = first_change(apart, widest, lambda k, ladder=ladder: differs(ladder[k]))
        if found is not None:
            best, reach = ladder[found], float(apart[found])
    return best


def first_change(apart: NDArray[np.float64], widest: float, differs: Callable[[int], bool]) -> int | None:
    """The first index with another answer, assuming at most one change per step; apart: (n,) rising distances."""
    same, here, step = -1, 0, apart[0] if len(apart) else 0.0
    while same + 1 < len(apart):
        if differs(here):
            while here - same > 1:
                between = (same + here) // 2
                same, here = (same, between) if differs(between) else (between, here)
            return here
        step = min(2 * step, widest)
        same, here = here, min(max(here + 1, int(np.searchsorted(apart, apart[here] + step))), len(apart) - 1)
    return None


def _changed(beam: int, name: str, knob: Knob, value: int | float, found: Extraction, now: Extraction) -> WhatIf:
    at = f"with {knob.told(value)} beam {beam} would be in"
    segment, before = int(found.labels[beam]), int(now.labels[beam])
    if segment < 0:
        return WhatIf(name, value, -1, -1, -1, f"{at} no line")
    line = found.segments[segment]
    instead = f" instead of beams {now.segments[before].first}–{now.segments[before].last}" if before >= 0 else ""
    return WhatIf(
        name, value, segment, line.first, line.last, f"{at} a line of beams {line.first}–{line.last}{instead}"
    )


def _unchanged(beam: int, name: str, knob: Knob) -> WhatIf:
    unit = f" {knob.unit}" if knob.unit else ""
    text = f"no {knob.symbol} from {knob.low:g} to {knob.high:g}{unit} changes the answer for beam {beam}"
    return WhatIf(name, None, -1, -1, -1, text)


def _line_of(beam: int, extraction: Extraction) -> NDArray[np.bool_]:
    """(n,) the beams of the beam's segment; none if it is in no segment."""
    segment = extraction.labels[beam]
    return (extraction.labels == segment) & (segment >= 0)


def _same(one: NDArray[np.bool_], other: NDArray[np.bool_]) -> bool:
    together = int(np.count_nonzero(one | other))
    return together == 0 or 2 * int(np.count_nonzero(one & other)) > together
