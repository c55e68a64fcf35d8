"""Tunes any method: an Optuna study in memory over its thresholds."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from typing import Any

from ..extractors import Extractor
from ..knobs import Knob, Thresholds
from ..tuning.study import SEED, optuna_module

# A random seed is not a threshold: the best of fifty would be luck.
NO_THRESHOLDS = ("seed",)
# These say which lines you want, which nothing but the truth can judge.
WISHES = ("min_points", "min_length")


def tunable(method: Extractor) -> dict[str, tuple[type, Knob]]:
    """The thresholds to search: all numbers. Switches are left out, because they select a variant of the method."""
    knobs = {name: (kind, knob) for name, kind, knob in method.params_type.knobs() if kind is not bool}
    return {name: entry for name, entry in knobs.items() if name not in NO_THRESHOLDS}


def search(
    method: Extractor,
    score: Callable[[Thresholds], float],
    budget: int,
    start: Thresholds | None = None,
    fixed: Collection[str] = (),
) -> Iterator[tuple[Thresholds, float]]:
    """(thresholds, score) of each evaluation: first the defaults, then `start`, then proposals of the sampler.

    The sampler stays within the slider ranges, and starts from SEED for every method. fixed: names of thresholds that
    keep their defaults. A score of NaN is a failed trial.
    """
    optuna = optuna_module()
    study = optuna.create_study(direction="maximize", sampler=optuna.samplers.TPESampler(seed=SEED))
    starts = (method.params_type(), start or method.params_type())
    space = {
        name: _distribution(optuna, kind, knob, [each.numbers()[name] for each in starts])
        for name, (kind, knob) in tunable(method).items()
        if name not in fixed
    }
    for first in dict.fromkeys(starts):
        study.enqueue_trial({name: first.numbers()[name] for name in space})
    for _ in range(budget):
        trial = study.ask(space)
        params = starts[0].but(**{name: _rounded(value) for name, value in trial.params.items()})
        found = score(params)
        if math.isnan(found):
            study.tell(trial, state=optuna.trial.TrialState.FAIL)
        else:
            study.tell(trial, found)
        yield params, found


def _distribution(optuna: Any, kind: type, knob: Knob, starts: Sequence[float]) -> Any:
    """The range of the slider, and what the settings that are tried first need beyond it."""
    low, high = min(knob.low, *starts), max(knob.high, *starts)
    if kind is int:
        return optuna.distributions.IntDistribution(int(low), int(high))
    return optuna.distributions.FloatDistribution(low, high, log=knob.log and low > 0)


def _rounded(value: float) -> float:
    return value if isinstance(value, int) else float(f"{value:.4g}")
