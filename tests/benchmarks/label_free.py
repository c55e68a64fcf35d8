"""How often two settings have the same order without truth as with it: python tests/benchmarks/label_free.py [FILE…]

For the samples, the simulated worlds, the real rooms beside LINESEG_DATA and further files with truth: 200 random pairs
of settings (ε, δ and S_num within their sliders), scored by both objectives on the same frames. `clear` counts only the
pairs whose true scores differ by more than 0.02; `best` is the true score of the setting that scores best without
truth, divided by the best true score.
"""

from __future__ import annotations

import sys

import numpy as np
from recordings import recordings

from lineseg import Params
from lineseg.sweep import Batch, Totals
from lineseg.sweep.axes import knob_of
from lineseg.tuning import Objective, judge_of

PAIRS = 200
FRAMES = 24
CLEAR = 0.02


def random_settings(count: int) -> list[Params]:
    rng = np.random.default_rng(14)
    found = []
    for _ in range(count):
        values = {}
        for name in Objective("label-free").thresholds:
            kind, knob = knob_of(name)
            ends = np.log((knob.low, knob.high)) if knob.log else (knob.low, knob.high)
            value = float(rng.uniform(*ends))
            values[name] = kind(np.exp(value) if knob.log else round(value))
        found.append(Params().but(**values))
    return found


def scores(batch: Batch, settings: list[Params]) -> np.ndarray:
    return np.array([Objective().score(Totals(sums)) for sums in batch.measure(settings).sums])


def main(files: list[str]) -> None:
    settings = random_settings(2 * PAIRS)
    print(f"{'':24}{'agree':>8}{'clear':>8}{'best':>8}")
    table = []
    for recording in recordings(files):
        chosen = recording.only(np.linspace(0, len(recording) - 1, FRAMES).round().astype(int))
        truth = scores(Batch(chosen, scored=False), settings)
        blind = scores(Batch(chosen, scored=False, judge=judge_of(recording)), settings)
        ahead, by_truth = blind[::2] - blind[1::2], truth[::2] - truth[1::2]
        same = np.where(ahead * by_truth == 0, 0.5, ahead * by_truth > 0)
        clear = np.abs(by_truth) > CLEAR
        table.append((same.mean(), same[clear].mean(), truth[blind.argmax()] / truth.max()))
        print(f"{recording.name:24}" + "".join(f"{value:8.3f}" for value in table[-1]))
    print(f"{'mean':24}" + "".join(f"{value:8.3f}" for value in np.mean(table, axis=0)))


if __name__ == "__main__":
    main(sys.argv[1:])
