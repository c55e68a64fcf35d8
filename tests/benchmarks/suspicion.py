"""How well the suspicion follows the truth: python tests/benchmarks/suspicion.py [FILE…]

For the samples, the simulated worlds, these worlds with other lasers and seeds, the real rooms beside LINESEG_DATA and
further files, with the truth by many views where they have no other, at the default thresholds: rank correlation, frame
by frame, with the faults (lines missed or false by the truth), and the share of the faults of the 15 truly worst frames
that the 15 most suspicious hold. Segments on walls just short of P_min or L_min are neither right nor false, so they
are no faults; `strict` counts them as faults. `before` is the suspicion of the scores alone, with the weights that it
had without a committee. Last, how many of the failures that tests/planted.py plants are among the 15 worst, on average
over the seeds 1 to 6.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1]))
from planted import FAILING, planted
from recordings import ROOT, recordings

from lineseg import Recording, agreements, extract, open_recording, survey, suspicion, with_disputes, with_stability
from lineseg.simulate.laser import LIDAR_16, LMS_200, RPLIDAR_A1, RPLIDAR_A2, TIM_561, UTM_30LX
from lineseg.simulate.worlds import WORLDS
from lineseg.truth import agreement, true_lines

WORST = 15
BEFORE = {
    "coverage": 1.0, "invalid": 1.0, "rms": 0.5, "splits": 1.0, "gap": 1.0, "misses": 0.5, "change": 0.5, "near": 0.5,
    "brief": 0.5, "gone": 3.0, "jump": 1.0, "jolt": 2.0, "unstable": 0.5,
}  # fmt: skip
OTHER_LASERS = {
    "office": (LMS_200, RPLIDAR_A2), "warehouse": (TIM_561,), "corridor": (UTM_30LX, TIM_561),
    "flat": (TIM_561, LIDAR_16), "yard": (LMS_200, TIM_561), "boards": (TIM_561, RPLIDAR_A2),
    "lobby": (UTM_30LX, LMS_200), "workshop": (UTM_30LX, RPLIDAR_A1),
}  # fmt: skip


def more_recordings(files: list[str]) -> Iterator[Recording]:
    yield from recordings(files)
    for name, lasers in OTHER_LASERS.items():
        for k, laser in enumerate(lasers):
            drive = replace(WORLDS[name], laser=laser, seed=WORLDS[name].seed + 700)
            yield drive.recording(f"{name}, laser {k + 1}")


def ranks(values: np.ndarray) -> np.ndarray:
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    return (np.cumsum(counts) - (counts - 1) / 2)[inverse]


def correlation(one: np.ndarray, other: np.ndarray) -> float:
    """Spearman's; 0 if one of them is constant."""
    if np.ptp(one) == 0 or np.ptp(other) == 0:
        return 0.0
    return float(np.corrcoef(ranks(one), ranks(other))[0, 1])


def held(rank: np.ndarray, faults: np.ndarray) -> float:
    return float(faults[np.argsort(-rank, kind="stable")[:WORST]].sum() / max(np.sort(faults)[-WORST:].sum(), 1))


def row(recording: Recording) -> tuple[float, ...]:
    judged = [a for a in agreements(recording) if a is not None]
    strict = np.array([a.true_lines + a.segments - 2 * a.matches for a in judged])
    faults = strict - np.array([a.neutral for a in judged])
    base = survey(recording)
    before, after = with_stability(recording, base).scores, with_disputes(recording, base).scores
    assert before is not None and after is not None
    old, new = suspicion(before, BEFORE), suspicion(after)
    compared = (old, faults), (new, faults), (new, strict)
    return (
        faults.mean(), strict.mean(), *(correlation(*each) for each in compared), *(held(*each) for each in compared)
    )  # fmt: skip


def planted_found(name: str, seeds: range) -> tuple[float, float]:
    """Means of the planted failures among the worst, and of all; frames that miss lines by themselves do not count."""
    sample = open_recording(ROOT / "sample_scans" / f"{name}.npz")
    alone = [agreement(extract(scan, FAILING), true_lines(scan)) for scan in sample]
    own = np.array([each.matches < each.true_lines for each in alone])
    counts = []
    for seed in seeds:
        recording, where = planted(sample, seed)
        scores = with_disputes(recording, survey(recording, FAILING)).scores
        assert scores is not None
        ranked = np.argsort(-suspicion(scores), kind="stable").tolist()
        worst = [frame for frame in ranked if frame in where or not own[frame]][:WORST]
        counts.append((sum(frame in where for frame in worst), len(where)))
    found, all_of_them = np.mean(counts, axis=0)
    return float(found), float(all_of_them)


def main(files: list[str]) -> None:
    three = f"{'before':>9}{'after':>9}{'strict':>9}"
    print(f"{'':24}{'faults a frame':>18}{'correlation':>27}{'held by 15':>27}")
    print(f"{'':24}{'counted':>9}{'strict':>9}{three}{three}")
    table = []
    for recording in more_recordings(files):
        table.append(row(recording))
        print(f"{recording.name:24}" + "".join(f"{value:9.2f}" for value in table[-1]))
        if recording.wall_source:
            print(f"    truth by many views: {recording.wall_source}")
    for name, over in (("mean", np.mean), ("least", np.min)):
        print(f"{name:24}" + "".join(f"{over(column):9.2f}" for column in zip(*table, strict=True)))
    for name in ("hallway", "laboratory"):
        found, planted_there = planted_found(name, range(1, 7))
        print(f"planted, {name}: {found:.1f} of {planted_there:.0f}")


if __name__ == "__main__":
    main(sys.argv[1:])
