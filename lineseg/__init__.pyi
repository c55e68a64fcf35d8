# What the package offers, and where it is. Type checkers and `__init__.py` read this.
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
