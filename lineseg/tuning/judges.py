"""Settings whose lines stand in for the truth where nobody knows it.

The noise of a recording says which ε fits it (`proposal`). Lines that a smaller and a larger ε also find are beyond
doubt. So a setting is scored against the lines of all three, as it would be against the truth. Two random settings
have the same order by both in 96 % of the pairs, and in 98 % of those whose true scores differ by more than 0.02 (mean
over all sets with truth, by `tests/benchmarks/label_free.py`).
"""

from __future__ import annotations

from ..knobs import Thresholds
from ..params import Params
from ..scan import Recording
from ..truth import demands_of
from .proposal import propose, rescaled

# The judges' thresholds, as multiples of those that fit: a step of steadiness to either side.
SPREAD = (1 / 1.6, 1.0, 1.6)


def judges(recording: Recording, demands: Thresholds | None = None) -> tuple[Params, ...]:
    """Three settings of region growing around the one that fits this laser.

    demands: thresholds with the P_min and L_min of the lines you want; default: the paper's. Raises ValueError that
    says why if nothing fits.
    """
    found = propose(recording, Params() if demands is None else demands_of(demands))
    if not isinstance(found.fitting, Params):
        raise ValueError(f"{recording.name or 'this recording'} cannot be judged without truth. {found.text}")
    return tuple(rescaled(found.fitting, factor) for factor in SPREAD)
