"""How the shapes of a Picture look: sizes on the screen, and what lies over what."""

from __future__ import annotations

from typing import Literal

Shape = Literal["circle", "square", "diamond"]

# name: (size on the screen [pixels], which viser draws about twice as wide; shape)
CLOUDS: dict[str, tuple[float, Shape]] = {
    "past": (1.4, "circle"),
    "other lasers": (2.2, "circle"),
    "points": (2.2, "circle"),
    "seeds": (3.2, "square"),
    "endpoints": (4.5, "circle"),
    "window": (4.0, "circle"),
    "predicted": (5.0, "diamond"),
    "candidate": (5.5, "circle"),
    "outermost": (5.5, "circle"),
    "selected": (6.5, "diamond"),
}
# name: width on the screen [pixels]
LINES = {
    "grid": 1.0,
    "all lines": 1.2,
    "trajectory": 1.6,
    "line map": 2.6,
    "pinned": 9.0,
    "invalid": 1.0,
    "truth": 3.0,
    "dropped": 1.5,
    "segments": 3.0,
    "missed": 7.0,
    "ghosts": 8.0,
    "matched": 3.0,
    "neither": 2.0,
    "false": 9.0,
    "normals": 1.5,
    "laser": 2.0,
    "growing": 3.5,
    "first": 3.5,
    "other": 3.5,
    "bent": 2.0,
    "band": 1.5,
    "ray": 1.5,
    "perpendicular": 1.5,
    "selected ray": 1.5,
}
# Each lies over those before it.
ORDER = (
    "grid", "past", "all lines", "line map", "trajectory",
    "other lasers", "pinned", "invalid", "truth", "laser", "ray", "perpendicular", "selected ray", "dropped", "band",
    "missed", "false", "ghosts", "points", "segments", "neither", "matched", "normals", "first", "other", "bent",
    "growing", "seeds", "endpoints", "window", "predicted",
    "candidate", "outermost", "selected",
)  # fmt: skip
# These are drawn where they are in the world; all others where the laser sees them.
IN_THE_WORLD = ("grid", "past", "all lines", "line map", "trajectory", "other lasers")
