"""The objective that auto-tuning maximises, with a description for people."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..sweep.totals import Totals
from ..truth import quality


@dataclass(frozen=True)
class Objective:
    """A number in [0, 1] from the totals of some frames, higher is better; NaN if undefined.

    kind: "truth" compares with true lines; "label-free" with lines that fit the noise of the laser, see `judge_of`.
    recall: the weight of TR relative to 1 − FR (β of F_β); 1 gives their harmonic mean.
    completeness: its exponent; 0 ignores it.
    """

    kind: Literal["truth", "label-free"] = "truth"
    recall: float = 1.0
    completeness: float = 1.0

    def __post_init__(self) -> None:
        if self.kind not in ("truth", "label-free"):
            raise ValueError(f"there is no objective {self.kind!r}; choose from truth, label-free")
        for name, least in (("recall", 1e-3), ("completeness", 0.0)):
            if not least <= getattr(self, name) <= 1e3:
                raise ValueError(f"{name} is {getattr(self, name):g}; allowed: {least:g} to 1000")

    def score(self, totals: Totals) -> float:
        """The objective for the totals of one setting."""
        return self.of_rates(*(float(totals.measure(name)) for name in ("true_rate", "false_rate", "completeness")))

    def of_rates(self, found: float, false: float, completeness: float) -> float:
        """The objective from TR, FR and completeness."""
        return quality(found, false, completeness, self.recall, self.completeness)

    @property
    def thresholds(self) -> tuple[str, ...]:
        """The thresholds worth tuning. P_min and L_min say which lines you want, which no label-free score can know."""
        quality = ("epsilon", "delta", "seed_points")
        return (*quality, "min_points", "min_length") if self.kind == "truth" else quality

    @property
    def text(self) -> str:
        """One sentence that describes the objective."""
        harmonic = "the harmonic mean" if self.recall == 1 else f"the mean F_β (β = {self.recall:g})"
        power = "" if self.completeness == 1 else f" to the power {self.completeness:g}"
        times = "" if self.completeness == 0 else f", times completeness{power}"
        if self.kind == "truth":
            return (
                f"Maximises {harmonic} of TR and 1 − FR against the true lines{times}. True lines always use the "
                "paper's P_min and L_min."
            )
        return (
            f"Maximises {harmonic} of TR and 1 − FR{times}, against lines that fit the noise of this laser instead of "
            "true lines: those of region growing at the ε that fits."
        )

    @property
    def caution(self) -> str:
        """When the objective is misleading."""
        if self.kind == "truth":
            return "The result is only as good as the truth: anything it lacks, such as furniture, counts as false."
        return (
            "Without truth, this finds thresholds that fit the noise of the laser. It cannot know which lines you "
            "want, so leave P_min and L_min out. Look at some frames before you use the result."
        )
