"""MAT files of MATLAB up to version 7: numbers, texts, structs and cells; other objects are passed over.

Source: MAT-File Format, MathWorks.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scan import Recording
from .containers.bounded import Budget, TooLargeError
from .matlab import recording_of_variables
from .messages import recording_of_values
from .source import Reader, Source
from .tables.headers import name_of

BEGINS = b"MATLAB 5.0 MAT-file"
HEADER, MATRIX, COMPRESSED = 128, 14, 15
# What numbers are stored as, by the number of the type.
STORED = {
    1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8", 16: "u1", 17: "u2",
    18: "u4",
}  # fmt: skip
CELL, STRUCT, TEXT, FIRST_NUMBER, LAST_NUMBER = 1, 2, 4, 6, 15
IS_COMPLEX = 0x0800
MOST_DEPTH, MOST_CELLS = 8, 1 << 20
# What Python keeps of an element or of a name [bytes], at least.
ELEMENT, NAME = 256, 64


class Element(NamedTuple):
    """kind: the number of its type."""

    kind: int
    data: memoryview


class MatFile(Reader):
    """Named arrays, also in structs; or cells of LaserScan messages, as MATLAB reads them from bags."""

    format = "MAT"
    suffixes = (".mat",)
    expects = "arrays, as save('scans.mat', '-v7') writes them"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith(BEGINS)

    @staticmethod
    def read(source: Source) -> Recording:
        data = source.path.read_bytes()
        order = ">" if data[126:128] == b"MI" else "<"
        budget = Budget(source.name, len(data))
        variables: dict[str, Any] = {}
        try:
            for element in _elements(memoryview(data)[HEADER:], order, budget):
                if element.kind == COMPRESSED:
                    plain = zlib.decompressobj().decompress(element.data, budget.left + 1)
                    budget.spend(len(plain))
                    element = next(_elements(memoryview(plain), order, budget))
                if element.kind == MATRIX:
                    name, value = _matrix(element.data, order, budget, 0)
                    if value is not None:
                        variables[name] = value
        except TooLargeError:
            raise
        except (ValueError, struct.error, zlib.error, IndexError, StopIteration) as error:
            if not variables:
                raise ValueError(f"{source.name}: a damaged MAT file ({error}); save it again.") from None
            source.notes.notice("breaks off", f"The file breaks off after {', '.join(variables)}.")
        return _recording(source, variables)


def _recording(source: Source, variables: dict[str, Any]) -> Recording:
    if any(isinstance(each, list) for each in variables.values()):
        found = recording_of_values(source, [(source.name, _plain(variables))], MatFile.format)
        if found is not None:
            return found
    arrays = list(_arrays(variables, ""))
    if not arrays:
        raise ValueError(
            f"{source.name} has no array of numbers; save them in MATLAB, as in ranges = scan.Ranges; angles = "
            "scan.Angles; save('scans.mat', 'ranges', 'angles', '-v7')."
        )
    return recording_of_variables(source, arrays, MatFile.format)


def _arrays(variables: dict[str, Any], prefix: str) -> Iterator[tuple[str, NDArray]]:
    """(name, array) of the arrays of numbers, also of those in structs."""
    for name, value in variables.items():
        if isinstance(value, dict):
            yield from _arrays(value, f"{prefix}{name}.")
        elif isinstance(value, np.ndarray):
            yield f"{prefix}{name}", value


def _plain(value: Any) -> Any:
    """Lists instead of arrays, and the names of fields as messages have them, such as angle_min for AngleMin."""
    if isinstance(value, dict):
        return {name_of(name).plain or name: _plain(each) for name, each in value.items()}
    if isinstance(value, list):
        return list(map(_plain, value))
    if isinstance(value, np.ndarray):
        numbers = np.squeeze(value).tolist()
        return int(numbers) if isinstance(numbers, float) and numbers.is_integer() else numbers
    return value


def _elements(data: memoryview, order: str, budget: Budget) -> Iterator[Element]:
    """The elements that lie one after the other. Raises ValueError if the last one breaks off."""
    at = 0
    while at + 8 <= len(data):
        kind, size = struct.unpack_from(f"{order}II", data, at)
        start = at + 8
        if kind >> 16:
            # A small one has its size and its data in the same eight bytes.
            kind, size, start = kind & 0xFFFF, kind >> 16, at + 4
        if start + size > len(data):
            raise ValueError("it breaks off")
        budget.spend(ELEMENT)
        yield Element(kind, data[start : start + size])
        # Those after a compressed one may lie anywhere.
        at = at + 8 if start == at + 4 else start + size + (-size % 8 if kind != COMPRESSED else 0)


def _matrix(data: memoryview, order: str, budget: Budget, depth: int) -> tuple[str, Any]:
    """The name and the value of a matrix: an array, a text, a dict for a struct, a list for cells or several structs;
    None for others."""
    parts = list(_elements(data, order, budget))
    if depth > MOST_DEPTH or len(parts) < 3:
        return "", None
    flags = int(_numbers(parts[0], order)[0])
    kind, shape = flags & 0xFF, [int(size) for size in _numbers(parts[1], order)]
    name, rest = bytes(parts[2].data).decode("latin-1"), parts[3:]
    if kind == CELL:
        return name, [_matrix(each.data, order, budget, depth + 1)[1] for each in rest[:MOST_CELLS]]
    if kind == STRUCT:
        return name, _structs(rest, order, budget, depth)
    if kind == TEXT and rest:
        letters = _numbers(rest[0], order)
        budget.spend(NAME * len(letters))
        return name, "".join(map(chr, letters))
    if not FIRST_NUMBER <= kind <= LAST_NUMBER or not rest:
        return name, None
    stored = _numbers(rest[0], order)
    budget.spend(stored.size * np.dtype(np.complex128 if flags & IS_COMPLEX else np.float64).itemsize)
    values = stored.astype(np.float64)
    if flags & IS_COMPLEX:
        values = values + 1j * _numbers(rest[1], order)
    return name, values.reshape(shape, order="F")


def _structs(parts: list[Element], order: str, budget: Budget, depth: int) -> Any:
    """A dict of the fields of a struct; a list of them for several, which lie one after the other."""
    longest = int(_numbers(parts[0], order)[0])
    letters = bytes(parts[1].data)
    budget.spend(NAME * (len(letters) // max(longest, 1)))
    names = [letters[at : at + longest].split(b"\0")[0].decode("latin-1") for at in range(0, len(letters), longest)]
    if not names:
        return {}
    values = [_matrix(each.data, order, budget, depth + 1)[1] for each in parts[2:][:MOST_CELLS]]
    found = [dict(zip(names, values[at : at + len(names)], strict=False)) for at in range(0, len(values), len(names))]
    return found[0] if len(found) == 1 else found


def _numbers(element: Element, order: str) -> NDArray:
    kind = STORED.get(element.kind)
    if kind is None:
        raise ValueError(f"it has numbers of an unknown kind, {element.kind}")
    return np.frombuffer(element.data, order + kind)
