"""Scans as YAML with each number in a line of its own, such as "- 1.25", however the lists are nested and named."""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import StringIO
from typing import Any

from ruamel.yaml import YAML

from ..failing import plain
from ..scan import Recording
from .messages import recording_of_values
from .source import Reader, Source
from .tables.numbers import number_of

ITEM = re.compile(rb"((?:\s|- )*)- ([-+]?\.?(?:\d\S*|nan|inf|null|~))\s*$", re.IGNORECASE)
LEAST_ITEMS, MOST_OTHER, SAMPLE = 10, 4000, 60
NO_RETURN = (b"null", b"~", b".nan", b"nan")
HELD = "list "


class YamlScans(Reader):
    """Lists of ranges under names, in documents, or in other lists; or objects with ranges and angles."""

    format = "YAML"
    suffixes = ()
    expects = "lists of ranges, a number in each line"

    @staticmethod
    def recognises(head: bytes) -> bool:
        if b"- " not in head or b"\0" in head:
            return False
        lines = [line for line in head.splitlines() if line.strip()][:SAMPLE]
        items = [line for line in lines if ITEM.match(line)]
        # One list alone is a column of numbers.
        nested = any(b"- - " in line for line in items) or len(items) < len(lines)
        return nested and len(items) >= LEAST_ITEMS and 2 * len(items) > len(lines)

    @staticmethod
    def read(source: Source) -> Recording:
        source.notes.kind = "YAML"
        recording = recording_of_values(source, _documents(source), YamlScans.format)
        if recording is None:
            raise ValueError(
                f"{source.name} is YAML without scans; scans are {YamlScans.expects}, or objects with ranges."
            )
        return recording


def _documents(source: Source) -> Iterator[tuple[str, Any]]:
    """(place, value): of each document. Only what is not a number goes through the parser, which is slow."""
    lists: list[list[float | None]] = []
    others = list(_folded(source, lists))
    if len(others) > MOST_OTHER + 8 * len(lists):
        raise ValueError(f"{source.name} is YAML with few lists of numbers; save its scans as CSV.")
    try:
        for value in YAML(typ="safe", pure=True).load_all(StringIO("\n".join(others))):
            yield source.name, _unfolded(value, lists)
    except Exception as error:  # for dates and numbers that cannot be, it has several kinds
        why = " ".join(plain(str(error)).split())[:120]
        raise ValueError(f"{source.name}: damaged YAML ({why}); save it again, or as CSV.") from None


def _folded(source: Source, lists: list[list[float | None]]) -> Iterator[str]:
    """The lines, with one for each run of numbers in a list, whose values are appended to `lists`."""
    indent = -1
    for _, line in source.lines():
        found = ITEM.match(line)
        if found is None:
            indent = -1
            yield line.decode("utf-8", "replace").replace("\t", "    ")
            continue
        before, word = found[1], found[2].lower()
        if b"-" in before or len(before) != indent:
            indent = len(before)
            yield f"{before.decode()}- {HELD}{len(lists)}"
            lists.append([])
        lists[-1].append(None if word in NO_RETURN else number_of(word.replace(b".inf", b"inf")))


def _unfolded(value: Any, lists: list[list[float | None]]) -> Any:
    if isinstance(value, list):
        if len(value) == 1 and isinstance(value[0], str) and value[0].startswith(HELD):
            return lists[int(value[0].removeprefix(HELD))]
        return [_unfolded(each, lists) for each in value]
    if isinstance(value, dict):
        return {str(key): _unfolded(held, lists) for key, held in value.items()}
    return value
