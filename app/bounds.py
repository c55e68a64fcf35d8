"""Limits for all messages from the network, and one sentence that says what is wrong with a bad one."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, ValidationError

Name = Annotated[str, Field(max_length=300)]
# The id of a drawn world holds all of its walls.
RecordingId = Annotated[str, Field(max_length=8000)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Count = Annotated[int, Field(ge=0, le=2**31)]
Values = Annotated[dict[Name, int | Number], Field(max_length=64)]
ReadingValues = Annotated[dict[Name, str | int | Number | None], Field(max_length=64)]

LONGEST_WORD, LONGEST_REASON = 60, 300


class Message(BaseModel):
    """Unknown fields are refused: a misspelt name must not pass silently."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


def sentence(error: ValidationError) -> str:
    """The first complaint of a validation, with its place and what was found."""
    first, *others = error.errors(include_url=False, include_context=False)
    whole_or_not = any((*other["loc"][:-1], "int") == first["loc"] and other["loc"][-1] == "float" for other in others)
    loc = first["loc"][:-1] if whole_or_not else first["loc"]
    place = ".".join(_shown(" ".join(str(part).split())) for part in loc) or "the message"
    # pydantic quotes what it was sent, line ends and all.
    why = "it must be a number" if whole_or_not else _shown(" ".join(first["msg"].split()), LONGEST_REASON)
    return f"{place} is {_shown(repr(first['input']))}: {why[:1].lower()}{why[1:]}"


def _shown(word: str, longest: int = LONGEST_WORD) -> str:
    return word if len(word) <= longest else word[: longest - 3] + "…"
