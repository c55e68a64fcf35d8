"""Generates the page's types from those of the server: `python -m lineseg_app.page_types > static/wire.d.ts`."""

from __future__ import annotations

import inspect
from types import ModuleType

from pydantic import BaseModel
from typing_extensions import is_typeddict

from lineseg.sweep.totals import Measure
from lineseg.what_if import WhatIf

from . import view, view_field, wire
from .bridges.node_params import Sent
from .routes import class_list, labels, lessons, robot, tuning
from .shelf import lesson
from .told import answers, drawn, handout, messages, words
from .told.typescript import alias, interface

HEAD = """// Generated from the server's types by `python -m lineseg_app.page_types`; a test fails if it is outdated.
// Refer to these types as import("./wire.js").NAME. No such module exists, because types are gone at run time.
"""
SHARED = {
    "Params": dict[str, float],
    "Reading": dict[str, str | float],
    "Point": drawn.Point,
    "Line": drawn.Line,
    "Box": drawn.Box,
    "Reference": drawn.Reference,
    "Presence": drawn.Presence,
    "Connection": messages.Connection,
    "Where": messages.Where,
    "Job": answers.Job,
}
# Types that are easier to write in TypeScript than as annotations.
WRITTEN = """
/** What the tab shows. Every input changes only this. */
export type View = Required<Omit<ViewPatch, "mode" | "against">> & {
  mode: string;
  against: Against | null;
};
export type Against = Required<Pinned>;
/** The drawn state, as the page keeps it. latencyMs: from the latest change made here until it was drawn. */
export type State = DrawnState & { rev: number; latencyMs: number | null };
/** A sentence: text, and parts of it that name something in the scene or a threshold. */
export type Words = (string | Link)[];
export type Field = FieldEntry;
export type Knob = KnobEntry;
export type Method = MethodEntry;
export type Score = ScoreEntry;
export type Trouble = Failure;
export type Columns = TraceColumns;
export type Marks = Record<string, number[]>;
/** The messages on the socket of a tab. */
export type Incoming = Hello | Change | OpenLink | Cancel | Close | Follow;
export type Message = Welcome | Recordings | LiveStatus | Loading | Failure | Traced | Times | Drawn | Survey;
/** The scores of every stride-th frame, as the page reads them: score after score in the order of Welcome.scores. */
export type Survey = Surveyed & { values: Float32Array };
/** The values of a threshold, and the value of each measure there. */
export type Curve = { values: number[] } & Record<string, (number | null)[]>;
/** An answer of long work. */
export type Answer = Worked & Partial<SampledCurves & SampledMap> & Tuned & Fitted;
"""


def page_types() -> str:
    """The text of static/wire.d.ts."""
    shared = [alias(name, annotation) for name, annotation in SHARED.items()]
    sent = [
        interface(each, sent=True)
        for module in (view, wire, class_list, labels, lessons, tuning, robot)
        for each in _declared(module)
    ]
    told = [
        interface(each)
        for module in (words, messages, drawn, answers, lesson, handout, view_field)
        for each in _declared(module)
    ]
    told += [interface(each) for each in (Measure, WhatIf, Sent)]
    parts = [
        HEAD,
        "// Both directions",
        *shared,
        WRITTEN.strip(),
        "// What the page sends",
        *sent,
        "// What the server sends",
        *told,
    ]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def _declared(module: ModuleType) -> list[type]:
    """The messages declared in a module, in order."""
    own = [each for each in vars(module).values() if inspect.isclass(each) and each.__module__ == module.__name__]
    return [each for each in own if is_typeddict(each) or (issubclass(each, BaseModel) and each.model_fields)]


if __name__ == "__main__":
    print(page_types(), end="")
