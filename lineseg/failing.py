"""Turns errors of any kind into one sentence that names the place: libraries raise many over damaged input."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

log = logging.getLogger(__name__)
LONGEST = 600
DAMAGED = "a damaged or unknown file"
# Python's own words give advice to programmers.
DIGITS = re.compile(
    r"Exceeds the limit \(\d+ digits\) for integer string conversion.*?to increase the limit"
    r"(?: - Consider hexadecimal.*?conversion limits\.?)?"
)
# Archives whose offsets are damaged lead to reads before the beginning.
OFFSET = re.compile(r"\[Errno 22\] Invalid argument")
NUMBER = re.compile(r"\[Errno -?\d+\] |Error -?\d+ while decompressing data: ")


@contextmanager
def named(place: str, passed: tuple[type[Exception], ...] = (), what: str = DAMAGED) -> Iterator[None]:
    """Errors inside become a ValueError or OSError that says `place`, unless they do already.

    Whatever is neither was not expected: it is logged, with its traceback, and told with its kind. place: "" if the
    caller adds it. passed: what is left alone.
    """
    try:
        yield
    except passed:
        raise
    except Exception as error:
        sentence = sentence_of(error, place, what)
        if isinstance(error, OSError):
            raise type(error)(sentence) from None
        if isinstance(error, ValueError) and sentence == str(error):
            raise
        if isinstance(error, ValueError):
            raise ValueError(sentence) from None
        log.warning("%s", sentence, exc_info=True)
        raise ValueError(sentence) from None


def sentence_of(error: BaseException, place: str, what: str = DAMAGED) -> str:
    """One line about an error, which names the place."""
    start, text = f"{place}: " if place else "", _line(str(error))
    if isinstance(error, MemoryError):
        return f"{start}there is not enough memory for it; try a smaller one."
    if isinstance(error, OSError) and error.strerror:
        return f"{start}{error.strerror}."
    if isinstance(error, UnicodeError):
        return f"{start}{what}; it has bytes that are not text ({text})."
    if isinstance(error, (ValueError, OSError)) and text:
        return text if place in text else f"{start}{text}"
    return f"{start}{what} ({type(error).__name__}{': ' + text if text else ''})."


def shown(path: Path | str) -> str:
    """A path or the name of a file, which may have bytes that are not text, as text."""
    return str(path).encode("utf-8", "surrogateescape").decode("utf-8", "replace")


def mistake(error: BaseException) -> str:
    """One line about an error that nobody expected."""
    return f"this is a mistake of lineseg; please report it: {type(error).__name__}: {_line(str(error))}"


def plain(text: str) -> str:
    """The text of an error without its number, and without Python's advice about numbers of thousands of digits."""
    text = OFFSET.sub("an offset in it points outside of it", text)
    return DIGITS.sub("a whole number has more digits than can be read", NUMBER.sub("", text))


def reason(error: BaseException) -> str:
    """The text of an error, to be put in brackets."""
    return plain(str(error)).rstrip(".")


def _line(text: str) -> str:
    """The text in one line that can be encoded, and not too long."""
    line = plain(" ".join(text.encode("utf-8", "backslashreplace").decode().split()))
    return line if len(line) <= LONGEST else line[: LONGEST - 1] + "…"
