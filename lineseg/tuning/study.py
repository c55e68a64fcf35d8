"""Auto-tuning: an Optuna study over the thresholds, which can be kept in a file and continued later."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..installation import install_command
from ..params import Params
from ..sweep.axes import knob_of
from ..sweep.totals import Totals
from .objective import Objective
from .parts import Blocks

STUDY = "lineseg"
SEED = 2018
# With fewer trials, importances are noise.
LEAST_FOR_IMPORTANCE = 12
LEAST_SEED = int(knob_of("seed_points")[1].least)


@dataclass(frozen=True)
class Trial:
    """One tried setting; score: on the training half, NaN if undefined."""

    number: int
    params: Params
    score: float


@dataclass(frozen=True)
class Gain:
    """The score of the tuned thresholds compared with that of others, on the same held-back stretches, pair by pair.

    others: what they are called. error: standard error of the gain (jackknife over the pairs); higher: number of
    stretches where the tuned thresholds score higher.
    """

    others: str
    before: float
    after: float
    error: float
    higher: int
    stretches: int
    frames: int

    @property
    def value(self) -> float:
        return self.after - self.before

    @property
    def certain(self) -> bool:
        """Whether the gain is more than twice its standard error."""
        return self.value > 0 and self.value > 2 * self.error

    @property
    def text(self) -> str:
        numbers = f"{self.after:.4f} against {self.before:.4f} for {self.others}"
        where = f"on {self.frames:,} held-back frames, higher in {self.higher} of {self.stretches} stretches"
        if self.certain:
            return f"Gain {self.value:+.4f} (± {self.error:.4f}): {numbers} {where}."
        if self.value < -2 * self.error:
            return f"No gain: {numbers} {where}. Keep {self.others}."
        return f"No gain: {numbers} {where}. The difference is less than twice its uncertainty of ± {self.error:.4f}."


@dataclass(frozen=True)
class Verdict:
    """The best trial compared on held-back frames with the present thresholds, and with the paper's if these differ."""

    params: Params
    gains: tuple[Gain, ...]
    unchanged: bool

    @property
    def gained(self) -> bool:
        """Whether the best trial is better than the present thresholds."""
        return self.gains[0].certain

    @property
    def text(self) -> str:
        first, *rest = self.gains
        told = [first.text, *(each.text for each in rest)]
        if self.unchanged:
            told[0] = (
                f"No gain: no trial was better than {first.others}, which score {first.before:.4f} on "
                f"{first.frames:,} held-back frames."
            )
        return " ".join(told)


class Tuning:
    """Tries settings on the training blocks, one at a time.

    path: SQLite file of the study (default: in memory). thresholds: names to tune (default: those of the objective);
    the others stay as in `base`. Raises ValueError if the file contains another study.
    """

    def __init__(
        self,
        blocks: Blocks,
        objective: Objective,
        path: Path | None = None,
        thresholds: Sequence[str] | None = None,
        base: Params | None = None,
    ) -> None:
        if objective.kind == "truth" and not blocks.truth:
            raise ValueError(f"{blocks.name} has no truth; tune it with the label-free objective")
        if objective.kind == "label-free" and blocks.truth:
            raise ValueError("these blocks are compared with the truth; make them blind for the label-free objective")
        thresholds = objective.thresholds if thresholds is None else thresholds
        if not thresholds:
            raise ValueError(f"no threshold to tune is given; choose from {', '.join(asdict(Params()))}")
        self.objective, self._blocks = objective, blocks
        self._base = base or Params()
        self._optuna = optuna_module()
        self._distributions = {name: self._distribution(name) for name in thresholds}
        about = {"objective": asdict(objective), "thresholds": list(thresholds), "data": blocks.name}
        about["frames"] = list(blocks.frames)
        self._study = self._opened(path, json.dumps(about))
        if not self._study.trials:
            # The defaults first, so that nothing worse on the training half is ever proposed.
            for start in dict.fromkeys((Params(), self._base)):
                self._study.enqueue_trial(self._values(start))

    def recall(self, trials: Sequence[Trial]) -> None:
        """Continue from the trials of an earlier run, of the same objective on the same frames, instead of anew."""
        if not trials:
            return
        self._study = self._opened(None, self._study.user_attrs["about"])
        states = self._optuna.trial.TrialState
        for trial in trials:
            unknown = math.isnan(trial.score)
            made = self._optuna.trial.create_trial(
                state=states.FAIL if unknown else states.COMPLETE,
                value=None if unknown else trial.score,
                params=self._values(trial.params),
                distributions=self._distributions,
            )
            self._study.add_trial(made)

    def _opened(self, path: Path | None, about: str) -> Any:
        optuna = self._optuna
        sampler = optuna.samplers.TPESampler(seed=SEED)
        storage = None if path is None else f"sqlite:///{Path(path).absolute()}"
        try:
            study = optuna.create_study(
                storage=storage, sampler=sampler, study_name=STUDY, direction="maximize", load_if_exists=True
            )
            found = study.user_attrs.get("about")
        except Exception as error:
            if path is None:
                raise
            raise ValueError(
                f"{path}: the study cannot be kept there ({_first_line(error)}); give another file"
            ) from None
        if found is None and not study.trials:
            study.set_user_attr("about", about)
        elif found != about:
            raise ValueError(f"{path}: {_difference(found, about)}; give another file for this study")
        return study

    def _distribution(self, name: str) -> Any:
        """The range of the slider, and what the settings that are tried first need beyond it."""
        kind, knob = knob_of(name)
        knob = knob.reaching(*(getattr(start, name) for start in (Params(), self._base)))
        if kind is int:
            return self._optuna.distributions.IntDistribution(int(knob.low), int(knob.high))
        return self._optuna.distributions.FloatDistribution(knob.low, knob.high, log=knob.log)

    def step(self) -> Trial:
        """Try one more setting."""
        trial = self._study.ask(self._distributions)
        params = self._params(trial.params)
        try:
            score = self.objective.score(_sum(self._blocks.totals(params, self._blocks.train)))
        except BaseException:
            self._study.tell(trial, state=self._optuna.trial.TrialState.FAIL)
            raise
        if math.isnan(score):
            self._study.tell(trial, state=self._optuna.trial.TrialState.FAIL)
        else:
            self._study.tell(trial, score)
        return Trial(trial.number, params, score)

    def run(self, trials: int) -> Iterator[Trial]:
        """Try this many more settings."""
        for _ in range(trials):
            yield self.step()

    def trials(self) -> list[Trial]:
        """All finished trials, including those of earlier runs."""
        finished = [trial for trial in self._study.trials if trial.state.is_finished() and trial.params]
        return [
            Trial(trial.number, self._params(trial.params), math.nan if trial.value is None else trial.value)
            for trial in finished
        ]

    def best(self) -> Trial:
        """The best trial on the training half. Raises ValueError if no trial has a score."""
        scored = [trial for trial in self.trials() if not math.isnan(trial.score)]
        if not scored:
            raise ValueError(
                "no trial has a score, because these frames have no true lines with a return; use other frames or "
                "the label-free objective"
            )
        return max(scored, key=lambda trial: trial.score)

    def importance(self) -> dict[str, float]:
        """The importance of each tuned threshold for the score (PED-ANOVA); empty if there are too few trials."""
        scored = [trial for trial in self.trials() if not math.isnan(trial.score)]
        if len(scored) < LEAST_FOR_IMPORTANCE or len(self._distributions) < 2:
            return {}
        evaluator = self._optuna.importance.PedAnovaImportanceEvaluator()
        return self._optuna.importance.get_param_importances(self._study, evaluator=evaluator)

    def verdict(self) -> Verdict:
        """The best trial against the present thresholds, and against the paper's defaults."""
        params = self.best().params
        tuned = self._blocks.totals(params, self._blocks.held_back)
        others = {Params(): "the paper's defaults"}
        if self._base != Params():
            others = {self._base: "the present thresholds"} | others
        gains = tuple(self._gain(tuned, each, name) for each, name in others.items())
        return Verdict(params, gains, unchanged=params == self._base)

    def _gain(self, tuned: Sequence[Totals], other: Params, name: str) -> Gain:
        held_back = self._blocks.held_back
        pairs = list(zip(tuned, self._blocks.totals(other, held_back), strict=True))
        each = [self._difference([pair]) for pair in pairs]
        without = np.array([self._difference([*pairs[:k], *pairs[k + 1 :]]) for k in range(len(pairs))])
        n = len(pairs)
        error = math.sqrt((n - 1) / n * float(np.sum((without - without.mean()) ** 2))) if n > 1 else math.inf
        before = self.objective.score(_sum([other for _, other in pairs]))
        frames = sum(self._blocks.frames[k] for k in held_back)
        higher = sum(value > 0 for value in each)
        return Gain(name, before, self.objective.score(_sum(tuned)), error, higher, n, frames)

    def _difference(self, pairs: Sequence[tuple[Totals, Totals]]) -> float:
        """The gain over these pairs alone."""
        if not pairs:
            return 0.0
        tuned, other = (self.objective.score(_sum(each)) for each in zip(*pairs, strict=True))
        return tuned - other

    def _values(self, params: Params) -> dict[str, float]:
        return {name: getattr(params, name) for name in self._distributions}

    def _params(self, values: dict[str, float]) -> Params:
        """The setting that is tried for these values. A seed is never longer than the shortest line."""
        params = self._base.but(**{name: _rounded(name, value) for name, value in values.items()})
        return params.but(seed_points=min(params.seed_points, max(params.min_points, LEAST_SEED)))


def _rounded(name: str, value: float) -> float:
    kind, _ = knob_of(name)
    return int(value) if kind is int else float(f"{value:.4g}")


def _sum(parts: Sequence[Totals]) -> Totals:
    return Totals(np.sum([part.sums for part in parts], axis=0))


def _difference(found: str | None, about: str) -> str:
    if found is None:
        return "this is a study of another program"
    one, other = json.loads(found), json.loads(about)
    for name, what in [("objective", "objective"), ("thresholds", "set of thresholds"), ("data", "recording")]:
        if one[name] != other[name]:
            return f"this is a study of another {what}: {_words(one[name])}, not {_words(other[name])}"
    return "this is a study of other frames of the same recording"


def _words(value: Any) -> str:
    if isinstance(value, dict):
        return f"{value['kind']} ({', '.join(f'{name} {each:g}' for name, each in value.items() if name != 'kind')})"
    return ", ".join(value) if isinstance(value, list) else str(value)


def optuna_module() -> Any:
    try:
        import optuna
    except ImportError:
        raise ValueError(f"auto-tuning needs Optuna; `{install_command('tune')}` installs it") from None
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    return optuna


def _first_line(error: BaseException) -> str:
    return next(iter(str(error).splitlines()), "").rstrip(".") or type(error).__name__
