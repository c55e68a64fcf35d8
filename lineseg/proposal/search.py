"""The search for the ε that fits.

If ε is too small, walls break wherever a point deviates more, and the points of what is left deviate by all that ε
allows. If it is large enough, they deviate by what they do anyway, which is the smaller a share of ε the larger ε is.
So the smallest ε at which the lines of region growing scatter by no more than a third of it suits the noise of the
laser and walls that bend, without a model of either.

From there the search looks for steadiness. Where walls still break, as those do that are rough in some places only, a
larger ε gives other lines, so the lines at ε are scored as if those at a larger ε were the truth: whole, and cut where
they step aside, because there they may have taken in a door. Points of the wall hardly raise the scatter of a line,
points of what stands before the wall do. So a larger ε is proposed if lines gain more steadiness than scatter.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..extractors import EXTRACTORS
from ..knobs import Knob, Thresholds
from ..noise import RangeNoise, noise
from ..params import Params
from ..readers import Cancelled
from ..scan import Floats, Recording, Scan
from ..segment import Extraction
from ..truth import Agreement, demands_of, match, quality
from .steps import cut_at_steps

T = TypeVar("T", bound=Thresholds)
# For each scan, the line that each beam belongs to, or −1.
Labels = Sequence[NDArray[np.integer]]
GROWING = EXTRACTORS["region-growing"]
FRAMES = 24
LEAST_FRAMES = 4
# The factor from one value of ε to the next; lines are compared APART values apart.
STEP, APART = 1.6**0.25, 3
# The search begins at this many times the white noise, and ends so many steps above the ε that suits the scatter.
LOWEST, STEPS = 2.7, 6
# An ε this many times as large covers what an ε that suits the walls also covers, and more.
LOOSER = 4.0
# Walls that beams graze scatter by less than others, for which ε is a little larger than what suits them all.
MORE = 1.1
# The share of ε by which points may scatter about their lines: for white noise, ε is then about three times as large.
# At a coarse laser more is allowed, because there a larger ε takes in doors: the share grows with this power of ε.
SHARE, SHARE_AT, POWER = 0.32, 0.05, 0.15
# At an ε of SHARE_AT or less, lines must be so much steadier at a value where they scatter more by a factor of e; above
# it, in proportion to the square of ε.
WORTH = 0.3
# Where more of the lines at the smallest ε step aside, as on walls of boards, steps are no sign of doors.
STEPPED = 0.2
# Walls deviate from straight by no more than this [m]: lines that scatter more have taken in something else.
BEND = 0.025
# If lines at the proposed ε deviate by this many times as much, and as many times the noise, they lie on curves.
CURVED = 2.0
# Multiples of what is proposed whose lines judge it and the present values. Values that differ by more are told.
MUCH = 1.25
BESIDE = (1 / MUCH, MUCH)
# Agreement with the lines at a smaller and a larger ε that the present values may lack before others are proposed.
AS_GOOD = 0.002
# Below this ε [m] walls break, however good the laser: plaster, skirting boards and doors are no straighter.
LEAST_EPSILON = 0.02
# The growing part of the noise counts if it is this many times as large at the farthest points as the constant part of
# the scatter: an ε that grows where noise does not makes walls swallow doors.
COUNTS = 1.0
# Above this ε [m], walls and what stands before them become one line.
MOST_EPSILON = 0.5


@dataclass(frozen=True, eq=False)
class Proposal:
    """Thresholds that fit a recording, or why there are none.

    params: the proposed ones, or the present ones if these are as good or if nothing can be proposed. changed: whether
    they differ. fitting: those that fit best, also if the present ones are as good; None if nothing can be proposed.
    scatter: standard deviation of points at the median range from a wall that faces the laser [m]; bend: the part of it
    that the noise of the ranges does not explain, because walls are not straight; NaN if unknown. pieces: number of
    segments into which a wall breaks at the present values, on average. tried: (k,) values of ε, or of the method's
    counterpart [m]; steady: (k,) score of the lines there, 0 to 1, with the lines at 1.4 times that value as the truth.
    text: what is proposed, or why nothing can be; "" if the present values are as good.
    """

    params: Thresholds
    changed: bool
    fitting: Thresholds | None
    noise: RangeNoise
    scatter: float
    bend: float
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
    search = _Search(recording, found, present, extractor.extract, wanted)
    why = search.why_not()
    return search.nothing(why) if why else search.judged()


def scaled(params: T, scale: float) -> T:
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
        self,
        recording: Recording,
        known: RangeNoise,
        present: Thresholds,
        extract: Callable[[Scan, Any], Extraction],
        wanted: Callable[[], bool],
    ) -> None:
        self.noise, self.present, self._extract, self._wanted = known, present, extract, wanted
        frames = np.flatnonzero(np.diff(recording.offsets) > 0)
        spread = np.linspace(0, len(frames) - 1, min(len(frames), FRAMES)).round().astype(int) if len(frames) else []
        self._scans = [scan for scan in (recording[int(frames[k])] for k in spread) if scan.valid.any()]
        ranges = np.concatenate([scan.ranges[scan.valid] for scan in self._scans]) if self._scans else np.empty(0)
        self._middle, self._far = np.percentile(ranges, (50, 95)).tolist() if len(ranges) else (math.nan, math.nan)
        self._white, self._growth = float(self.noise.at(self._middle)), 0.0
        self.scatter = self._white

    def why_not(self) -> str:
        """Why nothing can be proposed, in a sentence; "" if something can."""
        if scaled(self.present, 1.0) == self.present:
            return "This method has no threshold that depends on the noise of the laser."
        if len(self._scans) < LEAST_FRAMES:
            few = len(self._scans)
            have = "has" if few == 1 else "have"
            return f"Proposing thresholds needs at least {LEAST_FRAMES} scans with a return; {few} {have} one."
        if not self._white > 0:
            return "Too few points lie on straight walls, so the noise of the laser is unknown."
        return ""

    def fitting(self, scale: float, present: T) -> T:
        """The present thresholds for an ε of `scale` [m] at the median range; it grows only if the noise does."""
        rises = {}
        for name, _, knob in present.knobs():
            if knob.growth and getattr(present, name):
                rise = knob.growth * scale * self._growth / self.scatter
                scale = math.sqrt(scale**2 - (rise * self._middle) ** 2)
                rises[name] = min(max(_rounded(rise), getattr(type(present)(), name)), knob.most) if rise else 0.0
        return scaled(present, scale).but(**rises)

    def nothing(self, why: str) -> Proposal:
        nan = math.nan
        return Proposal(self.present, False, None, self.noise, self.scatter, nan, nan, np.empty(0), np.empty(0), why)

    def judged(self) -> Proposal:
        suits = self._suiting()
        if math.isnan(suits):
            return self.nothing(
                f"Points scatter by {1e3 * self.scatter:.0f} mm here. That is too much: lines would have to take in "
                f"points more than {MOST_EPSILON:g} m away."
            )
        scales = suits * STEP ** np.arange(STEPS + APART + 1)
        lines = [self._extracted(self.fitting(scale, self.present)) for scale in scales.tolist()]
        tried = scales[: STEPS + 1]
        steady = self._steadiness(lines)
        if not steady.max() > 0.0:
            return self.nothing("No ε that fits this noise gives steady lines.")
        best = self._worth(suits, np.array([_scatter(each) for each in lines[: STEPS + 1]]), steady)
        proposed = self.fitting(MORE * tried[best], self.present)
        found, present = self._extracted(proposed), self._extracted(self.present)
        bend = self._bend(found)
        if bend > CURVED * max(BEND, self._white):
            off, by_noise = 1e3 * math.hypot(self._white, bend), 1e3 * self._white
            return self.nothing(
                f"Nothing here is straight enough for lines: points lie {off:.0f} mm from them, and the noise of the "
                f"laser explains {by_noise:.0f} mm."
            )
        around = [self._extracted(rescaled(proposed, factor)) for factor in BESIDE]
        lacking = np.mean([_agreement(found, other) - _agreement(present, other) for other in map(_labels, around)])
        pieces, lost = _pieces(present, found)
        self.scatter = math.hypot(self._white, bend)
        answer = replace(self.nothing(""), fitting=proposed, bend=bend, pieces=pieces, tried=tried, steady=steady)
        if lacking <= AS_GOOD:
            return answer
        return replace(answer, params=proposed, changed=True, text=self._text(proposed, pieces, lost))

    def _steadiness(self, lines: list[list[Extraction]]) -> Floats:
        """For each value of ε that is tried, the agreement of its lines with those at a larger one, whole and cut."""
        pairs = list(zip(lines, lines[APART:], strict=False))
        whole = np.array([_agreement(found, _labels(looser)) for found, looser in pairs])
        demands = demands_of(self.present)
        if cut_at_steps(self._scans, lines[0], demands)[1] > STEPPED:
            return whole
        cut = [_agreement(found, cut_at_steps(self._scans, looser, demands)[0]) for found, looser in pairs]
        return (whole + np.array(cut)) / 2

    def _worth(self, suits: float, scatter: Floats, steady: Floats) -> int:
        """Which of the values is proposed, from the scatter of the lines there [m] and how steady they are."""
        walls = np.minimum.accumulate(scatter <= max(math.hypot(self._white, BEND), scatter[0]))
        worth = WORTH * max(suits / SHARE_AT, 1.0) ** 2
        return int(np.argmax((steady - worth * np.log(scatter / scatter[0]))[walls]))

    def _bend(self, found: list[Extraction]) -> float:
        """The rms distance of points from their lines that the noise of the ranges does not explain [m], by length."""
        beyond = lengths = 0.0
        for scan, one in zip(self._scans, found, strict=True):
            for number, line in enumerate(one.segments):
                ranges = scan.ranges[one.labels == number].astype(np.float64)
                if not len(ranges):
                    continue
                # A range that is wrong by 1 moves its point by the cosine of its incidence away from the line.
                white = self.noise.at(ranges) * np.abs(line.line[2]) / ranges
                beyond += line.length * (line.rms**2 - float(np.mean(white**2)))
                lengths += line.length
        return math.sqrt(max(beyond / lengths, 0.0)) if lengths else math.nan

    def _suiting(self) -> float:
        """The ε [m] that suits the scatter, which also tells whether ε grows with the range; NaN if it is too large."""
        suits = self._least_suiting()
        if math.isfinite(suits):
            # By what lines scatter beyond the white noise, walls bend.
            self.scatter = max(suits * _allowed(suits), self._white)
            constant = math.sqrt(self.scatter**2 - self._white**2 + self.noise.base**2)
            if self.noise.growth * self._far >= COUNTS * constant:
                self._growth = self.noise.growth
                return self._least_suiting()
        return suits

    def _least_suiting(self) -> float:
        """The smallest ε [m] at which the lines of region growing scatter by no more than they may.

        They must cover half of what lines at a much larger ε cover: where walls bend within the length of the shortest
        line, few lines are found, and these are straight. Between the values that are tried, the logarithm is
        interpolated.
        """
        demands = self.present if isinstance(self.present, Params) else demands_of(self.present)
        scale, before = max(LOWEST * self._white, LEAST_EPSILON), 0.0
        while scale <= MOST_EPSILON:
            params = self.fitting(scale, demands)
            found = self._extracted_by(GROWING.extract, params)
            over = math.log(max(_share(found, params), 1e-9) / _allowed(scale))
            if over <= 0.0:
                looser = self._extracted_by(GROWING.extract, self.fitting(LOOSER * scale, demands))
                if 2 * _covered(found) >= _covered(looser):
                    return scale * STEP ** (over / (before - over)) if before else scale
            scale, before = scale * STEP, max(over, 0.0)
        return math.nan

    def _extracted(self, params: Thresholds) -> list[Extraction]:
        return self._extracted_by(self._extract, params)

    def _extracted_by(self, extractor: Callable[[Scan, Any], Extraction], params: Thresholds) -> list[Extraction]:
        if not self._wanted():
            raise Cancelled
        return [extractor(scan, params) for scan in self._scans]

    def _text(self, proposed: Thresholds, pieces: float, lost: float) -> str:
        name, knob = _leading(proposed)
        values = [(knob.symbol, getattr(proposed, name), getattr(self.present, name))]
        values += [
            (other.symbol, value, before)
            for name, _, other in proposed.knobs()
            if other.growth and (value := getattr(proposed, name)) > (before := getattr(self.present, name))
        ]
        fits = " and ".join(f"{symbol} = {value:g}" for symbol, value, _ in values)
        now = " and ".join(f"{before:g}" for _, _, before in values)
        one = len(values) == 1
        told = f"Points scatter by {1e3 * self.scatter:.0f} mm here. {fits} fit{'s' * one}"
        higher = self._reach(proposed) / self._reach(self.present)
        # The page has room for four short lines.
        if higher > 1 and lost >= 0.1 and not lost < 1 - 1 / pieces:
            missed = f"miss{'es' * one} {lost:.0%} of the walls" if lost < 0.995 else f"find{'s' * one} no wall"
            return f"{told}; {now} {missed}."
        if higher > 1 and pieces >= 1.1:
            broken = f"at {now} a wall breaks into {pieces:.1f} pieces on average"
            return f"{told}; {broken if one else f'{now} break walls into {pieces:.1f} pieces'}."
        if not 1 / MUCH <= higher <= MUCH:
            return f"{told} better than {now}."
        *others, last = (f"{knob.symbol} = {value:g}" for knob, value in _changes(self.present, proposed))
        new = f"{', '.join(others)} and {last} fit" if others else f"{last} fits"
        return f"Points scatter by {1e3 * self.scatter:.0f} mm here. {new} slightly better."

    def _reach(self, params: Thresholds) -> float:
        """How far a point at the median range may lie from its line [m]."""
        rise = sum(getattr(params, name) for name, _, knob in params.knobs() if knob.growth)
        return math.hypot(getattr(params, _leading(params)[0]), rise * self._middle)


def _allowed(scale: float) -> float:
    """The share of an ε of `scale` [m] by which points may scatter about their lines."""
    return SHARE * (scale / SHARE_AT) ** POWER


def _share(found: list[Extraction], params: Params) -> float:
    """The rms of lines, each as a share of the ε at its middle: their root mean square by length; inf without lines."""
    lines = [line for one in found for line in one.segments]
    if not lines:
        return math.inf
    length, rms = np.array([(line.length, line.rms) for line in lines]).T
    middles = np.array([(line.start, line.end) for line in lines]).mean(axis=1)
    shares = rms / params.epsilon_at(np.hypot(*middles.T))
    return math.sqrt(float(length @ shares**2 / length.sum()))


def _covered(found: list[Extraction]) -> int:
    """The number of points on lines."""
    return sum(line.points for one in found for line in one.segments)


def _scatter(found: list[Extraction]) -> float:
    """The rms distance of points from their lines [m], by length; NaN without lines."""
    length, rms = np.array([(line.length, line.rms) for one in found for line in one.segments]).reshape(-1, 2).T
    return math.sqrt(float(length @ rms**2) / float(length.sum())) if length.sum() else math.nan


def _changes(present: Thresholds, proposed: Thresholds) -> list[tuple[Knob, float]]:
    """The thresholds that are proposed anew, with their values."""
    values = ((name, knob, getattr(proposed, name)) for name, _, knob in proposed.knobs())
    return [(knob, value) for name, knob, value in values if value != getattr(present, name)]


def _leading(params: Thresholds) -> tuple[str, Knob]:
    """The first threshold that depends on the noise, which stands for all of them in a sentence."""
    return next((name, knob) for name, _, knob in params.knobs() if knob.scatter and getattr(params, name))


def _labels(found: list[Extraction]) -> Labels:
    return [one.labels for one in found]


def _agreement(found: list[Extraction], walls: Labels) -> float:
    """Agreement of lines with other lines as the truth: the harmonic mean of TR and 1 − FR, times completeness."""
    total = Agreement.of_all(match(one, other).agreement for one, other in zip(found, walls, strict=True))
    score = quality(total.true_rate, total.false_rate, total.completeness)
    return score if math.isfinite(score) else 0.0


def _pieces(present: list[Extraction], walls: list[Extraction]) -> tuple[float, float]:
    """Mean number of segments on a wall, over the walls that have any, and the share of walls without; NaN if none."""
    counts = []
    for one, other in zip(present, walls, strict=True):
        matching = match(one, other.labels)
        counts.append((2 * matching.shared > matching.segment_beams).sum(axis=1))
    numbers = np.concatenate(counts)
    pieces = float(numbers[numbers > 0].mean()) if (numbers > 0).any() else math.nan
    return pieces, float((numbers == 0).mean()) if len(numbers) else math.nan
