"""Methods that run entirely in kernels, which write lines and optionally a log."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from numpy.typing import NDArray

from ..region_growing.extraction import KernelOutput
from ..scan import Scan
from ..segment import Extraction
from ..tracing.decisions import Trace
from ..tracing.vocabulary import Vocabulary


class Run(NamedTuple):
    """The output of one run: rows of LINE, DROPPED and ROW. positions: (m,) maps their positions to beams."""

    lines: NDArray
    dropped: NDArray
    positions: NDArray
    rows: NDArray


class LoggedMethod(NamedTuple):
    """run: takes a scan, the thresholds, and whether the log is wanted."""

    name: str
    vocabulary: Vocabulary
    run: Callable[[Scan, Any, bool], Run]

    def extract(self, scan: Scan, params: Any) -> Extraction:
        """The segments of one scan."""
        return self._extraction(scan, params, self.run(scan, params, False))

    def trace(self, scan: Scan, params: Any) -> Trace:
        """The same run with its decisions."""
        found = self.run(scan, params, True)
        extraction = self._extraction(scan, params, found)
        return Trace(scan, params, extraction, self.vocabulary, found.rows, found.positions)

    def _extraction(self, scan: Scan, params: Any, found: Run) -> Extraction:
        rows = KernelOutput(scan, found.lines, found.dropped, found.positions)
        return Extraction.of_rows(self.name, params, rows)
