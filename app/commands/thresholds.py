"""Flags for the method and its thresholds, and the file of thresholds that they override."""

from __future__ import annotations

import sys
from dataclasses import asdict, dataclass, make_dataclass
from pathlib import Path
from typing import Annotated, Any, TypeVar

from tyro.conf import UseAppendAction, arg

from lineseg import EXTRACTORS, Extractor, Knob, Params, Thresholds
from lineseg.scan import Recording
from lineseg.writers import read_params
from lineseg.writers.params_read import params_file

from .flag_types import Unset

T = TypeVar("T", bound=Thresholds)


def _flag(kind: type, knob: Knob, default: float) -> Any:
    """An optional flag, documented by its Knob; if absent, a file of thresholds or the default applies."""
    text = (
        f"{knob.symbol}{f' [{knob.unit}]' if knob.unit else ''}: {knob.help}{' (extension)' if knob.extension else ''}"
    )
    return Annotated[
        kind | None, arg(help=text, metavar=kind.__name__.upper(), help_behavior_hint=f"(default: {default})")
    ]


Flags: type = make_dataclass(
    "Flags",
    [(name, _flag(kind, knob, getattr(Params(), name)), None) for name, kind, knob in Params.knobs()],
    frozen=True,
)


@dataclass(frozen=True)
class Choice:
    """The method, and its thresholds with --set or from a file; those of region growing have flags of their own.

    Args:
        name: region-growing, or another method listed in the README.
        set: a threshold of the method.
        params: ROS 1 launch file, ROS 2 YAML or JSON with thresholds; flags override it.
    """

    name: Annotated[str, arg(name="method", metavar="NAME")] = "region-growing"
    set: Annotated[UseAppendAction[tuple[str, ...]], arg(metavar="NAME=VALUE")] = ()
    params: Annotated[Unset[Path], arg(metavar="FILE")] = None

    @property
    def extractor(self) -> Extractor:
        return extractor_of(self.name)

    def thresholds(self, flags: Any) -> Thresholds:
        """The defaults, overridden by the file, overridden by the flags."""
        kind = self.extractor.params_type
        return self.overriding(kind() if self.params is None else read_file(self.params, kind), flags)

    def overriding(self, base: Thresholds, flags: Any) -> Thresholds:
        """`base`, overridden by the flags."""
        return changed(base, flags, **dict(map(_pair, self.set)))


def suggested(recording: Recording, present: Thresholds, method: str) -> Thresholds:
    """Thresholds that fit the recording; prints them, or why there are none, on stderr."""
    from lineseg.proposal import propose

    found = propose(recording, present, method)
    print(found.text or "The present thresholds fit this recording.", file=sys.stderr)
    if found.changed:
        names = [name for name in present.names() if getattr(found.params, name) != getattr(present, name)]
        print("Used: " + ", ".join(f"{name} = {getattr(found.params, name):g}" for name in names), file=sys.stderr)
    return found.params


def changed(base: T, flags: Any, **others: float) -> T:
    """The thresholds, with the values given by flags and by --set."""
    given = {name: value for name, value in asdict(flags).items() if value is not None}
    return base.but(**given, **others)


def extractor_of(method: str) -> Extractor:
    if method not in EXTRACTORS:
        raise ValueError(f"there is no method {method!r}; choose from {', '.join(EXTRACTORS)}.")
    return EXTRACTORS[method]


def read_file(file: Path, kind: type[T]) -> T:
    """The thresholds in a file. Raises ValueError, which names it, if it has none, is no text, or is too long."""
    try:
        return read_params(params_file(file), kind)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _pair(text: str) -> tuple[str, float]:
    name, equals, value = text.partition("=")
    if not equals:
        raise ValueError(f"--set {text}: give NAME=VALUE.")
    try:
        return name, float(value)
    except ValueError:
        raise ValueError(f"--set {text}: {value!r} is not a number.") from None
