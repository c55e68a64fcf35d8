"""The messages from the page on /api/session, and their bounds."""

from __future__ import annotations

import json
from typing import Annotated, Literal

from pydantic import Field, JsonValue, TypeAdapter, ValidationError

from .bounds import Count, Message, sentence
from .told.messages import Where
from .told.typescript import As
from .view import View
from .view_field import patch_of

# The View fields of a link, not yet checked.
Said = Annotated[dict[str, JsonValue], As("Partial<View>")]


class ViewPatch(patch_of(View)):
    """Some fields of a View; the others stay unchanged."""


class Hello(Message):
    """The first message: the session to resume, if it still exists, and the View."""

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
    """Apply a link: all of its fields that are valid."""

    type: Literal["link"]
    rev: Count
    patch: Said


class Cancel(Message):
    type: Literal["cancel"]


class Close(Message):
    type: Literal["close"]


class Follow(Message):
    """Mirror the tab with this presenter id; null stops mirroring."""

    type: Literal["follow"]
    id: Annotated[str, Field(max_length=64)] | None


Incoming = Hello | Change | OpenLink | Cancel | Close | Follow
_INCOMING: TypeAdapter[Incoming] = TypeAdapter(Annotated[Incoming, Field(discriminator="type")])
LONGEST_MESSAGE = 64 * 1024


class BadMessageError(ValueError):
    """A message that is not valid; `where` and `rev` as in Failure."""

    def __init__(self, sentence: str, where: Where = "view", rev: int | None = None) -> None:
        super().__init__(sentence)
        self.where: Where = where
        self.rev = rev


def parse(text: str) -> Incoming:
    """Parse a message of the page. Raises BadMessageError with one sentence if it is not valid."""
    if len(text) > LONGEST_MESSAGE:
        raise BadMessageError(f"the message has {len(text)} characters; send at most {LONGEST_MESSAGE}")
    try:
        return _INCOMING.validate_json(_whole(text))
    except ValidationError as error:
        where = "params" if "params" in error.errors()[0]["loc"] else "view"
        raise BadMessageError(sentence(error), where, _rev_of(text)) from None


def _whole(text: str) -> str:
    """The message with � for each half of a character: a page sends one as JSON can express it, pydantic takes none."""
    if "\\ud" not in text.lower():
        return text
    try:
        said = json.dumps(json.loads(text), ensure_ascii=False)
    except (ValueError, RecursionError):
        return text
    return said.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def _rev_of(text: str) -> int | None:
    """The revision of an invalid message, so that the page knows which of its changes failed."""
    try:
        rev = json.loads(text)["rev"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    return rev if type(rev) is int and 0 <= rev <= 2**31 else None
