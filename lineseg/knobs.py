"""Thresholds, declared once for the command line, sliders, presets, URL and ROS export."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any, Self, TypeVar, get_type_hints

T = TypeVar("T")


@dataclass(frozen=True)
class Knob:
    """The name, display and bounds of a threshold.

    symbol: as in the paper; ros: its name in the ROS program that has it ("" if none has).
    low, high: the range of the slider; least, most: the allowed range; why: the reason for it.
    step: of a slider [unit]; log: whether the slider is logarithmic; extension: not in the paper.
    refuses: what is said of what it refuses, in the fields of `Sentence`: a check of this name is then there for the
    kernels; floor: it refuses what is below it, not what is above. counted: what its histogram counts, if it has one.
    scatter: of a threshold that follows the noise, how many times as large it is as ε; 0 for all others.
    equation, lesson: where the paper and which lesson explain it, "" for none.
    growth: of a threshold by which ε grows with the range, what share of the growth of the noise it follows; or 0.
    """

    symbol: str
    low: float
    high: float
    unit: str = ""
    step: float = 1
    log: bool = False
    least: float = 0.0
    most: float = math.inf
    why: str = ""
    ros: str = ""
    label: str = ""
    help: str = ""
    extension: bool = False
    refuses: str = ""
    counted: str = ""
    floor: bool = False
    scatter: float = 0.0
    growth: float = 0.0
    equation: str = ""
    lesson: str = ""

    def told(self, value: float) -> str:
        """The threshold and a value in words: ε = 0.03 m."""
        return f"{self.symbol} = {value:g}{f' {self.unit}' if self.unit else ''}"

    def reaching(self, *values: float) -> Knob:
        """The same with a slider that reaches these values: an end that is too near moves to the next round number."""
        low, high = min(values), max(values)
        if self.low <= low and high <= self.high:
            return self
        return replace(
            self,
            low=self.low if low >= self.low else max(max(each for each in _round(low) if each <= low), self.least),
            high=self.high if high <= self.high else min(min(each for each in _round(high) if each >= high), self.most),
        )


def _round(value: float) -> tuple[float, ...]:
    """The round numbers around a value, one of them on each side: 1, 2 and 5 times powers of ten."""
    if value <= 0.0:
        return (value,)
    unit = 10.0 ** math.floor(math.log10(value))
    return tuple(float(f"{step * unit:.3g}") for step in (1, 2, 5, 10))


def switch(symbol: str, label: str, help: str) -> Knob:
    """The knob of a switch; on and off are the numbers 1 and 0."""
    return Knob(symbol, 0, 1, most=1, why="it is on (1) or off (0)", label=label, help=help)


class Thresholds:
    """Base class for the thresholds of a method: a frozen dataclass with a Knob on each field."""

    def __post_init__(self) -> None:
        for name, kind, knob in self.knobs():
            object.__setattr__(self, name, _checked(name, getattr(self, name), kind, knob))

    @classmethod
    @cache
    def knobs(cls) -> tuple[tuple[str, type, Knob], ...]:
        """(field, int, float or bool, knob) of each threshold, in the order of the sliders."""
        hints = get_type_hints(cls, include_extras=True)
        return tuple((name, hints[name].__origin__, hints[name].__metadata__[0]) for name in cls.names())

    @classmethod
    @cache
    def names(cls) -> tuple[str, ...]:
        return tuple(entry.name for entry in fields(cls))  # type: ignore[arg-type]

    def but(self, /, **values: Any) -> Self:
        """A copy with some thresholds changed. Raises ValueError, listing the known names, for an unknown one."""
        for name in values:
            if name not in self.names():
                raise ValueError(f"there is no threshold {name!r}; choose from {', '.join(self.names())}")
        # Those of `self` were checked when it was made.
        checked = {
            name: _checked(name, values[name], kind, knob) for name, kind, knob in self.knobs() if name in values
        }
        return replaced(self, checked)

    def numbers(self) -> dict[str, int | float]:
        """The values by name; a switch is 1 or 0."""
        values = {name: getattr(self, name) for name in self.names()}
        return {name: int(value) if isinstance(value, bool) else value for name, value in values.items()}


def replaced(instance: T, values: Mapping[str, Any]) -> T:
    """A copy of a frozen dataclass with other values, unchecked; ten times as fast as `dataclasses.replace`."""
    copy = object.__new__(type(instance))
    vars(copy).update(vars(instance), **values)
    return copy


def _checked(name: str, value: Any, kind: type, knob: Knob) -> int | float | bool:
    """`value` as `kind`. Raises ValueError naming the field, the value, the allowed range and the reason."""
    unit = f" {knob.unit}" if knob.unit else ""
    allowed = f"allowed: {knob.least:g} to {knob.most:g}{unit}"
    whole = "" if kind is float else "whole numbers only, "
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name} is {value!r:.60}, which is not a number; {whole}{allowed}") from None
    if isinstance(value, str | bytes) or (isinstance(value, bool) and kind is not bool) or math.isnan(number):
        raise ValueError(f"{name} is {value!r:.60}, which is not a number; {whole}{allowed}")
    if kind is not float and not number.is_integer():
        raise ValueError(f"{name} is {value!r}, which is not a whole number; {allowed}")
    if not knob.least <= number <= knob.most:
        raise ValueError(f"{name} is {number:g}; {knob.why} ({allowed})")
    return kind(number)
