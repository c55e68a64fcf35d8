"""What comes in: the messages of the page on /api/session, and their bounds."""

from __future__ import annotations

import json
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from .told.messages import Where

Name = Annotated[str, Field(max_length=300)]
# The id of a drawn world holds all of its walls.
RecordingId = Annotated[str, Field(max_length=8000)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Count = Annotated[int, Field(ge=0, le=2**31)]


class Message(BaseModel):
    """Unknown fields are refused: a misspelt name must not pass silently."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Pinned(Message):
    method: Name
    params: Annotated[dict[Name, int | Number], Field(max_length=64)] = {}


class ViewPatch(Message):
    """Some fields of a View; those that were not sent stay as they are."""

    recording: RecordingId = ""
    topic: Name | None = None
    frame: Count = 0
    method: Name = ""
    params: Annotated[dict[Name, int | Number], Field(max_length=64)] = {}
    step: Count | None = None
    layers: Annotated[dict[Name, bool], Field(max_length=64)] = {}
    selected: Count | None = None
    camera: Literal["plan", "free"] = "plan"
    dark: bool = False
    mode: Literal["tune", "learn", "inspect"] = "tune"
    score: Name = ""
    against: Pinned | None = None
    weights: Annotated[dict[Name, int | Number], Field(max_length=64)] = {}
    reference: Literal["labels", "wall"] = "labels"
    live: bool = True

    def changes(self) -> dict[str, Any]:
        return self.model_dump(exclude_unset=True)


class Hello(Message):
    """The first message: which session to take up again, if it is still there, and what to look at."""

    type: Literal["hello"]
    session: Annotated[str, Field(max_length=64)] | None = None
    view: ViewPatch | None = None
    rev: Count | None = None
    follow: Annotated[str, Field(max_length=64)] | None = None


class Change(Message):
    type: Literal["view"]
    rev: Count
    patch: ViewPatch


class Cancel(Message):
    type: Literal["cancel"]


class Close(Message):
    type: Literal["close"]


class Follow(Message):
    """Mirror the tab that shows itself under this id; null: no more."""

    type: Literal["follow"]
    id: Annotated[str, Field(max_length=64)] | None


Incoming = Annotated[Hello | Change | Cancel | Close | Follow, Field(discriminator="type")]
_INCOMING: TypeAdapter[Hello | Change | Cancel | Close | Follow] = TypeAdapter(Incoming)
LONGEST_MESSAGE = 64 * 1024


class BadMessageError(ValueError):
    """A message that cannot be taken; `where` and `rev` as in Failure."""

    def __init__(self, sentence: str, where: Where = "view", rev: int | None = None) -> None:
        super().__init__(sentence)
        self.where: Where = where
        self.rev = rev


def parse(text: str) -> Hello | Change | Cancel | Close | Follow:
    """A message of the page; BadMessageError with one sentence if it is none."""
    if len(text) > LONGEST_MESSAGE:
        raise BadMessageError(f"a message of {len(text)} characters; {LONGEST_MESSAGE} are the most")
    try:
        return _INCOMING.validate_json(text)
    except ValidationError as error:
        where = "params" if "params" in error.errors()[0]["loc"] else "view"
        raise BadMessageError(sentence(error), where, _rev_of(text)) from None


def _rev_of(text: str) -> int | None:
    """The revision of a message that is bad elsewhere, so that the page learns which of its changes failed."""
    try:
        rev = json.loads(text)["rev"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    return rev if type(rev) is int and 0 <= rev <= 2**31 else None


def sentence(error: ValidationError) -> str:
    """The first complaint of a validation, with its place and what was found."""
    first = error.errors(include_url=False, include_context=False)[0]
    place = ".".join(str(part) for part in first["loc"]) or "the message"
    found = repr(first["input"])
    shown = found if len(found) <= 60 else found[:57] + "…"
    return f"{place} is {shown}: {first['msg'][:1].lower()}{first['msg'][1:]}"
