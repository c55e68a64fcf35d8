"""The static part of a rerun recording: classes, colours, parameters, versions, and the layout of the viewer."""

from __future__ import annotations

import math
from collections.abc import Sequence

import rerun as rr
import rerun.blueprint as rrb
from rerun.blueprint.encodings import TextLogColumn

from lineseg import SCORES, Recording, Thresholds, __version__
from lineseg.colours import SEGMENTS
from lineseg.readers.reading import as_flags
from lineseg.rerun import LINE, NO_LINE, POINT, THIN

from ..frame.geometry import Bounds, bounds_of
from ..scene.palette import LIGHT
from .closing import send_blueprint

POINTS_OF = {"points": "laser/points", "seeds": "laser/seeds"}
BIG = -3.0
# The field of view of rerun's eye along the shorter side of a view.
FIELD_OF_VIEW = math.radians(55)
UNITS = {"": "counts", "m": "metres"}
# Hidden columns of rerun's log: there is only one entity, and the sentence says more than the level.
SENTENCE = [TextLogColumn("Body")]
# Colours of the scores in a plot, after Paul Tol's "muted" and "vibrant" schemes.
SERIES = [
    (0, 119, 187), (238, 119, 51), (0, 153, 136), (204, 51, 17), (51, 34, 136), (136, 204, 238), (153, 153, 51),
    (136, 34, 85), (221, 204, 119), (17, 119, 51), (170, 68, 153), (119, 119, 119), (238, 51, 119), (68, 170, 153),
]  # fmt: skip
SHARES = ("coverage", "invalid", "change")


def announce(
    stream: rr.RecordingStream,
    recording: Recording,
    label: str,
    method: str,
    params: Thresholds,
    frames: Sequence[int],
    steps: bool = False,
) -> None:
    """Send everything that does not change with the frame."""
    stream.send_recording_name(label or recording.name or "lineseg")
    stream.send_property("lineseg", rr.AnyValues(True, **properties(recording, label, method, params, frames)))
    stream.log("parameters", parameters(label, method, params), static=True)
    colours = [NO_LINE, *SEGMENTS.tolist()]
    classes = [rr.AnnotationInfo(id, color=colour) for id, colour in enumerate(colours)]
    stream.log("laser", rr.AnnotationContext(classes), rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for entity, radius, colour in (
        ("points", POINT, None),
        ("seeds", BIG, LIGHT.strong),
        ("replay/beam", BIG, LIGHT.candidate),
    ):
        stream.log(f"laser/{entity}", rr.Points3D.from_fields(radii=radius, colors=colour), static=True)
    for entity, radius, colour in (
        ("segments", LINE, None),
        ("dropped", THIN, LIGHT.faint),
        ("truth", THIN, LIGHT.truth),
        ("replay/line", LINE, LIGHT.candidate),
        ("replay/lines", LINE, LIGHT.accepted),
    ):
        stream.log(f"laser/{entity}", rr.LineStrips3D.from_fields(radii=radius, colors=colour), static=True)
    send_blueprint(stream, blueprint(bounds_of(recording), steps))


def plots() -> dict[str, list[str]]:
    """Scores of one unit are plotted together."""
    return {
        "shares": [name for name in SCORES if name in SHARES],
        "counts": [name for name, score in SCORES.items() if not score.unit and name not in SHARES],
        "metres": [name for name, score in SCORES.items() if score.unit == "m"],
    }


def properties(
    recording: Recording, label: str, method: str, params: Thresholds, frames: Sequence[int]
) -> dict[str, str | int | float]:
    """The settings needed to reproduce this recording."""
    about = {
        "version": __version__,
        "recording": label or recording.name,
        "topic": recording.topic,
        "method": method,
        "reading": "" if recording.account is None else as_flags(recording.account.given.given()),
        "frames": f"{recording.number(frames[0])}:{recording.number(frames[-1]) + 1}" if frames else "",
    }
    return about | params.numbers()


def parameters(label: str, method: str, params: Thresholds) -> rr.TextDocument:
    """The thresholds as a table."""
    rows = [f"| {knob.symbol} | {getattr(params, name):g} {knob.unit} | `{name}` |" for name, _, knob in params.knobs()]
    head = f"**{label}**, {method}, lineseg {__version__}\n\n| | | |\n|---|---|---|\n"
    return rr.TextDocument(head + "\n".join(rows), media_type=rr.MediaType.MARKDOWN)


def blueprint(bounds: Bounds, steps: bool = False) -> rrb.Blueprint:
    """The plan above the scores, the log of decisions next to the parameters."""
    tabs = [
        rrb.TimeSeriesView(
            origin="scores",
            contents=[f"$origin/{name}" for name in names],
            name=title,
            overrides={
                f"scores/{name}": rr.SeriesLines(colors=colour, names=SCORES[name].label)
                for name, colour in zip(names, SERIES, strict=False)
            },
        )
        for title, names in plots().items()
    ]
    texts = rrb.Vertical(
        rrb.TextLogView(origin="decisions", name="Decisions", columns=rrb.TextLogColumns(text_log_columns=SENTENCE)),
        rrb.TextDocumentView(origin="parameters", name="Parameters"),
        row_shares=[3, 2],
    )
    main = rrb.Vertical(plan(bounds), rrb.Tabs(*tabs, name="Scores"), row_shares=[3, 1])
    timeline = rrb.TimePanel(timeline="step" if steps else "frame", state="collapsed", play_state="paused")
    return rrb.Blueprint(
        rrb.Horizontal(main, texts, column_shares=[3, 2]),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        timeline,
    )


def plan(bounds: Bounds) -> rrb.Spatial3DView:
    """From straight above, y up: rerun's 2D views have y down."""
    x, y = (bounds[0] + bounds[2]) / 2, (bounds[1] + bounds[3]) / 2
    height = 1.05 * max(bounds[2] - bounds[0], bounds[3] - bounds[1]) / 2 / math.tan(FIELD_OF_VIEW / 2)
    eye = rrb.EyeControls3D(position=(x, y, height), look_target=(x, y, 0.0), eye_up=(0.0, 1.0, 0.0))
    return rrb.Spatial3DView(origin="laser", name="Plan", eye_controls=eye)
