"""Pictures of many decisions and results, packed: what does not change is stored once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene.flat import DIGITS, code_of, look_of, shapes_of
from ..scene.looks import ORDER
from ..scene.palette import DARK, LIGHT, Theme, in_theme
from ..scene.picture import Picture
from ..told.handout import Look

SCALE = 10**DIGITS
NOTHING = -1


class Rows:
    """Distinct rows of numbers, by the order in which they came."""

    def __init__(self) -> None:
        self.rows: list[tuple[int, ...]] = []
        self._known: dict[tuple[int, ...], int] = {}

    def numbers_of(self, table: NDArray[np.int64]) -> NDArray[np.uint32]:
        """The number of each row."""
        numbers = []
        for row in map(tuple, table.tolist()):
            number = self._known.setdefault(row, len(self.rows))
            if number == len(self.rows):
                self.rows.append(row)
            numbers.append(number)
        return np.array(numbers, np.uint32)


class Pool:
    """Pictures drawn with the theme NUMBERED.

    A picture is a row of `moments`: for each look, the number of a list. A list is a stretch of `members`, from
    starts[k] to starts[k + 1]: points, or lines. Of each of them there are its colour and its coordinates.
    """

    def __init__(self) -> None:
        self._colours = Rows()
        self._shapes = {"points": Rows(), "lines": Rows()}
        self._lists: dict[bytes, int] = {}
        self._last: dict[str, tuple[NDArray[np.float32], NDArray[np.uint32]]] = {}
        self._members: list[NDArray[np.uint32]] = []
        self._moments: dict[tuple[int, ...], int] = {}
        self.moments: list[tuple[int, ...]] = []

    def add(self, picture: Picture) -> int:
        """The number of its moment, which is a new one."""
        row: dict[str, int] = dict.fromkeys(ORDER, NOTHING)
        for name, xy, colours in shapes_of(picture):
            row[name] = self._list_of(name, xy, colours)
        self.moments.append(tuple(row.values()))
        return len(self.moments) - 1

    def once(self, picture: Picture) -> int:
        """The number of its moment, the same for the same pictures."""
        moment = self.add(picture)
        known = self._moments.setdefault(self.moments[moment], moment)
        if known != moment:
            self.moments.pop()
        return known

    def _list_of(self, name: str, xy: NDArray[np.float32], colours: NDArray[np.uint8]) -> int:
        kind = look_of(name)["kind"]
        key = kind.encode() + xy.tobytes() + colours.tobytes()
        if key not in self._lists:
            self._lists[key] = len(self._members)
            self._members.append(self._numbered(name, kind, np.column_stack((colours.astype(np.float32), xy))))
        return self._lists[key]

    def _numbered(self, name: str, kind: str, shapes: NDArray[np.float32]) -> NDArray[np.uint32]:
        """The number of each shape (n, colour and coordinates); most are those of the last list of this name."""
        last, known = self._last.get(name, (shapes[:0], np.empty(0, np.uint32)))
        both = min(len(last), len(shapes))
        new = np.ones(len(shapes), np.bool_)
        new[:both] = (last[:both] != shapes[:both]).any(axis=1)
        numbers = np.empty(len(shapes), np.uint32)
        numbers[:both] = known[:both]
        tones = self._colours.numbers_of(shapes[new, :3].astype(np.int64)).astype(np.int64)
        places = np.round(shapes[new, 3:].astype(float) * SCALE).astype(np.int64)
        numbers[new] = self._shapes[kind].numbers_of(np.column_stack((tones, places)))
        self._last[name] = shapes, numbers
        return numbers

    @property
    def looks(self) -> list[Look]:
        return [look_of(name) for name in ORDER]

    def palette(self, theme: Theme) -> list[str]:
        """#rrggbb of each colour."""
        colours = np.array(self._colours.rows, dtype=np.uint8).reshape(-1, 3)
        return [code_of(colour) for colour in in_theme(colours, theme)]

    @property
    def palettes(self) -> tuple[list[str], list[str]]:
        """Light and dark."""
        return self.palette(LIGHT), self.palette(DARK)

    def arrays(self) -> dict[str, NDArray]:
        """All of it as columns, which a compression makes small."""
        lengths = [len(members) for members in self._members]
        arrays: dict[str, NDArray] = {
            "moments": np.array(self.moments, np.int32).reshape(-1, len(ORDER)).T,
            "starts": np.concatenate(([0], np.cumsum(lengths))).astype(np.uint32),
            "members": np.concatenate([np.empty(0, np.uint32), *self._members]),
        }
        for kind, width in (("points", 2), ("lines", 4)):
            table = np.array(self._shapes[kind].rows, np.int64).reshape(-1, 1 + width)
            arrays[f"{kind}_tone"] = table[:, 0].astype(np.uint8)
            for k in range(width):
                arrays[f"{kind}_{k}"] = table[:, 1 + k].astype(np.int32)
        return arrays
