"""Declares the fields of the View, and derives patches, links and the page's defaults from them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from functools import cache
from typing import Annotated, Any, Literal, Protocol, get_type_hints

from pydantic import BaseModel, Field, TypeAdapter, create_model

from .bounds import Message
from .told.typescript import As

# The link key of a field with several values: each value has its own name in the link.
EACH = "*"

Written = Literal["text", "whole", "choice", "thresholds", "pinned", "numbers", "switches", "reading"]


@dataclass(frozen=True, eq=False)
class ViewField:
    """The declaration of a field of the View, apart from its type and default.

    link: its key in a link; None: not in links. mirrored: whether a follower takes it from its presenter or keeps its
    own. reset_by: fields whose change resets it, to its default or to the result of `fresh`. off_by: fields that
    switch it off when they are set. lasting: whether it is still valid when a link to a live recording is opened
    later. choices: allowed values. patch: its type in a patch, if different. take: computes the value from the View
    and a patch; raises ValueError for a bad one. tell: converts the value to its form in a patch. written: its form in
    a link, if the type does not decide it. most: upper limit of its numbers.
    """

    link: str | None
    mirrored: bool
    reset_by: tuple[str, ...] = ()
    off_by: tuple[str, ...] = ()
    lasting: bool = True
    choices: Iterable[str] = ()
    fresh: Callable[[Any], Any] | None = None
    patch: Any = None
    take: Callable[[Any, Any], Any] = lambda view, value: value
    tell: Callable[[Any], Any] = lambda value: value
    written: Written | None = None
    most: float | None = None

    def taken(self, name: str, view: Any, value: Any) -> Any:
        """The value of the field `name` from a patch."""
        if self.choices and value not in self.choices:
            raise ValueError(f"there is no {name} {value!r}; choose from {', '.join(self.choices)}")
        return self.take(view, value)


class Viewlike(Protocol):
    """A dataclass with a ViewField and a default for each field."""

    def as_json(self) -> dict[str, Any]: ...


@cache
def view_fields(view: type[Viewlike]) -> dict[str, ViewField]:
    """The declaration of each field, in order. Raises TypeError for a field without one."""
    hints = get_type_hints(view, include_extras=True)
    declared: dict[str, ViewField] = {}
    for name in (entry.name for entry in fields(view)):  # type: ignore[arg-type]
        found = [each for each in getattr(hints[name], "__metadata__", ()) if isinstance(each, ViewField)]
        if not found:
            raise TypeError(f"{view.__name__}.{name} is not declared; it needs a ViewField")
        declared[name] = found[0]
    return declared


class Patch(Message):
    """Some fields of a View; the others stay unchanged."""

    def changes(self) -> dict[str, Any]:
        return self.model_dump(exclude_unset=True)


@cache
def patch_of(view: type[Viewlike]) -> type[Patch]:
    """The model of a patch of this View."""
    usual = view().as_json()
    # As a factory, because pydantic copies any other default for each message, although `changes` leaves it out.
    types: Any = {
        name: (patch_type, Field(default_factory=lambda value=usual[name]: value))
        for name, patch_type in _patch_types(view).items()
    }
    return create_model(f"{view.__name__}Patch", __base__=Patch, __module__=__name__, **types)


def _patch_types(view: type[Viewlike]) -> dict[str, Any]:
    hints = get_type_hints(view, include_extras=True)
    return {name: entry.patch or hints[name] for name, entry in view_fields(view).items()}


class FieldEntry(BaseModel):
    """A field of the View as sent to the page; see ViewField.

    default: {} where it depends on other fields. most: of a number, or of the length of a text.
    """

    name: str
    link: str | None
    written: Written | Literal["switch"]
    default: Annotated[Any, As("any")]
    choices: list[str]
    most: float | None
    mirrored: bool
    resetBy: list[str]  # noqa: N815
    lasting: bool


def field_entries(view: type[Viewlike]) -> list[FieldEntry]:
    """The description of each field for the page."""
    usual, types = view().as_json(), _patch_types(view)
    return [_entry(name, entry, types[name], usual[name]) for name, entry in view_fields(view).items()]


def _entry(name: str, entry: ViewField, patch_type: Any, default: Any) -> FieldEntry:
    schema = TypeAdapter(patch_type).json_schema()
    bounds = next((each for each in schema.get("anyOf", ()) if each.get("type") != "null"), schema)
    choices = list(entry.choices) or bounds.get("enum", [])
    plain: dict[str, Any] = {"string": "choice" if choices else "text", "integer": "whole", "boolean": "switch"}
    return FieldEntry(
        name=name,
        link=entry.link,
        written=entry.written or plain[bounds["type"]],
        default={} if entry.fresh else default,
        choices=choices,
        most=entry.most or bounds.get("maximum", bounds.get("maxLength")),
        mirrored=entry.mirrored,
        resetBy=list(entry.reset_by),
        lasting=entry.lasting,
    )


def page_module(view: type[Viewlike]) -> str:
    """The declaration as a module of the page, which reads a link before the first message arrives."""
    entries = [entry.model_dump() for entry in field_entries(view)]
    return f"export const VIEW = {json.dumps(entries, allow_nan=False)};\n"
