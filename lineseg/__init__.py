"""Line segments from 2D laser scans by seeded region growing (Gao, Zhang, Fang, Yuan 2018).

    from lineseg import extract, open_recording

    recording = open_recording("corridor.bag")
    for segment in extract(recording[0]).segments:
        print(segment.start, segment.end, segment.rms)

Lengths are metres, angles radians, times seconds; frames and beams count from 0. By what one wants to do:

Open a recording
    `open_recording` a file (raise `Cancelled` to stop), a `Recording` of `Scan`s, perhaps one of several a `Topic`; a
    `Reading` says how to read it, its `Account` what it was taken for, with each `Guess` and
    `Notice`; `read_pack`, `PackAbout`: what a failure pack says of itself.
Extract lines
    `extract` from a scan, with `Params`, an `Extraction` of `Segment`s, and what was `Dropped`; `survey` a whole
    recording, a `Survey`; `covariance`, `covariances` of lines, from the `Noise` of the beams.
Understand a result
    `trace` it, a `Trace` of `Decision`s with each `TracedLine`, and an `Explanation` of a beam; `what_if`, `WhatIf`:
    which threshold would change it; `why_apart`: the `Relation` of two beams, in one line or in two, and each `Change`
    of it; `why`, `Remark`: what looks wrong in a frame; `misses`, `Miss`: lines not found.
Judge results
    Without truth: `SCORES`, `with_disputes`, `with_stability`, and by `WEIGHTS` the `doubts`, the `suspicion`, the
    frames `worst_first`.
    Against truth: `true_lines`, `near_lines`, `true_ends`; `match`, `Matching`; `agreement`, `agreements`, `Agreement`.
    Against each other: `difference`, `differences`, `Difference`.
Say what is true
    `label_file`, `read_labels`, `save_labels`; `FrameLabels` of `TrueLine`s; `ConflictError`.
Tune, and take the thresholds along
    `read_params`, `params_text`; many settings at once: `lineseg.sweep`; search: `lineseg.tuning`.
Write
    `write_segments`, `figure_svg`, `save_npz`, `write_pack`; into a recording of rerun: `lineseg.rerun`.
Declare a method of one's own
    `Extractor` in the table `EXTRACTORS`, with `Thresholds`, each a `Knob`.

`lineseg.examples` has a small program for each of these.
"""

from __future__ import annotations

import ast
import pkgutil
import sys
from importlib import import_module
from types import ModuleType
from typing import Any

# Where each name is, as type checkers read it.
_STUB = ast.parse(pkgutil.get_data(__name__, "__init__.pyi") or b"")
_HOMES = {
    alias.name: f"{__name__}.{node.module}"
    for node in _STUB.body
    if isinstance(node, ast.ImportFrom)
    for alias in node.names
}

__all__ = list(_HOMES)  # pyright: ignore[reportUnsupportedDunderAll]


class _Package(ModuleType):
    """A package whose names are imported when they are first used: importing all of them takes half a second."""

    def __getattr__(self, name: str) -> Any:
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}", name=name, obj=self)
        found = self.__dict__[name] = getattr(import_module(_HOMES[name]), name)
        return found

    def __setattr__(self, name: str, value: Any) -> None:
        # Importing the module `lineseg.survey` does not replace the function of this name.
        if name not in _HOMES or not isinstance(value, ModuleType):
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *_HOMES})


sys.modules[__name__].__class__ = _Package
