"""What is wrong with the file of a lesson, told to its author: the line, what was found, and what was expected."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

Place = tuple[str | int, ...]
TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\],:]|[^\s{}\[\],:"]+')
LONGEST = 60
# How the lists of a lesson call one of their entries.
ONE_OF = {"steps": "step", "choice": "answer"}


class MistakeError(ValueError):
    """Something wrong at a place of a lesson."""

    def __init__(self, place: Place, why: str) -> None:
        super().__init__(why)
        self.place = place


def told(name: str, text: str, error: Exception, model: type[BaseModel]) -> str:
    """One sentence: file, line, place, what was found, and what was expected."""
    if isinstance(error, json.JSONDecodeError):
        return f"{name}:{error.lineno}: this is not JSON: {error.msg[:1].lower()}{error.msg[1:]}"
    if isinstance(error, UnicodeDecodeError):
        return f"{name}: this is not UTF-8 text; save the file as UTF-8"
    if isinstance(error, ValidationError):
        place, why = _complaint(error, model)
    elif isinstance(error, MistakeError):
        place, why = error.place, f"{_words(error.place)}: {error}" if error.place else str(error)
    else:
        return f"{name}: {error}"
    return f"{name}:{line_of(text, place)}: {why}"


def line_of(text: str, place: Sequence[str | int]) -> int:
    """The line, from 1, of a value in a JSON text; if it is not there, that of what it should be in."""
    path: list[str | int] = []
    depth, at, before = 0, 0, None

    def here(start: int) -> None:
        nonlocal depth, at
        if len(path) > depth and path == list(place[: len(path)]):
            depth, at = len(path), start

    for token in TOKEN.finditer(text):
        word = token[0]
        if path and isinstance(path[-1], int) and word not in ",]":
            here(token.start())
        if word in ("{", "["):
            path.append("" if word == "{" else 0)
        elif word in ("}", "]") and path:
            path.pop()
        elif word == ":" and path and before is not None:
            path[-1] = json.loads(before[0])
            here(before.start())
        elif word == "," and path and isinstance(path[-1], int):
            path[-1] += 1
        before = token
    return text.count("\n", 0, at) + 1


def _complaint(error: ValidationError, model: type[BaseModel]) -> tuple[Place, str]:
    """The place and the sentence of the first thing that a validation found."""
    first = error.errors(include_url=False, include_context=False)[0]
    place, found = first["loc"], repr(first["input"])
    where, name = _words(place[:-1]) or "a lesson", _short(str(place[-1])) if place else ""
    if first["type"] == "extra_forbidden":
        return place, f"{where} has no {name!r}; it may have {', '.join(_fields_at(model, place[:-1]))}"
    if first["type"] == "missing":
        return place[:-1], f"{where} needs {name!r}, which is missing"
    why = first["msg"].removeprefix("Value error, ")
    if isinstance(first["input"], dict):
        return place, f"{_words(place) or 'a lesson'}: {why}"
    shown = found if len(found) <= LONGEST else f"{found[:LONGEST]}…"
    return place, f"{_words(place)} is {shown}: {why[:1].lower()}{why[1:]}"


def _words(place: Place) -> str:
    """step 2, find.kind"""
    words = ""
    for k, part in enumerate(place):
        if isinstance(part, int):
            continue
        number = place[k + 1] if k + 1 < len(place) else None
        many = part in ONE_OF and isinstance(number, int)
        said = f"{ONE_OF[part]} {number + 1}" if many and isinstance(number, int) else _short(part)
        words += f"{', ' if words.endswith(tuple('0123456789')) else '.' if words else ''}{said}"
    return words


def _short(name: str) -> str:
    """A name from the file on one line."""
    name = " ".join(name.split())
    return name if len(name) <= LONGEST else f"{name[:LONGEST]}…"


def _fields_at(model: type[BaseModel], place: Place) -> list[str]:
    """The fields that may be at a place of a lesson."""
    for part in place:
        if isinstance(part, str) and part in model.model_fields:
            model = next(iter(_models_in(model.model_fields[part].annotation)), model)
    return list(model.model_fields)


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for each in get_args(annotation) for model in _models_in(each)]
