"""Proposes thresholds that fit a laser, from its scans alone.

The noise of the recording bounds ε from both sides. Between these bounds the search looks for steadiness. If ε is too
small, walls break at noisy points, and a larger ε gives other lines. If it is too large, a wall takes in what stands
before it, and again a larger ε gives other lines. In between, the lines stay the same. So the lines at ε are scored
as if the lines at a larger ε were the truth. The best ε is proposed; among nearly equal ones, what the noise suggests.
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
# The factor from one value of ε to the next; lines are compared APART values apart.
STEP, APART = 1.6**0.25, 2
# Bounds of ε: this many times the white noise, and this many times the total scatter.
LOWEST, HIGHEST = 2.5, 4.2
# The choice from noise alone: this many times the white noise, and so many times the deviation of walls from straight.
# Clutter looks like the latter where the noise is large, so that it counts only beyond SURE times the white noise.
WHITE, ROUGH, SURE = 2.8, 3.5, 1.5
# At a value that differs from this choice by a factor of e, lines must be so much steadier.
PULL = 0.15
# Agreement with the lines at a smaller and a larger ε that the present values may lack before others are proposed.
AS_GOOD = 0.005
# Below the first ε [m] walls break, however good the laser: plaster, skirting boards and doors are no straighter. For
# such a laser the second is usual, and the third is tried at least.
LEAST_EPSILON, FINE_EPSILON, TRIED_EPSILON = 0.02, 0.025, 0.04
# The growing part of the noise counts if it is this many times as large at the farthest points as the constant part of
# the scatter: an ε that grows where noise does not makes walls swallow doors.
COUNTS = 0.7
# Above this ε [m], walls and what stands before them become one line.
MOST_EPSILON = 0.5


@dataclass(frozen=True, eq=False)
class Proposal:
    """Thresholds that fit a recording, or why there are none.

    params: the proposed ones, or the present ones if these are as good or if nothing can be proposed. changed: whether
    they differ. fitting: those that fit best, also if the present ones are as good; None if nothing can be proposed.
    scatter: standard deviation of points from their walls [m]. pieces: number of segments into which a wall breaks at
    the present values, on average. tried: (k,) values of ε, or of the method's counterpart [m]; steady: (k,) score of
    the lines there, with the lines at 1.26 times that value as the truth, 0 to 1.
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
    known: RangeNoise | None = None,
) -> Proposal:
    """Thresholds of a method that fit this laser, compared with the present ones.

    Only thresholds that depend on the noise change (see `Knob.scatter`), and none that is 0, which means "off". ε grows
    with the range if the noise does, but less steeply (`Knob.growth`), which keeps far doors apart from their walls.
    known: the noise of the recording, if it has been estimated before. Raises Cancelled as soon as `wanted` returns
    False.
    """
    extractor = EXTRACTORS[method]
    present, found = params if params is not None else extractor.params_type(), known or noise(recording)
    search = _Search(recording, found, present, extractor.extract)
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
    following = ((name, knob) for name, _, knob in params.knobs() if knob.scatter or knob.growth)
    return params.but(
        **{name: float(np.clip(factor * getattr(params, name), knob.least, knob.most)) for name, knob in following}
    )


def _rounded(value: float) -> float:
    """Rounded to two digits; more would suggest false precision."""
    return float(f"{value:.2g}")


class _Search:
    """One method on some scans of a recording, at a series of values of ε."""

    def __init__(
        self, recording: Recording, known: RangeNoise, present: Thresholds, extract: Callable[[Scan, Any], Extraction]
    ) -> None:
        self.noise, self.present, self._extract = known, present, extract
        frames = np.flatnonzero(np.diff(recording.offsets) > 0)
        spread = np.linspace(0, len(frames) - 1, min(len(frames), FRAMES)).round().astype(int) if len(frames) else []
        self._scans = [scan for scan in (recording[int(frames[k])] for k in spread) if scan.valid.any()]
        self._lines: list[list[Extraction]] = []
        ranges = np.concatenate([scan.ranges[scan.valid] for scan in self._scans]) if self._scans else np.empty(0)
        self._middle, far = np.percentile(ranges, (50, 95)).tolist() if len(ranges) else (math.nan, math.nan)
        self._white = float(self.noise.at(self._middle))
        self.scatter = math.hypot(self._white, self.noise.roughness)
        constant = math.hypot(self.noise.base, self.noise.roughness)
        self._growth = self.noise.growth if self.noise.growth * far >= COUNTS * constant else 0.0
        self.scales = np.empty(0)
        if math.isfinite(self._white) and self._white > 0:
            lowest = max(LOWEST * self._white, LEAST_EPSILON)
            highest = max(HIGHEST * self.scatter, TRIED_EPSILON)
            steps = math.floor(math.log(highest / lowest) / math.log(STEP))
            self.scales = lowest * STEP ** np.arange(-APART, max(steps, APART) + 1 + APART)

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
        """The present thresholds for an ε of `scale` [m] at the median range; it grows only if the noise does."""
        params, rises = self.present, {}
        for name, _, knob in params.knobs():
            if knob.growth and getattr(params, name):
                rise = knob.growth * scale * self._growth / self.scatter
                scale = math.sqrt(scale**2 - (rise * self._middle) ** 2)
                rises[name] = min(max(_rounded(rise), getattr(type(params)(), name)), knob.most) if rise else 0.0
        return scaled(params, scale).but(**rises)

    def try_scale(self, scale: float) -> None:
        self._lines.append(self._extracted(self.fitting(scale)))

    def nothing(self, why: str) -> Proposal:
        return Proposal(self.present, False, None, self.noise, self.scatter, math.nan, np.empty(0), np.empty(0), why)

    def judged(self) -> Proposal:
        places = range(APART, len(self.scales) - APART)
        tried = self.scales[APART:-APART]
        steady = np.array([self._agrees(self._lines[k], k + APART) for k in places])
        if not steady.max() > 0.0:
            return self.nothing("No ε that fits this noise gives steady lines.")
        sure = math.sqrt(max(self.noise.roughness**2 - (SURE * self._white) ** 2, 0.0))
        usual = max(math.hypot(WHITE * self._white, ROUGH * sure), FINE_EPSILON)
        best = int(np.argmax(steady - PULL * np.abs(np.log(tried / usual))))
        if tried[best] > MOST_EPSILON:
            return self.nothing(
                f"Points scatter by {1e3 * self.scatter:.0f} mm here. That is too much: lines would have to take in "
                f"points more than {MOST_EPSILON:g} m away."
            )
        # Half-way to the next value: the lines are as steady from this one on.
        proposed = self.fitting(tried[best] * math.sqrt(STEP))
        found, present = self._extracted(proposed), self._extracted(self.present)
        around = (places[best] - APART, places[best] + APART)
        lacking = np.mean([self._agrees(found, k) - self._agrees(present, k) for k in around])
        pieces = _pieces(present, found)
        answer = replace(self.nothing(""), fitting=proposed, pieces=pieces, tried=tried, steady=steady)
        if lacking <= AS_GOOD:
            return answer
        return replace(answer, params=proposed, changed=True, text=self._text(proposed, pieces))

    def _extracted(self, params: Thresholds) -> list[Extraction]:
        return [self._extract(scan, params) for scan in self._scans]

    def _agrees(self, found: list[Extraction], k: int) -> float:
        """Agreement of lines with those at one of the scales."""
        return _agreement(found, self._lines[k])

    def _text(self, proposed: Thresholds, pieces: float) -> str:
        name, knob = _leading(proposed)
        value, before = getattr(proposed, name), getattr(self.present, name)
        told = f"Points scatter by {1e3 * self.scatter:.0f} mm here."
        if value > before and pieces >= 1.1:
            broken = f"at {before:g} a wall breaks into {pieces:.1f} pieces on average"
            return f"{told} {knob.symbol} = {value:g} fits; {broken}."
        if abs(math.log(value / before)) > APART * math.log(STEP):
            return f"{told} {knob.symbol} = {value:g} fits better than {before:g}."
        new = [f"{knob.symbol} = {value:g}" for knob, value in _changes(self.present, proposed)]
        return f"{told} {', '.join(new)} {'fits' if len(new) == 1 else 'fit'} a little better than the present values."


def _changes(present: Thresholds, proposed: Thresholds) -> list[tuple[Knob, float]]:
    """The thresholds that are proposed anew, with their values."""
    values = ((name, knob, getattr(proposed, name)) for name, _, knob in proposed.knobs())
    return [(knob, value) for name, knob, value in values if value != getattr(present, name)]


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
