"""What a file was taken for: the Reading as used, what was guessed, what cannot be, and what was skipped."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import dataclass
from dataclasses import field as dataclass_field
from functools import cached_property
from typing import Any, NamedTuple

from .reading import Reading, as_flags

MOST_SKIPPED = 5


@dataclass(frozen=True)
class Guess:
    """A value that neither the file nor the Reading gave.

    field: of the Reading; value: as guessed; why: the reason; change: other values of the Reading to try.
    """

    field: str
    value: str
    why: str
    change: dict[str, Any] = dataclass_field(default_factory=dict)

    @property
    def text(self) -> str:
        """One sentence, with the flags that change the guess."""
        flag = as_flags(self.change) if self.change else f"--{self.field.replace('_', '-')}"
        is_guess = "are a guess" if self.value.endswith(" columns") else "is a guess"
        return f"{self.value} {is_guess}: {self.why}. To change it: {flag}"


@dataclass(frozen=True)
class Notice:
    """Something that cannot be, or is worth knowing. change: fields of the Reading that would mend it, {} if none."""

    kind: str
    text: str
    change: dict[str, Any] = dataclass_field(default_factory=dict)

    @property
    def advice(self) -> str:
        """The sentence, with the flags that mend it."""
        return f"{self.text} To do so: {as_flags(self.change)}" if self.change else self.text


@dataclass(frozen=True)
class Skipped:
    """A scan that could not be read. place: its line or message; why: what is wrong with it."""

    place: str
    why: str

    @property
    def text(self) -> str:
        """One sentence."""
        return f"{self.place}: {self.why}{'' if self.why.endswith('?') else '.'}"


class Findings(NamedTuple):
    """What takes a look at all ranges and stamps: the line, the notices and `stamp_trouble` of an `Account`."""

    line: str = ""
    notices: tuple[Notice, ...] = ()
    stamp_trouble: str = ""


@dataclass(frozen=True, eq=False)
class Account:
    """What a file was taken for.

    given: the Reading that was asked for; used: the same with all that was found in the file or guessed.
    skipped: some of the scans that could not be read; skips: how many there are; skipping: "line" if these are lines.
    lasers: if several lasers share the topic, the values of frame_id, or of geometry, that choose one of them.
    find: makes the findings when they are first asked for, so that opening a file does not wait for them.
    """

    given: Reading = dataclass_field(default_factory=Reading)
    used: Reading = dataclass_field(default_factory=Reading)
    guesses: tuple[Guess, ...] = ()
    skipped: tuple[Skipped, ...] = ()
    skips: int = 0
    skipping: str = "scan"
    lasers: Mapping[str, tuple[str, ...]] = dataclass_field(default_factory=dict)
    find: Callable[[], Findings] = dataclass_field(default=Findings, repr=False)

    @cached_property
    def findings(self) -> Findings:
        return self.find()

    @property
    def line(self) -> str:
        """One line that says what the file was taken for."""
        return self.findings.line

    @property
    def notices(self) -> tuple[Notice, ...]:
        """What cannot be, or is worth knowing."""
        return self.findings.notices

    @property
    def stamp_trouble(self) -> str:
        """Why the stamps cannot be believed, in a few words, "" if they can."""
        return self.findings.stamp_trouble

    def __getstate__(self) -> dict[str, Any]:
        """Copies and pickles have their findings, and no arrays to make them from."""
        return {**self.__dict__, "find": Findings, "findings": self.findings}

    @property
    def believable(self) -> bool:
        """Whether the stamps can be believed."""
        return not self.stamp_trouble

    @property
    def skipped_text(self) -> str:
        """One sentence about what was skipped, "" if nothing was."""
        if not self.skips:
            return ""
        were = " was" if self.skips == 1 else "s were"
        return f"{self.skips} {self.skipping}{were} skipped, the first at {self.skipped[0].text}"


class Notes:
    """Collects what a reader finds out besides the scans.

    unstated: fields of the Reading that the file does not give, so that they are to be guessed.
    found: fields of the Reading as the file gives them. stamps: where they come from, "" if there are none.
    recorded: when a bag's recorder received each scan [s]. publishers: a number for each scan, None
    if there is one. kind: the name of the format for the line, if another.
    radians: whether bearings were converted to radians already. lasers: as in `Account`.
    clockwise: why angles probably count clockwise, "" if nothing says so.
    """

    def __init__(self) -> None:
        self.unstated: set[str] = set()
        self.found: dict[str, Any] = {}
        self.stamps = ""
        self.kind = ""
        self.recorded: Any = None
        self.publishers: Any = None
        self.radians = False
        self.clockwise = ""
        self.lasers: dict[str, tuple[str, ...]] = {}
        self.guesses: list[Guess] = []
        self.notices: list[Notice] = []
        self.skipped: list[Skipped] = []
        self.skips = 0
        self.skipping = "scan"

    def so_far(self) -> Notes:
        """What was found out by now; what is added to it is not added here."""
        notes = copy(self)
        for name, value in vars(self).items():
            setattr(notes, name, copy(value))
        return notes

    def guess(self, field: str, value: str, why: str, **change: Any) -> None:
        self.guesses.append(Guess(field, value, why, change))

    def notice(self, kind: str, text: str, **change: Any) -> None:
        self.notices.append(Notice(kind, text, change))

    def skip(self, place: str, why: str, scans: int = 1) -> None:
        """Counts scans that cannot be read. place: file and line, or message."""
        self.skips += scans
        if scans and len(self.skipped) < MOST_SKIPPED:
            self.skipped.append(Skipped(place, why.rstrip(".")))

    def nothing_left(self) -> None:
        """Raises ValueError for the first scan that was skipped; for readers that are left with none."""
        if self.skipped:
            raise ValueError(self.skipped[0].text)
