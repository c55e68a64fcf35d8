"""Proposes thresholds that fit a laser, from its scans alone.

The noise of the recording bounds ε from both sides. Between these bounds the search looks for steadiness. If ε is too
small, walls break at noisy points, and a larger ε gives other lines. If it is too large, a wall takes in what stands
before it, and again a larger ε gives other lines. In between, the lines stay the same. So the lines at ε are scored
as if the lines at 1.6 ε were the truth. The best ε is proposed; among nearly equal ones, what the noise suggests.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from ..extractors import EXTRACTORS
from ..knobs import Knob, Thresholds
from ..noise import RangeNoise, noise
from ..readers import Cancelled
from ..scan import Floats, Recording, Scan
from ..segment import Extraction
from ..truth import Agreement, match
from .objective import Objective

T = TypeVar("T", bound=Thresholds)
TRUTH = Objective("truth")
FRAMES = 24
LEAST_FRAMES = 4
# Factor from one value to the next; lines are compared two steps apart.
STEP = 1.6**0.5
# Bounds of ε: this many times the white noise, and this many times the total scatter.
LOWEST, HIGHEST = 2.5, 4.5
# The choice from noise alone, as a multiple of √(white noise · total scatter); and how much steadier the lines must be
# at a value that differs from it by a factor of e.
USUAL, PULL = 3.2, 0.1
# Steadiness that the present values may lack before others are proposed; the second if they are within one step of
# these, where lines differ by chance.
AS_GOOD, AS_GOOD_NEARBY = 0.01, 0.05
# Below this ε [m] walls break, however good the laser: plaster, skirting boards and doors are no straighter.
LEAST_EPSILON = 0.02
# The threshold by which ε grows with the range, and how many times as large as the constant part of the scatter its
# growing part must be at the farthest points to count: an ε that grows where noise does not makes walls swallow doors.
GROWTH, COUNTS = "epsilon_growth", 0.7
# Above this ε [m], walls and what stands before them become one line.
MOST_EPSILON = 0.5


@dataclass(frozen=True, eq=False)
class Proposal:
    """Thresholds that fit a recording, or why there are none.

    params: the proposed ones, or the present ones if these are as good or if nothing can be proposed. changed: whether
    they differ. fitting: those that fit best, also if the present ones are as good; None if nothing can be proposed.
    scatter: standard deviation of points from their walls [m]. pieces: number of segments into which a wall breaks at
    the present values, on average. tried: (k,) values of ε, or of the method's counterpart [m]; steady: (k,) score of
    the lines there, with the lines at 1.6 times that value as the truth, 0 to 1.
    text: what is proposed, or why nothing can be; "" if the present values are as good.
    """

    params: Thresholds
    changed: bool
    fitting: Thresholds | None
    noise: RangeNoise
    scatter: float
    pieces: float
    tried: Floats
    steady: Floats
    text: str


def propose(
    recording: Recording,
    params: Thresholds | None = None,
    method: str = "region-growing",
    wanted: Callable[[], bool] = lambda: True,
) -> Proposal:
    """Thresholds of a method that fit this laser, compared with the present ones.

    Only thresholds that depend on the noise change (see `Knob.scatter`), and none that is 0, which means "off". ε stops
    growing with the range if the noise does not.
    Raises Cancelled as soon as `wanted` returns False.
    """
    extractor = EXTRACTORS[method]
    search = _Search(recording, params if params is not None else extractor.params_type(), extractor.extract)
    why = search.why_not()
    if why:
        return search.nothing(why)
    for scale in search.scales:
        if not wanted():
            raise Cancelled
        search.try_scale(scale)
    return search.judged()


def scaled(params: Thresholds, scale: float) -> Thresholds:
    """`params` with every threshold that depends on the noise set for an ε of `scale` [m]."""
    values = {}
    for name, _, knob in params.knobs():
        if knob.scatter and getattr(params, name):
            values[name] = float(np.clip(_rounded(knob.scatter * scale), knob.least, knob.most))
    return params.but(**values)


def rescaled(params: T, factor: float) -> T:
    """`params` with every threshold that depends on the noise multiplied by a factor."""
    following = ((name, knob) for name, _, knob in params.knobs() if knob.scatter or name == GROWTH)
    return params.but(
        **{name: float(np.clip(factor * getattr(params, name), knob.least, knob.most)) for name, knob in following}
    )


def _rounded(value: float) -> float:
    """Rounded to two digits; more would suggest false precision."""
    return float(f"{value:.2g}")


class _Search:
    """One method on some scans of a recording, at a series of values of ε."""

    def __init__(self, recording: Recording, present: Thresholds, extract: Callable[[Scan, Any], Extraction]) -> None:
        self.present, self._extract = present, extract
        self.noise = noise(recording)
        frames = np.flatnonzero(np.diff(recording.offsets) > 0)
        spread = np.linspace(0, len(frames) - 1, min(len(frames), FRAMES)).round().astype(int) if len(frames) else []
        self._scans = [scan for scan in (recording[int(frames[k])] for k in spread) if scan.valid.any()]
        self._lines: list[list[Extraction]] = []
        ranges = np.concatenate([scan.ranges[scan.valid] for scan in self._scans]) if self._scans else np.empty(0)
        self._white = float(self.noise.at(float(np.median(ranges)))) if len(ranges) else math.nan
        self.scatter = math.hypot(self._white, self.noise.roughness)
        self._far = float(np.percentile(ranges, 95)) if len(ranges) else math.nan
        self.scales = np.empty(0)
        if math.isfinite(self._white) and self._white > 0:
            lowest = max(LOWEST * self._white, LEAST_EPSILON)
            steps = math.floor(math.log(HIGHEST * self.scatter / lowest) / math.log(STEP))
            self.scales = lowest * STEP ** np.arange(max(steps, 0) + 3)

    def why_not(self) -> str:
        """Why nothing can be proposed, in a sentence; "" if something can."""
        if scaled(self.present, 1.0) == self.present:
            return "This method has no threshold that depends on the noise of the laser."
        if len(self._scans) < LEAST_FRAMES:
            few = len(self._scans)
            have = "has" if few == 1 else "have"
            return f"Estimating noise needs at least {LEAST_FRAMES} scans with a return; {few} {have} one."
        if not len(self.scales):
            return "No straight wall was found, so the noise of the laser is unknown."
        return ""

    def fitting(self, scale: float) -> Thresholds:
        """The present thresholds for an ε of `scale` [m]; it grows with the range only if the noise does."""
        params, constant = scaled(self.present, scale), math.hypot(self.noise.base, self.noise.roughness)
        if self.noise.growth * self._far < COUNTS * constant and params.numbers().get(GROWTH):
            return params.but(**{GROWTH: 0.0})
        return params

    def try_scale(self, scale: float) -> None:
        params = self.fitting(scale)
        self._lines.append([self._extract(scan, params) for scan in self._scans])

    def nothing(self, why: str) -> Proposal:
        return Proposal(self.present, False, None, self.noise, self.scatter, math.nan, np.empty(0), np.empty(0), why)

    def judged(self) -> Proposal:
        count = len(self.scales) - 2
        steady = np.array([_agreement(self._lines[k], self._lines[k + 2]) for k in range(count)])
        if not steady.max() > 0.0:
            return self.nothing("No ε that fits this noise gives steady lines.")
        usual = USUAL * math.sqrt(self._white * self.scatter)
        best = int(np.argmax(steady - PULL * np.abs(np.log(self.scales[:count] / usual))))
        if self.scales[best] > MOST_EPSILON:
            return self.nothing(
                f"Points scatter by {1e3 * self.scatter:.0f} mm here. That is too much: lines would have to take in "
                f"points more than {MOST_EPSILON:g} m away."
            )
        proposed, judges = self.fitting(self.scales[best]), self._lines[best + 1]
        present = [self._extract(scan, self.present) for scan in self._scans]
        lacking = _agreement(self._lines[best], judges) - _agreement(present, judges)
        pieces = _pieces(present, self._lines[best])
        found = replace(self.nothing(""), fitting=proposed, pieces=pieces, tried=self.scales[:count], steady=steady)
        name, _ = _leading(proposed)
        apart = abs(math.log(getattr(proposed, name) / getattr(self.present, name)))
        if lacking <= (AS_GOOD if apart > math.log(STEP) else AS_GOOD_NEARBY):
            return found
        return replace(found, params=proposed, changed=True, text=self._text(proposed, pieces))

    def _text(self, proposed: Thresholds, pieces: float) -> str:
        name, knob = _leading(proposed)
        value, before = getattr(proposed, name), getattr(self.present, name)
        told = f"Points scatter by {1e3 * self.scatter:.0f} mm here. {knob.symbol} = {value:g} fits"
        if value > before and pieces >= 1.1:
            return f"{told}; at {before:g} a wall breaks into {pieces:.1f} pieces on average."
        return f"{told} better than {before:g}."


def _leading(params: Thresholds) -> tuple[str, Knob]:
    """The first threshold that depends on the noise, which stands for all of them in a sentence."""
    return next((name, knob) for name, _, knob in params.knobs() if knob.scatter and getattr(params, name))


def _agreement(found: list[Extraction], judges: list[Extraction]) -> float:
    """Agreement of lines with other lines as the truth: the harmonic mean of TR and 1 − FR, times completeness."""
    total = Agreement.of_all(match(one, other.labels).agreement for one, other in zip(found, judges, strict=True))
    score = TRUTH.of_rates(total.true_rate, total.false_rate, total.completeness)
    return score if math.isfinite(score) else 0.0


def _pieces(present: list[Extraction], walls: list[Extraction]) -> float:
    """Mean number of segments on a wall, over the walls that have any; NaN if none has."""
    counts = []
    for one, other in zip(present, walls, strict=True):
        matching = match(one, other.labels)
        counts.append((2 * matching.shared > matching.segment_beams).sum(axis=1))
    numbers = np.concatenate(counts)
    return float(numbers[numbers > 0].mean()) if (numbers > 0).any() else math.nan
