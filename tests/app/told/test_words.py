"""Sentences in parts: what each part names, and that no sentence names beams or segments in another way."""

from __future__ import annotations

import re

import pytest
from lineseg_app.places import data_folder
from lineseg_app.told.words import words_of

from lineseg import EXTRACTORS, Params, open_recording, trace, what_if, why


def named(text: str, params=Params, ghosts=()) -> list[dict]:
    return [part for part in words_of(text, params, ghosts) if not isinstance(part, str)]


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("beam 12 joins", [{"text": "beam 12", "beams": (12, 12)}]),
        ("now beams 353–2", [{"text": "beams 353–2", "beams": (353, 2)}]),
        ("between beams 12 and 13", [{"text": "beams 12 and 13", "beams": (12, 13)}]),
        ("segment 9, 4.8 m", [{"text": "segment 9", "segment": 9}]),
        ("where there are 3 segments", []),
        ("beams 5–9 and 10 points", [{"text": "beams 5–9", "beams": (5, 9)}]),
        ("segment 4 and 5 others", [{"text": "segment 4", "segment": 4}]),
    ],
)
def test_a_part_says_which_beams_or_which_segment_it_names(text, parts):
    assert named(text) == parts


def test_both_of_two_segments_are_named():
    parts = words_of("segments 5 and 6 are one line", Params)
    assert parts[:3] == [{"text": "segments 5", "segment": 5}, " and ", {"text": "6", "segment": 6}]


def test_a_threshold_is_named_by_its_symbol():
    text = "beam 3 lies 0.05 m from the line, ε = 0.03 m; with P_min = 9"
    assert [part.get("threshold") for part in named(text)] == [None, "epsilon", "min_points"]


def test_a_symbol_that_is_a_plain_word_names_a_threshold_only_before_its_value():
    params = EXTRACTORS["ransac"].params_type
    assert [part["text"] for part in named("no seed was found; with seed = 3", params)] == ["seed"]


def test_a_line_that_the_frame_lacks_is_named_with_its_ends():
    ends = (0.0, 1.0, 2.0, 3.0)
    text = "Hough finds a 1.3 m line at beams 3–9"
    assert named(text, ghosts=(ends,))[0] == {"text": "a 1.3 m line", "line": ends}
    assert "line" not in named(text)[0]


@pytest.mark.parametrize("method", ["region-growing", "split-and-merge", "ransac"])
def test_every_beam_and_segment_in_a_sentence_is_a_part_of_it(method):
    hallway = open_recording(data_folder("sample_scans") / "hallway.npz")
    params = EXTRACTORS[method].params_type()

    texts = [remark.text for remark in why(hallway, 13, params)]
    traced = trace(hallway[13], params)
    texts += [decision.text for decision in traced]
    texts += [traced.explain(beam).text for beam in range(0, len(hallway[13]), 7)]
    texts += [change.text for change in what_if(hallway[13], 40, params, method)]
    for text in texts:
        words = words_of(text, type(params))
        assert "".join(part if isinstance(part, str) else part["text"] for part in words) == text
        left = " ".join(part for part in words if isinstance(part, str))
        assert not re.search(r"\d+–\d+|beams? \d|segments? \d", left), text
