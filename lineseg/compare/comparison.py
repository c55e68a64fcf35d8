"""All methods on one recording: first with their defaults, then tuned."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..extractors import EXTRACTORS, Extractor
from ..knobs import Thresholds
from ..scan import Recording
from ..truth import Agreement
from ..tuning.objective import Objective
from .halves import Halves, Judge, halves
from .search import search, tunable
from .timing import Setting, times_of

FRAMES = 60
BUDGET = 150
REFERENCE = "region-growing"
OBJECTIVE = Objective("truth")


@dataclass(frozen=True, eq=False)
class Row:
    """The result of a method on the judged half of a recording; evaluations: settings tried on the other half, or 0.

    agreement: None if no truth is known. times: (frames,) [µs], None until timed; reference: times of region growing
    with its defaults, measured in alternation.
    """

    recording: str
    method: str
    label: str
    params: Thresholds
    evaluations: int = 0
    agreement: Agreement | None = None
    times: NDArray[np.float64] | None = None
    reference: NDArray[np.float64] | None = None

    @property
    def tuned(self) -> bool:
        return self.evaluations > 0

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


def score_of(agreement: Agreement) -> float:
    """Harmonic mean of TR and 1 − FR, times completeness: the objective of tuning."""
    return OBJECTIVE.of_rates(agreement.true_rate, agreement.false_rate, agreement.completeness)


class Comparison:
    """Compares methods on a recording; `rows` holds the results so far, even if `run` was interrupted.

    methods: names (default: all). budget: settings to try for each method, starting with the defaults; 0 tunes none.
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
        self.rows: list[Row] = []

    @property
    def steps(self) -> int:
        """Number of times that `run` yields."""
        tuned = sum(1 + self.budget for method in self.methods if self.budget and tunable(method))
        rounds = 2 if tuned else 1
        return len(self.methods) + tuned + rounds * len(self.halves.judged)

    def run(self) -> Iterator[None]:
        """Judge and time the defaults, then tune, judge and time; yields after every step."""
        judge = Judge(self.recording, self.halves.judged) if self.truth else None
        for method in self.methods:
            self.rows.append(self._row(method, method.params_type(), 0, judge))
            yield
        yield from self._timed(0)
        if judge is None or not self.budget:
            return
        learner = Judge(self.recording, self.halves.training)
        for method in filter(tunable, self.methods):
            best = yield from self._tuned(method, learner)
            self.rows.append(self._row(method, best, self.budget, judge))
            yield
        yield from self._timed(len(self.methods))

    def _row(self, method: Extractor, params: Thresholds, evaluations: int, judge: Judge | None) -> Row:
        found = None if judge is None else judge.agreement(method, params)
        return Row(self.recording.name, method.name, method.label, params, evaluations, found)

    def _tuned(self, method: Extractor, learner: Judge) -> Iterator[None]:
        def score(params: Thresholds) -> float:
            return score_of(learner.agreement(method, params, ends=False))

        best, most = method.params_type(), -math.inf
        for params, found in search(method, score, self.budget):
            if found > most:
                best, most = params, found
            yield
        return best

    def _timed(self, start: int) -> Iterator[None]:
        """Time the rows from `start` on, in alternation with region growing with its defaults."""
        rows = self.rows[start:]
        reference: Setting = (EXTRACTORS[REFERENCE], EXTRACTORS[REFERENCE].params_type())
        settings: list[Setting] = [(EXTRACTORS[row.method], row.params) for row in rows]
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
