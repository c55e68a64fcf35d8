"""Matrices as text: what MATLAB's scripts assign, and what Octave saves."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections import ChainMap
from collections.abc import Iterable, Iterator, Mapping, MutableMapping
from dataclasses import replace
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scan import Recording
from .arrays import is_exchange, recording_of_arrays
from .containers.bounded import Budget, TooLargeError
from .npz import recording_of_exchange
from .reading import RADIANS
from .source import Reader, Source
from .tables.headers import LENGTHS, TURNS, Name, field_of, name_of
from .tables.numbers import all_numbers

OCTAVE = b"# Created by Octave"
MATRIX = re.compile(rb"^[ \t]*[A-Za-z][\w.]*[ \t]*=[ \t]*\(?\[", re.MULTILINE)
# Lines of Python, TOML and YAML do not end so.
LINE_END = re.compile(rb"(?:;|\.\.\.)[ \t]*\r?$", re.MULTILINE)
COMMENT = re.compile(r"[%#].*$", re.MULTILINE)
# None of these may read a long run of characters again for each character of it.
CONTINUED = re.compile(r"\.\.\.[^\n]*(?:\n|\Z)")
STATEMENT = re.compile(r"(?<![\w.])([A-Za-z][\w.]*)\s*=(?!=)\s*")
BRACKETS = re.compile(r"\[([^\[\]]*)\]('?)")
COLON = re.compile(r"\(?([^:()]+):([^:()]+)(?::([^:()]+))?\)?(\s*[*/].*)?")
OPERATORS: dict[type, Any] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.USub: operator.neg, ast.UAdd: operator.pos,
}  # fmt: skip
MOST_VALUES = 1 << 24
# Of a value.
BYTES = 8
LONGEST_EXPRESSION = 4000
Value = float | NDArray[np.float64]


class Matlab(Reader):
    """Variables with matrices. Scalars, a:b:c, linspace and arithmetic are followed, other statements passed over."""

    format = "MATLAB"
    suffixes = (".m",)
    expects = "matrices such as ranges = [1.2 1.3; 1.4 1.5];"

    @staticmethod
    def recognises(head: bytes) -> bool:
        if head.startswith(OCTAVE):
            return True
        return (
            b"[" in head
            and b"=" in head
            and b"\0" not in head
            and MATRIX.search(head) is not None
            and LINE_END.search(head) is not None
        )

    @staticmethod
    def read(source: Source) -> Recording:
        text = source.path.read_bytes().decode("utf-8", "replace")
        budget = Budget(source.name, len(text))
        pairs = _saved(text) if text.startswith(OCTAVE.decode()) else _assigned(text, budget)
        found: list[tuple[str, Value]] = []
        for name, value in pairs:
            budget.spend(np.asarray(value).nbytes)
            found.append((name, value))
        if not found:
            raise ValueError(f"{source.name} has no matrix; it needs {Matlab.expects}")
        return recording_of_variables(source, found, Matlab.format)


def recording_of_variables(source: Source, pairs: Iterable[tuple[str, Value]], format: str) -> Recording:
    """The scans of variables with names, of which fields of structs are joined by points."""
    arrays: dict[str, NDArray[Any]] = {}
    names: dict[str, str] = {}
    left: dict[str, list[str]] = {}
    for name, value in pairs:
        last = name.split(".")[-1]
        meant = field_of(name_of(last)) or last
        if names.setdefault(meant, name) == name:
            arrays[meant] = _in_own_unit(source, name_of(last), np.squeeze(np.asarray(value)))
        else:
            left.setdefault(meant, []).append(name)
    if "ranges" in left:
        others = ", ".join(chain.from_iterable(left.values()))
        text = f"{names['ranges']} was read; {others} were not: save each laser in a file of its own to read them."
        source.notes.notice("left out", text)
    low = arrays.get("angle_min", np.empty(0))
    if low.size == 1 and not {"angle_increment", "angle_max", "bearings"} & arrays.keys():
        # The step is that of a common laser, or given.
        del arrays["angle_min"]
        angle_min = float(low) if source.reading.angle_min is None else source.reading.angle_min
        source = replace(source, reading=source.reading.but(angle_min=angle_min))
    if not is_exchange(arrays):
        return recording_of_arrays(source, arrays, format)
    source.notes.unstated |= {"unit", "range_max"} - ({"range_max"} & arrays.keys()) - source.notes.found.keys()
    return recording_of_exchange(source, arrays, format)


def _in_own_unit(source: Source, name: Name, values: NDArray[Any]) -> NDArray[Any]:
    """Values in radians if their name gives another unit of angles; the unit of ranges is noted."""
    field = field_of(name)
    if field == "ranges" and (unit := LENGTHS.get(name.unit)) and source.reading.unit is None:
        source.notes.found["unit"] = unit
    if field in ("angle_min", "angle_max", "angle_increment") and name.unit in TURNS:
        return values * RADIANS[TURNS[name.unit]] * name.scale
    return values


# MATLAB


def _assigned(text: str, budget: Budget) -> Iterator[tuple[str, Value]]:
    """(name, value) of the statements that are understood."""
    text = COMMENT.sub("", CONTINUED.sub(" ", text))
    known: dict[str, Value] = {"pi": np.pi}
    at = 0
    while found := STATEMENT.search(text, at):
        at = found.end()
        matrices: dict[str, Value] = {}
        expression = list[str]()
        while at < len(text) and text[at] not in ";\n":
            if text[at] == "[":
                brackets = BRACKETS.match(text, at)
                matrix = _matrix(brackets[1]) if brackets else None
                if brackets is None or matrix is None:
                    break
                expression.append(f"matrix{len(matrices)}")
                matrices[expression[-1]] = matrix.T if brackets[2] else matrix
                at = brackets.end()
            else:
                expression.append(text[at])
                at += 1
        value = _value("".join(expression).strip(" ,\t\r"), ChainMap(matrices, known), budget)
        if value is not None:
            known[found[1]] = value
            yield found[1], value


def _matrix(text: str) -> NDArray[np.float64] | None:
    """The rows between two brackets; None if they are not numbers, or vary in length."""
    rows = [all_numbers(row.encode()) for row in re.split(r"[;\n]", text) if row.strip(" ,\t\r")]
    if not rows or any(row is None or len(row) != len(rows[0] if rows[0] is not None else ()) for row in rows):
        return None
    return np.array(rows, np.float64)


def _value(expression: str, known: MutableMapping[str, Value], budget: Budget) -> Value | None:
    """The value of an expression; None if it is not understood. What is made on the way is spent too, because it takes
    time.
    """
    if len(expression) > LONGEST_EXPRESSION:
        return None
    expression = expression.replace(".*", "*").replace("./", "/")
    try:
        if found := COLON.fullmatch(expression):
            first, *middle, last = (float(_of(part, known, budget)) for part in found.groups()[:3] if part)
            step = middle[0] if middle else 1.0
            steps = np.floor((last - first) / step + 1e-9)
            if not 0 <= steps < MOST_VALUES:
                return None
            budget.spend(BYTES * int(steps + 1))
            values = first + step * np.arange(steps + 1)
            return _of(f"values{found[4] or ''}", ChainMap({"values": values}, known), budget)
        return _of(expression, known, budget)
    except TooLargeError:
        raise
    except (ValueError, TypeError, KeyError, SyntaxError, ZeroDivisionError, OverflowError, RecursionError):
        return None


def _of(expression: str, known: Mapping[str, Value], budget: Budget) -> Value:
    return _evaluated(ast.parse(expression.strip(), mode="eval").body, known, budget)


def _evaluated(node: ast.AST, known: Mapping[str, Value], budget: Budget) -> Value:
    def made(operator: Any, *nodes: ast.AST) -> Value:
        values = [_evaluated(each, known, budget) for each in nodes]
        # A column and a row make a table.
        budget.spend(BYTES * math.prod(np.broadcast_shapes(*map(np.shape, values))))
        return operator(*values)

    match node:
        case ast.Constant(value=int() | float() as value):
            return float(value)
        case ast.Name(id=name):
            return known[name]
        case ast.UnaryOp(op=op, operand=operand):
            return made(OPERATORS[type(op)], operand)
        case ast.BinOp(left=left, op=op, right=right):
            return made(OPERATORS[type(op)], left, right)
        case ast.Call(func=ast.Name(id="deg2rad"), args=[value]):
            return made(np.deg2rad, value)
        case ast.Call(func=ast.Name(id="linspace"), args=[first, last, count]):
            start, stop, number = (float(_evaluated(each, known, budget)) for each in (first, last, count))
            if not 1 <= number < MOST_VALUES:
                raise ValueError
            budget.spend(BYTES * int(number))
            return np.linspace(start, stop, int(number))
    raise ValueError


# Octave


def _saved(text: str) -> Iterator[tuple[str, Value]]:
    """(name, value) of the matrices and scalars of a file that Octave has saved."""
    for block in re.split(r"^# name: ", text, flags=re.MULTILINE)[1:]:
        name, _, rest = block.partition("\n")
        lines = [line for line in rest.splitlines() if line.strip() and not line.startswith("#")]
        rows = [all_numbers(line.replace("NA", "NaN").encode()) for line in lines]
        if rows and all(row is not None and len(row) == len(rows[0] if rows[0] is not None else ()) for row in rows):
            table = np.array(rows, np.float64)
            yield name.strip(), float(table[0, 0]) if table.size == 1 else table
