"""Times of the samples, kept by pytest-benchmark: `pytest -o addopts= tests/benchmarks --benchmark-autosave`."""

from pathlib import Path

import numpy as np
import pytest

from lineseg import Params, Recording, Scan, extract, open_recording, survey, trace
from lineseg.bench.timing import floor_pass
from lineseg.region_growing import Memory, extract_lines
from lineseg.region_growing.limits import limits_of

SAMPLES = Path(__file__).parents[2] / "sample_scans"


@pytest.fixture(scope="module", params=["hallway", "laboratory"])
def scans(request) -> list[Scan]:
    return list(open_recording(SAMPLES / f"{request.param}.npz"))


@pytest.fixture(scope="module")
def long_recording(scans) -> Recording:
    return Recording.from_scans(scans * 10)


def each(call, items):
    for item in items:
        call(item)


def test_floor(benchmark, scans):
    points = [np.ascontiguousarray(scan.xy[scan.valid].T) for scan in scans]
    benchmark(each, lambda xy: floor_pass(xy[0], xy[1]), points)


def test_kernel(benchmark, scans):
    memory, limits = Memory(len(scans[0]), scans[0].full_circle), limits_of(Params())
    scenes = [(scan.ranges.astype(float), scan.rays, scan.range_min, scan.range_max, scan.around) for scan in scans]
    benchmark(each, lambda scene: extract_lines(*scene, limits, *memory.arguments, None), scenes)


def test_extract(benchmark, scans):
    benchmark(each, extract, scans)


def test_trace(benchmark, scans):
    benchmark(each, trace, scans)


@pytest.mark.parametrize("scores", [False, True], ids=["segments", "with scores"])
def test_survey(benchmark, long_recording, scores):
    survey(long_recording, scores=scores)
    benchmark(survey, long_recording, scores=scores)
