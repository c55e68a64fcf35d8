"""What one browser tab looks at."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any

from lineseg import EXTRACTORS, Params, Thresholds
from lineseg.doubt import SCORES, Score
from lineseg.doubt.suspicion import WEIGHTS

DIFFERENCE = Score(
    "difference",
    "differences from A",
    "",
    "Lines lost, gained, split and merged from the pinned result A to the present one.",
    "higher",
    least=1.0,
    weight=0.0,
)
MOST_WEIGHT = 10.0
SUSPICION = Score(
    "suspicion",
    "suspicion",
    "",
    "All scores together: how far each stands out, to its doubtful side, from the recording and from the frames "
    "around; their mean, by the weights.",
    "higher",
    least=0.5,
    weight=0.0,
)
STRIP_SCORES = {**SCORES, SUSPICION.name: SUSPICION, DIFFERENCE.name: DIFFERENCE}


@dataclass(frozen=True)
class Layers:
    """What is drawn; `replay` is the geometry of the decision under view."""

    points: bool = True
    invalid: bool = False
    seeds: bool = True
    segments: bool = True
    endpoints: bool = True
    normals: bool = False
    dropped: bool = True
    truth: bool = False
    verdicts: bool = False
    laser: bool = True
    grid: bool = True
    replay: bool = True

    def but(self, **values: bool) -> Layers:
        """These layers with some of them switched; an unknown name is a ValueError that lists the known ones."""
        known = [entry.name for entry in fields(self)]
        for name in values:
            if name not in known:
                raise ValueError(f"there is no layer {name!r}; there are {', '.join(known)}")
        return replace(self, **values)


@dataclass(frozen=True)
class Against:
    """A, the result that was pinned: it stands beside that of the View, B."""

    method: str
    params: Thresholds

    @classmethod
    def of(cls, method: str, params: Mapping[str, Any]) -> Against:
        """A bad value is a ValueError that names it."""
        if method not in EXTRACTORS:
            raise ValueError(f"there is no method {method!r}; there are {', '.join(EXTRACTORS)}")
        return cls(method, EXTRACTORS[method].params_type().but(**params))

    def numbers(self) -> dict[str, Any]:
        """As `of` takes it."""
        return {"method": self.method, "params": self.params.numbers()}


@dataclass(frozen=True)
class View:
    """The whole state of a tab; it hashes, and two equal Views are drawn alike.

    step: the decision after which the replay stands, or None where the whole result is shown.
    selected: the beam whose fate is explained, or None. dark: whether the page has dark colours. score: of the strip.
    against: what it is compared with. weights: of the suspicion, where they are not the usual ones.
    reference: by what segments are judged where both are there, "labels" of people or the "wall" of the recording.
    live: whether the newest frame of a live recording is followed; else the recording stays as it was then.
    """

    recording: str = ""
    topic: str | None = None
    frame: int = 0
    method: str = "region-growing"
    params: Thresholds = field(default_factory=Params)
    step: int | None = None
    layers: Layers = field(default_factory=Layers)
    selected: int | None = None
    camera: str = "plan"
    dark: bool = False
    mode: str = "tune"
    score: str = "coverage"
    against: Against | None = None
    weights: tuple[tuple[str, float], ...] = ()
    reference: str = "labels"
    live: bool = True

    def patched(self, patch: Mapping[str, Any]) -> View:
        """This View with some fields changed; `params` and `layers` may name only some of theirs.

        Another recording or topic begins at its frame 0, and another frame has another trace: frame, step and selected
        start afresh unless the patch carries them. Who chooses a frame or a step follows no longer. Another method
        begins with its defaults. A bad value is a ValueError that names it.
        """
        known = {entry.name for entry in fields(self)}
        for name in patch:
            if name not in known:
                raise ValueError(f"a view has no {name!r}; it has {', '.join(sorted(known))}")
        changes: dict[str, Any] = dict(patch)
        if changes.get("method", self.method) not in EXTRACTORS:
            raise ValueError(f"there is no method {changes['method']!r}; there are {', '.join(EXTRACTORS)}")
        if changes.get("score", self.score) not in STRIP_SCORES:
            raise ValueError(f"there is no score {changes['score']!r}; there are {', '.join(STRIP_SCORES)}")
        if "weights" in changes:
            changes["weights"] = _weights({**dict(self.weights), **changes["weights"]})
        if changes.get("against") is not None:
            changes["against"] = Against.of(**changes["against"])
        method = changes.get("method", self.method)
        params = self.params if method == self.method else EXTRACTORS[method].params_type()
        changes["params"] = params.but(**changes.get("params", {}))
        if method != self.method:
            changes = {"step": None} | changes
        if "layers" in changes:
            changes["layers"] = self.layers.but(**changes["layers"])
        if changes.get("recording", self.recording) != self.recording:
            changes = {"topic": None, "frame": 0, "step": None, "selected": None, "live": True} | changes
        elif changes.get("topic", self.topic) != self.topic:
            changes = {"frame": 0, "step": None, "selected": None} | changes
        elif changes.get("frame", self.frame) != self.frame or changes.get("step") is not None:
            changes = {"live": False} | changes
        return replace(self, **changes)

    def salvaged(self, patch: Mapping[str, Any]) -> tuple[View, str | None]:
        """This View with all of a patch that can be had, as from a link; and a complaint about what can not."""
        order = sorted(patch, key=lambda name: name not in ("recording", "topic", "method"))
        parts = [
            {name: {key: value}} if name in ("params", "layers") else {name: patch[name]}
            for name in order
            for key, value in (patch[name].items() if name in ("params", "layers") else [(name, patch[name])])
        ]
        view, complaint = self, None
        for part in parts:
            try:
                view = view.patched(part)
            except ValueError as error:
                complaint = complaint or str(error)
        return view, complaint

    @property
    def all_weights(self) -> dict[str, float]:
        """Of every score that the suspicion is made of."""
        return all_weights(self.weights)

    def as_json(self) -> dict[str, Any]:
        """This View as a patch that restores it."""
        return asdict(self) | {"weights": dict(self.weights)}


def all_weights(changed: tuple[tuple[str, float], ...]) -> dict[str, float]:
    """The usual weights, but for those that were changed."""
    return {**WEIGHTS, **dict(changed)}


def _weights(values: Mapping[str, float]) -> tuple[tuple[str, float], ...]:
    for name, weight in values.items():
        if name not in WEIGHTS:
            raise ValueError(f"weights has no {name!r}; it has {', '.join(WEIGHTS)}")
        if not 0 <= weight <= MOST_WEIGHT:
            raise ValueError(f"the weight of {name} is {weight}; it may be 0 to {MOST_WEIGHT:g}")
    return tuple(sorted((name, float(weight)) for name, weight in values.items() if weight != WEIGHTS[name]))
