"""What comes in: the messages of the page on /api/session, and their bounds."""

from __future__ import annotations

import json
from typing import Annotated, Literal

from pydantic import Field, JsonValue, TypeAdapter, ValidationError

from .bounds import Count, Message, sentence
from .told.messages import Where
from .told.typescript import As
from .view import View
from .view_field import patch_of

# What a link says of a View, which may be anything.
Said = Annotated[dict[str, JsonValue], As("Partial<View>")]


class ViewPatch(patch_of(View)):
    """Some fields of a View; those that were not sent stay as they are."""


class Hello(Message):
    """The first message: which session to take up again, if it is still there, and what to look at."""

    type: Literal["hello"]
    session: Annotated[str, Field(max_length=64)] | None = None
    view: Said | None = None
    rev: Count | None = None
    follow: Annotated[str, Field(max_length=64)] | None = None


class Change(Message):
    type: Literal["view"]
    rev: Count
    patch: ViewPatch


class OpenLink(Message):
    """Look at what a link says: at all of it that can be had."""

    type: Literal["link"]
    rev: Count
    patch: Said


class Cancel(Message):
    type: Literal["cancel"]


class Close(Message):
    type: Literal["close"]


class Follow(Message):
    """Mirror the tab that shows itself under this id; null: no more."""

    type: Literal["follow"]
    id: Annotated[str, Field(max_length=64)] | None


Incoming = Annotated[Hello | Change | OpenLink | Cancel | Close | Follow, Field(discriminator="type")]
_INCOMING: TypeAdapter[Hello | Change | OpenLink | Cancel | Close | Follow] = TypeAdapter(Incoming)
LONGEST_MESSAGE = 64 * 1024


class BadMessageError(ValueError):
    """A message that cannot be taken; `where` and `rev` as in Failure."""

    def __init__(self, sentence: str, where: Where = "view", rev: int | None = None) -> None:
        super().__init__(sentence)
        self.where: Where = where
        self.rev = rev


def parse(text: str) -> Hello | Change | OpenLink | Cancel | Close | Follow:
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
