"""A sentence as the page gets it: in parts, so that what it names can be pointed at in the scene.

The sentences of `lineseg` are plain text. They name things in one way only, and this is the one place that knows it:
"beam 12", "beams 12–40", "beams 12 and 13", "segment 3", "segments 3 and 4", a threshold by its symbol.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Annotated, NotRequired, TypeAlias

from typing_extensions import TypedDict

from lineseg import Thresholds
from lineseg.survey.remark import Ghost

from .typescript import As


class Link(TypedDict):
    """A part of a sentence that names something, and what it is.

    beams: the first and the last; segment: its number in the frame; threshold: its name; line: x1, y1, x2, y2 [m] of a
    line that the frame lacks.
    """

    text: str
    beams: NotRequired[tuple[int, int]]
    segment: NotRequired[int]
    threshold: NotRequired[str]
    line: NotRequired[Ghost]


Words: TypeAlias = Annotated[list[str | Link], As("Words")]

# The number of a segment in "segments 3 and 4" has the word in front of it, or the other number.
NAMES = r"(?P<beams>\bbeams? (?P<first>\d+)(?:(?:–| and )(?P<last>\d+))?)|(?P<segment>\bsegments? (?P<number>\d+))|"
NEXT = r"(?P<next>(?<=and )\d+)\b|"
LINE = r"(?P<line>\ban? \d+(?:\.\d+)? m line\b)|"


def words_of(text: str, params: type[Thresholds], ghosts: Sequence[Ghost] = ()) -> list[str | Link]:
    """The parts of a sentence, which joined are the sentence.

    params: of the method that it speaks of. ghosts: of its lines that the frame lacks, in the order in which it names
    them.
    """
    parts, at, lines = list[str | Link](), 0, iter(ghosts)
    several = -1
    for match in _names(params).finditer(text):
        if match["next"] and several != match.start() - len(" and "):
            continue
        named = _named(match, params, lines)
        if named is None:
            continue
        several = match.end() if match["segment"] and match["segment"].startswith("segments") else -1
        parts += [text[at : match.start()], named]
        at = match.end()
    return [part for part in (*parts, text[at:]) if part]


def _named(match: re.Match[str], params: type[Thresholds], lines: Iterator[Ghost]) -> Link | None:
    if match["beams"]:
        first = int(match["first"])
        return {"text": match[0], "beams": (first, int(match["last"] or first))}
    if match["segment"] or match["next"]:
        return {"text": match[0], "segment": int(match["number"] or match["next"])}
    if match["line"]:
        line = next(lines, None)
        return None if line is None else {"text": match[0], "line": line}
    return {"text": match[0], "threshold": _by_symbol(params)[match[0]]}


@lru_cache
def _by_symbol(params: type[Thresholds]) -> dict[str, str]:
    return {knob.symbol: name for name, _, knob in params.knobs()}


@lru_cache
def _names(params: type[Thresholds]) -> re.Pattern[str]:
    # A symbol that is a plain word, such as RANSAC's seed, is a threshold only before its value.
    symbols = sorted(_by_symbol(params), key=len, reverse=True)
    each = "|".join(re.escape(symbol) + (r"(?= =)" if re.fullmatch("[a-z]+", symbol) else "") for symbol in symbols)
    return re.compile(f"{NAMES}{NEXT}{LINE}" + rf"(?<!\w)(?:{each})(?!\w)")
