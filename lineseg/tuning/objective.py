"""The objective that auto-tuning maximises, with a description for people."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..sweep.totals import Totals

LABEL_FREE_RMS = 0.03


@dataclass(frozen=True)
class Objective:
    """A number in [0, 1] from the totals of some frames, higher is better; NaN if undefined.

    kind: "truth" compares with true lines, "label-free" uses only the scans.
    recall: for "truth", the weight of TR relative to 1 − FR (β of F_β); 1 gives their harmonic mean.
    completeness: for "truth", the exponent of the completeness; 0 ignores it.
    rms: for "label-free", the mean of the largest rms [m] at which the score is halved.
    """

    kind: Literal["truth", "label-free"] = "truth"
    recall: float = 1.0
    completeness: float = 1.0
    rms: float = LABEL_FREE_RMS

    def __post_init__(self) -> None:
        if self.kind not in ("truth", "label-free"):
            raise ValueError(f"there is no objective {self.kind!r}; choose from truth, label-free")
        for name, least in (("recall", 1e-3), ("completeness", 0.0), ("rms", 1e-6)):
            if not least <= getattr(self, name) <= 1e3:
                raise ValueError(f"{name} is {getattr(self, name):g}; allowed: {least:g} to 1000")

    def score(self, totals: Totals) -> float:
        """The objective for the totals of one setting."""
        if self.kind == "label-free":
            return self._label_free(totals)
        return self.of_rates(*(float(totals.measure(name)) for name in ("true_rate", "false_rate", "completeness")))

    def of_rates(self, found: float, false: float, completeness: float) -> float:
        """The objective with truth, from TR, FR and completeness."""
        right = 1.0 - false
        if not np.isfinite(right):
            # Without segments nothing is found and nothing is false.
            return 0.0 if np.isfinite(found) else np.nan
        if found == 0.0 or right == 0.0:
            return 0.0
        beta = self.recall**2
        harmonic = (1 + beta) * found * right / (beta * right + found)
        return harmonic * completeness**self.completeness

    def _label_free(self, totals: Totals) -> float:
        segments = float(totals.measure("segments"))
        if segments == 0.0:
            return 0.0
        doubtful = float(totals.measure("splits")) + float(totals.measure("misses"))
        whole = segments / (segments + doubtful)
        steady = 1.0 - float(totals.measure("change"))
        tight = 1.0 / (1.0 + (float(totals.measure("rms")) / self.rms) ** 2)
        return float(totals.measure("coverage")) * whole * steady * tight

    @property
    def thresholds(self) -> tuple[str, ...]:
        """The thresholds worth tuning. P_min and L_min say which lines you want, which no label-free score can know."""
        quality = ("epsilon", "delta", "seed_points")
        return (*quality, "min_points", "min_length") if self.kind == "truth" else quality

    @property
    def text(self) -> str:
        """One sentence that describes the objective."""
        if self.kind == "truth":
            harmonic = "the harmonic mean" if self.recall == 1 else f"the mean F_β (β = {self.recall:g})"
            power = "" if self.completeness == 1 else f" to the power {self.completeness:g}"
            times = "" if self.completeness == 0 else f", times completeness{power}"
            return (
                f"Maximises {harmonic} of TR and 1 − FR against the true lines{times}. True lines always use the "
                "paper's P_min and L_min."
            )
        return (
            "Maximises coverage × share of segments neither split nor missed × steadiness from frame to frame × "
            f"1 / (1 + (largest rms / {self.rms:g} m)²)."
        )

    @property
    def caution(self) -> str:
        """When the objective is misleading."""
        if self.kind == "truth":
            return "The result is only as good as the truth: anything it lacks, such as furniture, counts as false."
        return (
            "Without truth, this rewards results that look tidy. It misleads if short lines can cover clutter, "
            "if the laser moves fast (which lowers steadiness), or if the noise is far from the given rms. Look at "
            "some frames before you use the result."
        )
