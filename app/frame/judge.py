"""Compares the segments of a frame with its true lines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lineseg import Agreement, FrameLabels, Recording, Thresholds, agreements
from lineseg.truth import Matching, demands_of, match, near_lines, true_ends, true_lines
from lineseg.truth.labels import Labels
from lineseg.writers.finite import finite_or_none

from ..shelf.label_files import Known
from ..told import drawn as told
from .findings import Findings

# A longer recording is judged by this many evenly spread frames, because each is extracted again.
MOST_FRAMES = 2000


class Judged(NamedTuple):
    """matching: of segments and true lines; ends: (lines, 2, 2) [m] of the true lines."""

    matching: Matching
    ends: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Reference:
    """The reference for judging the segments of a recording.

    available: the existing references: "labels" made by people, "wall" stored in the recording; chosen: one, or "".
    known: the labels of the recording, if it can have any.
    """

    available: list[told.Reference]
    chosen: told.Reference | Literal[""]
    known: Known | None

    @classmethod
    def of(cls, wanted: str, recording: Recording, known: Known | None) -> Reference:
        """The wanted reference if available, else another one."""
        available: list[told.Reference] = []
        if known is not None and known.labelled:
            available.append("labels")
        if recording.wall is not None:
            available.append("wall")
        fitting: list[told.Reference] = [name for name in available if name == wanted] or available
        return cls(available, fitting[0] if fitting else "", known)

    @property
    def said(self) -> Known | None:
        """The labels, if they are the chosen reference."""
        return self.known if self.chosen == "labels" else None


def judged(found: Findings, said: FrameLabels | None = None) -> Judged | None:
    """None if the truth is unknown. said: labels to use instead of the walls."""
    if said is not None:
        truth = said.truth(found.scan)
        return None if truth is None else Judged(match(found.extraction, truth, said.ends), said.ends)
    if found.scan.wall is None:
        return None
    lines = true_lines(found.scan, demands_of(found.trace.params))
    ends = true_ends(found.scan, lines)
    near = near_lines(found.scan, demands_of(found.trace.params))
    return Judged(match(found.extraction, lines, ends, near), ends)


def judged_recording(
    recording: Recording, method: str, params: Thresholds, said: Labels | None = None
) -> tuple[Agreement, int]:
    """The agreement of a method with the truth over a recording, and the stride between the judged frames.

    said: labels to use instead of the walls, for the frames that have true lines.
    """
    known = (
        None
        if said is None
        else {recording.position(frame): each for frame, each in said.items() if each.lines is not None}
    )
    frames = np.arange(len(recording)) if known is None else np.array(list(known))
    stride = -(-len(frames) // MOST_FRAMES)
    chosen = frames[::stride]
    part = recording.only(chosen)
    if known is None:
        return Agreement.of_all(each for each in agreements(part, params, method) if each is not None), stride
    labels = [known[int(frame)] for frame in chosen]
    found = agreements(part, params, method, lambda k: labels[k].truth(part[k]), lambda k: labels[k].ends)
    return Agreement.of_all(each for each in found if each is not None), stride


def agreement_told(agreement: Agreement) -> told.Agreement:
    """The numbers of the paper's Table 4 and more; null if undefined."""
    return {
        "trueLines": finite_or_none(agreement.true_lines),
        "segments": finite_or_none(agreement.segments),
        "matches": finite_or_none(agreement.matches),
        "trueRate": finite_or_none(agreement.true_rate),
        "falseRate": finite_or_none(agreement.false_rate),
        "neutral": finite_or_none(agreement.neutral),
        "neutralFalseRate": finite_or_none(agreement.neutral_false_rate),
        "completeness": finite_or_none(agreement.completeness),
        "splits": finite_or_none(agreement.splits),
        "merges": finite_or_none(agreement.merges),
        "endpointMedian": finite_or_none(agreement.endpoint_error(50)),
        "endpointMost": finite_or_none(agreement.endpoint_error(95)),
    }
