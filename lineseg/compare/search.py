"""Tunes any method: an Optuna study in memory over its thresholds."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

from ..extractors import Extractor
from ..knobs import Knob, Thresholds
from ..tuning.study import SEED, optuna_module

# A random seed is not a threshold: the best of fifty would be luck.
NO_THRESHOLDS = ("seed",)


def tunable(method: Extractor) -> dict[str, tuple[type, Knob]]:
    """The thresholds to search: all numbers. Switches are left out, because they select a variant of the method."""
    knobs = {name: (kind, knob) for name, kind, knob in method.params_type.knobs() if kind is not bool}
    return {name: entry for name, entry in knobs.items() if name not in NO_THRESHOLDS}


def search(method: Extractor, score: Callable[[Thresholds], float], budget: int) -> Iterator[tuple[Thresholds, float]]:
    """(thresholds, score) of each evaluation: first the defaults, then proposals of the sampler within slider ranges.

    The sampler starts from SEED for every method. A score of NaN is a failed trial.
    """
    optuna = optuna_module()
    study = optuna.create_study(direction="maximize", sampler=optuna.samplers.TPESampler(seed=SEED))
    default = method.params_type()
    space = {name: _distribution(optuna, kind, knob) for name, (kind, knob) in tunable(method).items()}
    study.enqueue_trial({name: default.numbers()[name] for name in space})
    for _ in range(budget):
        trial = study.ask(space)
        params = default.but(**{name: _rounded(value) for name, value in trial.params.items()})
        found = score(params)
        if math.isnan(found):
            study.tell(trial, state=optuna.trial.TrialState.FAIL)
        else:
            study.tell(trial, found)
        yield params, found


def _distribution(optuna: Any, kind: type, knob: Knob) -> Any:
    if kind is int:
        return optuna.distributions.IntDistribution(int(knob.low), int(knob.high))
    return optuna.distributions.FloatDistribution(knob.low, knob.high, log=knob.log)


def _rounded(value: float) -> float:
    return value if isinstance(value, int) else float(f"{value:.4g}")
