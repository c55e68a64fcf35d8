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

from .apart import Change, Relation, why_apart
from .covariance import Noise, covariance, covariances
from .doubt import SCORES
from .doubt.misses import Miss, misses
from .doubt.suspicion import WEIGHTS, doubts, suspicion, worst_first
from .extractors import EXTRACTORS, Extractor, extract, trace
from .knobs import Knob, Thresholds
from .params import Params
from .readers import Account, Cancelled, Guess, Notice, Reading, open_recording, save_npz
from .readers.pack import read_pack
from .scan import PackAbout, Recording, Scan, Topic
from .segment import Dropped, Extraction, Segment
from .survey import Survey, survey
from .survey.committee import with_disputes
from .survey.difference import Difference, difference, differences
from .survey.remark import Remark
from .survey.stability import with_stability
from .survey.why import why
from .tracing.decisions import Decision, Explanation, Trace, TracedLine
from .truth import Agreement, Matching, agreement, agreements, match, near_lines, true_ends, true_lines
from .truth.label_file import ConflictError, label_file, read_labels, save_labels
from .truth.labels import FrameLabels, TrueLine
from .what_if import WhatIf, what_if
from .writers import figure_svg, params_text, read_params, write_segments
from .writers.pack import write_pack
from .writers.version import __version__

__all__ = [
    "EXTRACTORS",
    "SCORES",
    "WEIGHTS",
    "Account",
    "Agreement",
    "Cancelled",
    "Change",
    "ConflictError",
    "Decision",
    "Difference",
    "Dropped",
    "Explanation",
    "Extraction",
    "Extractor",
    "FrameLabels",
    "Guess",
    "Knob",
    "Matching",
    "Miss",
    "Noise",
    "Notice",
    "PackAbout",
    "Params",
    "Reading",
    "Recording",
    "Relation",
    "Remark",
    "Scan",
    "Segment",
    "Survey",
    "Thresholds",
    "Topic",
    "Trace",
    "TracedLine",
    "TrueLine",
    "WhatIf",
    "__version__",
    "agreement",
    "agreements",
    "covariance",
    "covariances",
    "difference",
    "differences",
    "doubts",
    "extract",
    "figure_svg",
    "label_file",
    "match",
    "misses",
    "near_lines",
    "open_recording",
    "params_text",
    "read_labels",
    "read_pack",
    "read_params",
    "save_labels",
    "save_npz",
    "survey",
    "suspicion",
    "trace",
    "true_ends",
    "true_lines",
    "what_if",
    "why",
    "why_apart",
    "with_disputes",
    "with_stability",
    "worst_first",
    "write_pack",
    "write_segments",
]
