"""Scans as XML: elements or attributes with the names that JSON would have."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

from ..scan import Recording
from .messages import recording_of_values
from .source import Reader, Source
from .tables.numbers import all_numbers


class XmlScans(Reader):
    """Tables, or objects with ranges; an element that recurs is a list."""

    format = "XML"
    suffixes = (".xml",)
    expects = "elements or attributes with an angle and a distance each, or with ranges"

    @staticmethod
    def recognises(head: bytes) -> bool:
        start = head.removeprefix(b"\xef\xbb\xbf").lstrip()
        return start.startswith(b"<?xml") or (start[:1] == b"<" and start[1:2].isalpha() and b">" in start)

    @staticmethod
    def read(source: Source) -> Recording:
        text = source.path.read_bytes().strip(b"\0 \t\r\n")
        if b"<!DOCTYPE" in text[:4096] or b"<!ENTITY" in text[:4096]:
            raise ValueError(f"{source.name} has a document type, which is not read; save the scans as CSV.")
        try:
            root = ElementTree.fromstring(text)
        except ElementTree.ParseError as error:
            raise ValueError(f"{source.name}: damaged XML ({error}); save it again, or as CSV.") from None
        source.notes.kind = "XML"
        values = [(source.name, {_tag(root): _value(root)})]
        recording = recording_of_values(source, values, XmlScans.format)
        if recording is None:
            raise ValueError(f"{source.name} is XML of <{_tag(root)}> without scans; scans are {XmlScans.expects}.")
        return recording


def _tag(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2]


def _value(element: ElementTree.Element) -> Any:
    """An element as JSON would have it: an object, a list, a number or a text."""
    fields: dict[str, Any] = {name.rpartition("}")[2]: _plain(text) for name, text in element.attrib.items()}
    many: dict[str, list[Any]] = {}
    for child in element:
        many.setdefault(_tag(child), []).append(_value(child))
    fields |= {name: found if len(found) > 1 else found[0] for name, found in many.items()}
    if not fields:
        return _plain(element.text or "")
    only = next(iter(fields.values()))
    numbers = isinstance(only, list) and all(each is None or isinstance(each, int | float) for each in only)
    return only if len(fields) == 1 and numbers else fields


def _plain(text: str) -> Any:
    """The number, or the list of numbers, in a text; None if it is empty; else the text."""
    text = text.strip()
    values = all_numbers(text.encode()) if text else None
    if values is None or not len(values):
        return text or None
    return float(values[0]) if len(values) == 1 else values.tolist()
