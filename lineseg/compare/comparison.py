"""All methods on one recording: as installed, as proposed without truth, and tuned with the truth."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..extractors import EXTRACTORS, Extractor
from ..knobs import Thresholds
from ..params import Params
from ..proposal import propose, scaled
from ..scan import Recording
from ..truth import Agreement
from ..tuning.objective import Objective
from .halves import Halves, Judge, halves
from .search import WISHES, search, tunable
from .timing import Timed, times_of

FRAMES = 60
BUDGET = 150
REFERENCE = "region-growing"
OBJECTIVE = Objective("truth")
Setting = Literal["installed", "proposed", "tuned"]


@dataclass(frozen=True, eq=False)
class Row:
    """The result of a method on the judged half of a recording.

    setting: the defaults, or what was best on the other half, by the lines of `judge_of` ("proposed") or by the truth
    ("tuned"). evaluations: number of settings tried there. about: the laser of the recording in a few words.
    agreement: None if no truth is known. times: (frames,) [µs], None until timed; reference: times of region growing
    with its defaults, measured in alternation.
    """

    recording: str
    method: str
    label: str
    params: Thresholds
    setting: Setting = "installed"
    evaluations: int = 0
    about: str = ""
    agreement: Agreement | None = None
    times: NDArray[np.float64] | None = None
    reference: NDArray[np.float64] | None = None

    @property
    def score(self) -> float:
        """The objective of the search on the judged half; NaN if there are no true lines."""
        if self.agreement is None:
            return math.nan
        return score_of(self.agreement)

    @property
    def ratio(self) -> float:
        """Time relative to region growing, both summed over the frames; NaN until timed."""
        if self.times is None or self.reference is None:
            return math.nan
        return float(self.times.sum() / self.reference.sum())


def score_of(agreement: Agreement, neutral: bool = False) -> float:
    """Harmonic mean of TR and 1 − FR, times completeness: the objective of tuning. neutral: leave these out."""
    false = agreement.neutral_false_rate if neutral else agreement.false_rate
    return OBJECTIVE.of_rates(agreement.true_rate, false, agreement.completeness)


def laser_of(recording: Recording) -> str:
    """The laser of a recording in a few words: its beams, its field of view, and how much its points scatter."""
    scan, found = recording[0], propose(recording)
    beams = f"{len(scan)} beams over {np.degrees(np.ptp(scan.bearings)):.0f}°"
    return f"{beams}, points scatter by {1000 * found.scatter:.0f} mm" if found.fitting else beams


class Comparison:
    """Compares methods on a recording; `rows` holds the results so far, even if `run` was interrupted.

    methods: names (default: all). budget: settings to try for each method, starting with the defaults, once without
    and once with the truth; 0 tries none.
    frames: largest number of frames, half of them for tuning. Without truth, methods are only timed.
    """

    def __init__(
        self,
        recording: Recording,
        methods: Sequence[str] | None = None,
        budget: int = BUDGET,
        frames: int | None = FRAMES,
    ) -> None:
        self.methods = [_method(name) for name in methods or EXTRACTORS]
        if budget < 0:
            raise ValueError(f"the budget is {budget} evaluations; give 0 or more")
        try:
            self.halves: Halves = halves(len(recording), frames)
        except ValueError as error:
            raise ValueError(f"{recording.name}: {error}") from None
        self.recording = recording
        self.truth = recording.wall is not None
        self.budget = budget if self.truth else 0
        self.about = laser_of(recording) + ("; truth by many views" if recording.wall_source else "")
        self.rows: list[Row] = []

    @property
    def steps(self) -> int:
        """Number of times that `run` yields."""
        tuned = 2 * sum(1 + self.budget for method in self.methods if self.budget and tunable(method))
        rounds = 3 if tuned else 1
        return len(self.methods) + tuned + rounds * len(self.halves.judged)

    def run(self) -> Iterator[None]:
        """Judge and time the defaults, then propose, judge and time, then tune; yields after every step."""
        judge = Judge.by_truth(self.recording, self.halves.judged) if self.truth else None
        for method in self.methods:
            self.rows.append(self._row(method, method.params_type(), "installed", 0, judge))
            yield
        yield from self._timed(0)
        if judge is None or not self.budget:
            return
        blind = self._blind()
        fitting = blind.fitting if blind else None
        yield from self._searched("proposed", blind, judge, fitting, WISHES)
        yield from self._searched("tuned", Judge.by_truth(self.recording, self.halves.training), judge, fitting, ())

    def _blind(self) -> Judge | None:
        """None if nothing fits the noise of the recording."""
        try:
            return Judge.blind(self.recording, self.halves.training)
        except ValueError:
            return None

    def _searched(
        self, setting: Setting, learner: Judge | None, judge: Judge, fitting: Params | None, fixed: Sequence[str]
    ) -> Iterator[None]:
        """The best setting of each method on the training half by `learner`; the defaults without one.

        fitting: what fits the noise, for region growing; the search of every method begins there. None if unknown.
        """
        start, budget = len(self.rows), self.budget if learner else 0
        for method in filter(tunable, self.methods):
            best = method.params_type()
            if learner is not None:
                best = yield from self._found(method, learner, _start(best, fitting), fixed)
            self.rows.append(self._row(method, best, setting, budget, judge))
            yield
        yield from self._timed(start)

    def _row(
        self, method: Extractor, params: Thresholds, setting: Setting, evaluations: int, judge: Judge | None
    ) -> Row:
        found = None if judge is None else judge.agreement(method, params)
        name = self.recording.name
        return Row(name, method.name, method.label, params, setting, evaluations, self.about, found)

    def _found(self, method: Extractor, learner: Judge, start: Thresholds, fixed: Sequence[str]) -> Iterator[None]:
        def score(params: Thresholds) -> float:
            return score_of(learner.agreement(method, params, ends=False))

        best, most = method.params_type(), -math.inf
        for params, found in search(method, score, self.budget, start, fixed):
            if found > most:
                best, most = params, found
            yield
        return best

    def _timed(self, start: int) -> Iterator[None]:
        """Time the rows from `start` on, in alternation with region growing with its defaults."""
        rows = self.rows[start:]
        reference: Timed = (EXTRACTORS[REFERENCE], EXTRACTORS[REFERENCE].params_type())
        settings: list[Timed] = [(EXTRACTORS[row.method], row.params) for row in rows]
        settings += [reference] if reference not in settings else []
        columns = []
        for column in times_of(self.recording, self.halves.judged, settings):
            columns.append(column)
            yield
        times = np.array(columns).T
        floor = times[settings.index(reference)]
        timed = zip(rows, times[: len(rows)], strict=True)
        self.rows[start:] = [replace(row, times=each, reference=floor) for row, each in timed]


def _method(name: str) -> Extractor:
    if name not in EXTRACTORS:
        raise ValueError(f"there is no method {name!r}; choose from {', '.join(EXTRACTORS)}")
    return EXTRACTORS[name]


def _start(default: Thresholds, fitting: Params | None) -> Thresholds:
    """The thresholds of a method that correspond to those of region growing."""
    if fitting is None:
        return default
    return fitting if isinstance(default, Params) else scaled(default, fitting.epsilon)
