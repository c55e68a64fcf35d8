"""The method and its thresholds as flags, and the file that may stand behind them."""

from __future__ import annotations

import sys
from dataclasses import asdict, dataclass, field, make_dataclass
from pathlib import Path
from typing import Annotated, Any, TypeVar

from tyro.conf import OmitArgPrefixes, UseAppendAction, arg

from lineseg import EXTRACTORS, Extractor, Knob, Params, Thresholds
from lineseg.scan import Recording
from lineseg.tuning.proposal import propose
from lineseg.writers import read_params

T = TypeVar("T", bound=Thresholds)


def _flag(kind: type, knob: Knob, default: float) -> Any:
    """A flag that may be absent, so that a file of thresholds can stand behind it; its Knob says what it means."""
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
    """Which method, and its thresholds: by flags of their own for region growing, by --set for any.

    method: region-growing, or another method of the table in the README.
    set: NAME=VALUE of a threshold of the method, again and again.
    params: ROS 1 launch file, ROS 2 YAML or JSON with thresholds; flags come on top.
    """

    flags: OmitArgPrefixes[Flags] = field(default_factory=Flags)  # type: ignore[valid-type]
    method: str = "region-growing"
    set: UseAppendAction[tuple[str, ...]] = field(default=())
    params: Path | None = None

    @property
    def extractor(self) -> Extractor:
        return extractor_of(self.method)

    @property
    def thresholds(self) -> Thresholds:
        """The defaults, changed by what a file says, changed by the flags that were given."""
        kind = self.extractor.params_type
        base = kind() if self.params is None else read_file(self.params, kind)
        return changed(base, self.flags, **dict(map(_pair, self.set)))


def suggested(recording: Recording, present: Thresholds, method: str) -> Thresholds:
    """Thresholds that fit the recording; says on stderr which, or why none do."""
    found = propose(recording, present, method)
    print(found.text or "The thresholds fit this recording as they are.", file=sys.stderr)
    if found.changed:
        names = [name for name in present.names() if getattr(found.params, name) != getattr(present, name)]
        print("Used: " + ", ".join(f"{name} = {getattr(found.params, name):g}" for name in names), file=sys.stderr)
    return found.params


def changed(base: T, flags: Any, **others: float) -> T:
    """The thresholds with those that the flags give, and others."""
    given = {name: value for name, value in asdict(flags).items() if value is not None}
    return base.but(**given, **others)


def extractor_of(method: str) -> Extractor:
    if method not in EXTRACTORS:
        raise ValueError(f"there is no method {method!r}; there are {', '.join(EXTRACTORS)}.")
    return EXTRACTORS[method]


def read_file(file: Path, kind: type[Thresholds]) -> Thresholds:
    try:
        return read_params(file.read_text(encoding="utf-8-sig"), kind)
    except UnicodeDecodeError:
        raise ValueError(f"{file}: this is not text; a launch file, YAML or JSON is expected.") from None
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _pair(text: str) -> tuple[str, float]:
    name, equals, value = text.partition("=")
    if not equals:
        raise ValueError(f"--set {text}: a threshold is set by NAME=VALUE.")
    try:
        return name, float(value)
    except ValueError:
        raise ValueError(f"--set {text}: {value!r} is not a number.") from None
