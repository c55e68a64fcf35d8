"""Write your own method: cut where neighbouring points are far apart, and keep the long pieces.

Once it is in the table EXTRACTORS, it can be traced, surveyed and scored, and a server started from here lists it.
"""

import sys
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from lineseg import EXTRACTORS, Extractor, Knob, Thresholds, open_recording, survey, trace
from lineseg.baselines.found import Found, Method, vocabulary
from lineseg.baselines.sequence import Sequence


@dataclass(frozen=True)
class JumpParams(Thresholds):
    jump: Annotated[float, Knob("J", 0.05, 2.0, "m", 0.05, label="jump", help="Widest gap inside a line.")] = 0.2
    min_points: Annotated[int, Knob("P_min", 3, 100, least=2, label="points in a line")] = 10
    min_length: Annotated[float, Knob("L_min", 0.0, 3.0, "m", 0.01, label="length of a line")] = 0.6


def find(points: Sequence, params: JumpParams, found: Found) -> None:
    gaps = np.hypot(np.diff(points.x), np.diff(points.y))
    for run in np.split(np.arange(len(points.x)), np.flatnonzero(gaps > params.jump) + 1):
        found.keep(run)  # or drops it: too few points, or too short


METHOD = Method("jumps", vocabulary("pieces", ()), find)
EXTRACTORS["jumps"] = Extractor(
    METHOD.name, "Jumps", "no paper", "piece", METHOD.vocabulary, JumpParams, METHOD.extract, METHOD.trace
)

recording = open_recording(sys.argv[1] if sys.argv[1:] else "sample_scans/hallway.npz")
for decision in trace(recording[0], JumpParams(jump=0.1)):
    if decision.kind == "line kept":
        print(decision.text)
print(f"{len(survey(recording, JumpParams()).segments)} segments in {len(recording)} frames")
