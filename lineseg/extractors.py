"""The table of methods."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .arguments import need_scan, need_thresholds
from .baselines.authors import AUTHORS, AuthorsParams
from .baselines.expectation_maximisation import EXPECTATION_MAXIMISATION, EmParams
from .baselines.found import Method
from .baselines.hough import HOUGH, HoughParams
from .baselines.iterative_end_point_fit import ITERATIVE_END_POINT_FIT, EndPointFitParams
from .baselines.line_regression import LINE_REGRESSION, RegressionParams
from .baselines.line_tracking import LINE_TRACKING, TrackingParams
from .baselines.logged import LoggedMethod
from .baselines.ransac import RANSAC, RansacParams
from .baselines.split_and_merge import SPLIT_AND_MERGE, SplitAndMergeParams
from .baselines.split_and_merge_textbook import SPLIT_AND_MERGE_TEXTBOOK, TextbookParams
from .knobs import Thresholds
from .params import Params
from .region_growing import Run, run
from .region_growing.extraction import KernelOutput
from .region_growing.trace import VOCABULARY, GrowthTrace
from .scan import Scan
from .segment import Extraction
from .tracing.decisions import Trace
from .tracing.vocabulary import Vocabulary

DEFAULT = Params()


@dataclass(frozen=True)
class Extractor:
    """A method under its name; each method has its own type of thresholds, and all return an `Extraction`.

    label: short, for a menu; citation: what it follows; begins: how its lines begin, in one word.
    """

    name: str
    label: str
    citation: str
    begins: str
    vocabulary: Vocabulary
    params_type: type[Thresholds]
    extract: Callable[[Scan, Any], Extraction]
    trace: Callable[[Scan, Any], Trace]


def extract(scan: Scan, params: Thresholds | None = None) -> Extraction:
    """The line segments of one scan, by the method that these thresholds belong to; default: seeded region growing.

    Segments come in scan order: by their first beam. A scan with fewer valid beams than a seed needs has no segments.
    Raises TypeError, which says what to pass, for an array instead of a Scan or a dict instead of thresholds.
    """
    if type(scan) is not Scan:
        need_scan(scan)
    if params is None or type(params) is Params:
        return grow(scan, params or DEFAULT)
    return method_of(params).extract(scan, params)


def trace(scan: Scan, params: Thresholds | None = None) -> Trace:
    """Like `extract`, with every decision recorded; `.extraction` is what `extract` returns. Raises the same errors."""
    need_scan(scan)
    params = DEFAULT if params is None else params
    return method_of(params).trace(scan, params)


def method_of(params: Thresholds) -> Extractor:
    """The method that these thresholds belong to. Raises TypeError, which says what to pass, for anything else."""
    for method in EXTRACTORS.values():
        if method.params_type is type(params):
            return method
    need_thresholds(params)
    raise TypeError(f"no method of EXTRACTORS takes {type(params).__name__}; add an Extractor with this params_type")


def grow(scan: Scan, params: Params) -> Extraction:
    """Seeded region growing (Gao et al. 2018)."""
    result = run(scan, params)
    return _extraction(scan, params, result)


def trace_growth(scan: Scan, params: Params) -> GrowthTrace:
    result = run(scan, params, logged=True)
    return GrowthTrace(scan, params, _extraction(scan, params, result), result)


def _baseline(
    method: Method | LoggedMethod, label: str, citation: str, begins: str, params_type: type[Thresholds]
) -> Extractor:
    return Extractor(method.name, label, citation, begins, method.vocabulary, params_type, method.extract, method.trace)


def _extraction(scan: Scan, params: Params, result: Run) -> Extraction:
    rows = KernelOutput(scan, result.lines, result.dropped, result.beam)
    return Extraction.of_rows("region-growing", params, rows)


EXTRACTORS = {
    method.name: method
    for method in [
        Extractor(
            "region-growing",
            "Region growing",
            "Gao, Zhang, Fang, Yuan 2018",
            "seed",
            VOCABULARY,
            Params,
            grow,
            trace_growth,
        ),
        _baseline(AUTHORS, "Authors' program", "Gao, Zhang, Fang, Yuan 2018, as released", "seed", AuthorsParams),
        _baseline(SPLIT_AND_MERGE, "Split-and-Merge", "Gallant 2014; Pfister 2003", "split", SplitAndMergeParams),
        _baseline(
            SPLIT_AND_MERGE_TEXTBOOK,
            "Split-and-Merge (textbook)",
            "Pavlidis, Horowitz 1974; Nguyen et al. 2007",
            "split",
            TextbookParams,
        ),
        _baseline(ITERATIVE_END_POINT_FIT, "Iterative end-point fit", "Duda, Hart 1973", "split", EndPointFitParams),
        _baseline(LINE_TRACKING, "Line tracking", "Siadat et al. 1997", "start", TrackingParams),
        _baseline(LINE_REGRESSION, "Line regression", "Arras, Siegwart 1997", "cluster", RegressionParams),
        _baseline(HOUGH, "Hough transform", "Duda, Hart 1972; Pfister et al. 2003", "peak", HoughParams),
        _baseline(RANSAC, "RANSAC", "Fischler, Bolles 1981", "sample", RansacParams),
        _baseline(EXPECTATION_MAXIMISATION, "Expectation maximisation", "Nguyen et al. 2007", "piece", EmParams),
    ]
}
