"""Numbers in the texts of a lesson: placeholders, filled from the scan, the thresholds and the decisions.

`{epsilon}`: a threshold, as it is with this text. `{beams}`, `{returns}`: of the scan. `{lines}`, `{shortest}`,
`{longest}`: of the result. `{beam}`, `{first}`, `{last}`, `{points}`, `{value}`, `{limit}`, `{over}`: of the decision
that the text shows; `{aside}`: how far its first beam is from its line; `{joined}`: how far its beam would be from the
line fitted with it. `{NAME.beam}` and so on: of a decision that the lesson names in `decisions`; `{NAME.count}`: how
many match it. `:mm`, `:cm`, `:deg` after the name choose the unit.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from lineseg.extractors import EXTRACTORS
from lineseg.params import Params
from lineseg.scan import Scan
from lineseg.tracing.decisions import Decision, Trace

from ..fitting import fitted

if TYPE_CHECKING:
    from .lesson import Find, Named

METHOD = "region-growing"
PLACEHOLDER = re.compile(r"\{([^{}]*)\}")
UNITS: dict[str, Callable[[float], str]] = {
    "mm": lambda value: f"{1000 * value:.0f}\u00a0mm",
    "cm": lambda value: f"{100 * value:.0f}\u00a0cm",
    "deg": lambda value: f"{math.degrees(value):.1f}°",
}
OF_A_DECISION = ("beam", "first", "last", "points", "value", "limit", "over", "aside", "joined")


@dataclass(frozen=True)
class Numbers:
    """What one text can name: its scan, thresholds and decisions. usual: the thresholds of the lesson."""

    scan: Scan
    usual: Params
    params: Params
    shown: Find | None
    named: dict[str, Named]
    method: str = METHOD

    def fill(self, text: str) -> str:
        """Raises ValueError, naming the placeholder and what is known, for one that cannot be filled."""
        return PLACEHOLDER.sub(lambda found: self._fill(found[1]), text)

    def _fill(self, written: str) -> str:
        name, _, unit = written.partition(":")
        if unit and unit not in UNITS:
            raise ValueError(f"{{{written}}} has no unit of {', '.join(UNITS)}")
        value, usual_unit = self._value(name)
        return (UNITS[unit] if unit else usual_unit)(value)

    def _value(self, name: str) -> tuple[float, Callable[[float], str]]:
        """The number of this name, and how it is usually written."""
        of, _, field = name.rpartition(".")
        if of in self.named and field in (*OF_A_DECISION, "count"):
            named = self.named[of]
            traced = self._trace(named)
            return (len(found(traced, named)), _count) if field == "count" else self._of(traced, named, field)
        if not of and field in OF_A_DECISION and self.shown is not None:
            return self._of(self._traced, self.shown, field)
        for threshold, _, knob in self.params.knobs():
            if name == threshold:
                return self.params.numbers()[name], _angle if knob.unit == "rad" else _metres if knob.unit else _count
        if name in ("beams", "returns"):
            return len(self.scan) if name == "beams" else int(self.scan.valid.sum()), _count
        segments = self._traced.extraction.segments
        if name == "lines":
            return len(segments), _count
        if name in ("shortest", "longest") and segments:
            return (min if name == "shortest" else max)(segment.length for segment in segments), _metres
        known = [*OF_A_DECISION] if self.shown else []
        known += [f"{each}.{field}" for each in self.named for field in ("beam", "count")]
        known += ["beams", "returns", "lines", "shortest", "longest", *self.params.names()]
        raise ValueError(f"{{{name}}} is not known; there is {', '.join(known)}")

    def _of(self, traced: Trace, find: Find, field: str) -> tuple[float, Callable[[float], str]]:
        """A number of the decision that is found, and how it is usually written."""
        decision = the_one(traced, find)
        if field in ("beam", "first", "last", "points"):
            return getattr(decision, field), _count
        if field == "aside":
            a, b, c = decision.line
            x, y = self.scan.xy[decision.first]
            return abs(a * x + b * y + c), _metres
        if field == "joined":
            return self._joined(traced, decision), _metres
        value = abs(decision.value - decision.limit) if field == "over" else getattr(decision, field)
        return value, _WRITTEN.get(decision.check, _metres)

    def _joined(self, traced: Trace, decision: Decision) -> float:
        """The distance of the beam of a decision from the line that is fitted to its points and to this one."""
        if decision.beam < 0:
            raise ValueError(f"{{joined}}: “{decision.kind}” is about no single beam")
        beams = [*traced.beams(decision.first, decision.last), decision.beam]
        xy = self.scan.xy[[beam for beam in beams if self.scan.valid[beam]]]
        a, b, c = fitted(xy)
        return float(abs(xy[-1] @ (a, b) + c))

    def shown_decision(self) -> Decision | None:
        """The decision that the text shows. Raises ValueError if there is none such."""
        return the_one(self._traced, self.shown) if self.shown is not None else None

    @cached_property
    def _traced(self) -> Trace:
        return trace_by(self.scan, self.method, self.params)

    def _trace(self, named: Named) -> Trace:
        if not named.method and named.params is None and self.method == METHOD:
            return self._traced
        params = self.params if named.params is None else self.usual.but(**named.params)
        return trace_by(self.scan, named.method or METHOD, params)


def trace_by(scan: Scan, method: str, params: Params) -> Trace:
    """The decisions of region growing with these thresholds, or of another method with its own defaults."""
    extractor = EXTRACTORS[method]
    return extractor.trace(scan, params if extractor.params_type is Params else extractor.params_type())


def found(traced: Trace, find: Find) -> list[Decision]:
    """All decisions that have the properties."""
    # Only those of the kind are written out.
    of_kind = traced.at(traced.indices(find.kind)) if find.kind in traced.vocabulary.names else []
    return [
        decision
        for decision in of_kind
        if find.check in (None, decision.check)
        and find.direction in (None, decision.direction)
        and find.beam in (None, decision.beam)
    ]


def the_one(traced: Trace, find: Find) -> Decision:
    """The decision that is found. Raises ValueError if there is none."""
    matching = found(traced, find)
    if not -len(matching) <= find.nth < len(matching):
        kinds = sorted({decision.kind for decision in traced})
        more = f"there are {len(matching)} of these" if matching else f"there is {', '.join(kinds)}"
        raise ValueError(f"there is no “{find.kind}” with these properties and nth {find.nth}; {more}")
    return matching[find.nth]


def _count(value: float) -> str:
    return f"{value:g}"


def _metres(value: float) -> str:
    return f"{value:.3f}\u00a0m"


def _angle(value: float) -> str:
    return f"{value:g}\u00a0rad ({UNITS['deg'](value)})"


# Thresholds that are no lengths.
_WRITTEN: dict[str, Callable[[float], str]] = {
    name: UNITS["deg"] if knob.unit == "rad" else _count
    for name, kind, knob in Params.knobs()
    if kind is int or knob.unit == "rad"
}
