"""The effect of thresholds on the recording on the screen: a curve for each, a map for two; coarse, then finer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from lineseg import Params, Recording
from lineseg.sweep import MEASURES, Batch, Totals, slider_values
from lineseg.sweep.workers import Pool

from ..told.answers import SampledCurves, SampledMap
from .kept import Kept

CURVES = ("coverage", "segments", "true_rate", "false_rate", "completeness", "f_score")
# (frames, values per threshold) and (frames, values per side) of each stage; the first is fast enough to follow a drag.
CURVE_STAGES = ((40, 17), (200, 17), (1000, 17))
MAP_STAGES = ((40, 7), (40, 13), (200, 25))


Curves = Mapping[str, Mapping[str, Sequence[float | None]]]
_kept_curves = Kept[Curves]()


@dataclass(eq=False)
class Subject:
    """A recording and thresholds; stop: (1,) bool, set it to end the work with `Cancelled`."""

    recording: Recording
    params: Params
    stop: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(1, np.bool_))


def curves(subject: Subject, workers: Pool, names: Sequence[str]) -> Iterator[SampledCurves]:
    """Stage by stage, CURVES over the slider of each threshold, from evenly spread frames of the recording."""
    for batch, frames, count in _stages(subject.recording, CURVE_STAGES):
        work = partial(_curves, subject, workers, names, batch, count)
        yield {
            "frames": frames,
            "of": len(subject.recording),
            "params": asdict(subject.params),
            "curves": _kept_curves.get(subject.recording, (subject.params, tuple(names), frames, count), work),
        }


def _curves(subject: Subject, workers: Pool, names: Sequence[str], batch: Batch, count: int) -> Curves:
    """For each threshold its values, and each of CURVES over them."""
    values = {name: slider_values(name, count, getattr(subject.params, name)) for name in names}
    tasks = [(batch, [subject.params.but(**{name: value}) for value in values[name]], subject.stop) for name in names]
    found = {names[number]: totals for number, totals in workers.results(_measure, tasks)}
    return {name: {"values": values[name], **_measures(found[name], CURVES)} for name in names}


def relief(subject: Subject, workers: Pool, x: str, y: str, measure: str) -> Iterator[SampledMap]:
    """Stage by stage, a measure over two thresholds: `heights`, a row for each value of y."""
    for batch, frames, count in _stages(subject.recording, MAP_STAGES):
        xs, ys = (slider_values(name, count, getattr(subject.params, name)) for name in (x, y))
        tasks = [(batch, [subject.params.but(**{x: u, y: v}) for u in xs], subject.stop) for v in ys]
        rows: list[list[float | None]] = [[]] * len(ys)
        for number, totals in workers.results(_measure, tasks):
            rows[number] = _numbers(totals.measure(measure))
        yield {
            "frames": frames,
            "of": len(subject.recording),
            "params": asdict(subject.params),
            "x": x,
            "y": y,
            "measure": measure,
            "xs": xs,
            "ys": ys,
            "heights": rows,
        }


def _stages(recording: Recording, stages: Sequence[tuple[int, int]]) -> Iterator[tuple[Batch, int, int]]:
    """(frames, number of frames, values); a short recording has fewer stages."""
    told = None
    for most, count in stages:
        frames = min(most, len(recording))
        if (frames, count) != told:
            yield _spread_batch(recording, frames), frames, count
        told = frames, count


@lru_cache(maxsize=6)
def _spread_batch(recording: Recording, frames: int) -> Batch:
    """Without scores: these measures need the extraction only."""
    chosen = np.unique(np.linspace(0, len(recording) - 1, frames).round().astype(int))
    return Batch(recording.only(chosen), scored=False)


def _measure(task: tuple[Batch, Sequence[Params], NDArray[np.bool_]]) -> Totals:
    batch, settings, stop = task
    return batch.measure(settings, stop)


def _measures(totals: Totals, names: Sequence[str]) -> dict[str, list[float | None]]:
    return {name: _numbers(totals.measure(name)) for name in names if totals.has_truth or not MEASURES[name].truth}


def _numbers(values: NDArray[np.float64]) -> list[float | None]:
    """JSON has no NaN."""
    return [round(value, 5) if np.isfinite(value) else None for value in values.tolist()]
