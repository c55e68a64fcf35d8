"""The setting whose lines stand in for the truth where nobody knows it.

The noise of a recording says which ε fits it (`proposal`), and a setting is scored against the lines at this ε, as it
would be against the truth. Two random settings have the same order by both in 97.9 % of the pairs, and in 99.5 % of
those whose true scores differ by more than 0.02 (mean over all sets with truth, by `tests/benchmarks/label_free.py`).
Lines at a smaller and a larger ε as further judges agree with the truth less often, because their errors count too.
"""

from __future__ import annotations

from ..knobs import Thresholds
from ..params import Params
from ..proposal import propose
from ..scan import Recording
from ..truth import demands_of


def judge_of(recording: Recording, demands: Thresholds | None = None) -> Params:
    """The setting of region growing that fits this laser.

    demands: thresholds with the P_min and L_min of the lines you want; default: the paper's. Raises ValueError that
    says why if nothing fits.
    """
    found = propose(recording, Params() if demands is None else demands_of(demands))
    if not isinstance(found.fitting, Params):
        raise ValueError(f"{recording.name or 'this recording'} cannot be judged without truth. {found.text}")
    return found.fitting
