"""The types of the page equal those of the server, and the messages of the server match them."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, NotRequired

import pytest
from lineseg_app.page_types import page_types
from lineseg_app.places import data_folder
from lineseg_app.told.drawn import DrawnState, TraceColumns
from lineseg_app.told.typescript import interface, written
from live import Page
from pydantic import TypeAdapter
from typing_extensions import TypedDict


def check(declared: Any, value: Any) -> None:
    """That JSON is of this type: no key more, no text that only looks like a number."""
    TypeAdapter(declared).validate_json(json.dumps(value), strict=True, extra="forbid")


def test_the_types_of_the_page_are_current():
    there = (data_folder("static") / "wire.d.ts").read_text("utf-8")
    assert there == page_types(), "run `python -m lineseg_app.page_types > static/wire.d.ts`"


@pytest.mark.parametrize(
    "view",
    [
        {"mode": "tune", "selected": 300},
        {"mode": "learn", "step": 5},
        {"mode": "inspect", "method": "split-and-merge", "against": {"method": "region-growing", "params": {}}},
        {"mode": "tune", "recording": "lesson:1_perfect_corner", "layers": {"verdicts": True}},
    ],
)
def test_the_drawn_state_matches_its_types(page: Page, view: dict[str, Any]):
    page.hello()
    rev = page.ask(**view)
    check(DrawnState, page.drawn(rev)["state"])
    if view["mode"] == "learn":
        check(TraceColumns, page.last["trace"]["trace"])


class Example(TypedDict):
    """One line."""

    name: str
    ends: list[tuple[float, float] | None]
    by: dict[int, bool]
    maybe: NotRequired[int]


def test_a_dictionary_becomes_an_interface():
    assert interface(Example).splitlines() == [
        "/** One line. */",
        "export interface Example {",
        "  name: string;",
        "  ends: ([number, number] | null)[];",
        "  by: Record<number, boolean>;",
        "  maybe?: number;",
        "}",
    ]


def test_a_type_without_a_counterpart_is_refused():
    with pytest.raises(TypeError, match="no counterpart"):
        written(Callable[[int], int])
