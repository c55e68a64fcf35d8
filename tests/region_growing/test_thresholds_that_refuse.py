"""The files to change for a threshold that refuses: its declaration, the kernel that uses it, and its explanation."""

from pathlib import Path

import lineseg_app
import pytest
from lineseg_app.places import data_folder
from scenes import wall_ahead

import lineseg
from lineseg import Params, trace
from lineseg.region_growing.checks import CHECKS, number_of
from lineseg.region_growing.limits import Limits, limits_of
from lineseg.tracing.log import NO_ENDS, NOWHERE, Row
from lineseg.tracing.vocabulary import Kind, Sentence

PLACES = [Path(lineseg.__file__).parent, Path(lineseg_app.__file__).parent, data_folder("static")]
REFUSING = [name for name, _, knob in Params.knobs() if knob.refuses]


def files_with(*words: str) -> list[str]:
    files = [file for place in PLACES for kind in ("py", "js", "json") for file in place.rglob(f"*.{kind}")]
    return [file.name for file in files if any(word in file.read_text("utf-8") for word in words)]


def test_a_threshold_that_refuses_stands_in_five_files_or_fewer():
    """Declaration, kernel, pseudocode and formula; and the lessons, which teach the paper's method, leave it out."""
    found = files_with("merge_rms", "MERGE_RMS")
    assert {"params.py", "overlap.py"} <= set(found) and len(found) <= 5, found


@pytest.mark.parametrize("name", REFUSING)
def test_the_sentence_of_a_refusal_has_both_numbers(name):
    check = CHECKS[number_of(name)]
    row = Row(0, number_of(name), 1, 0, -1, 3, 8, 7, NOWHERE, NOWHERE, NO_ENDS, 0.5, 0.25)
    said = str(Sentence(row, Kind("refused", "seed", "none", "", "{refusal}"), check, 3, 8, 7, 20))
    first, second = ("28.6°", "14.3°") if name == "merge_angle" else ("0.5", "0.25")
    assert first in said and second in said, said


def test_a_value_just_beyond_its_threshold_does_not_look_like_it():
    row = Row(0, number_of("min_length"), 1, 0, -1, 3, 8, 7, NOWHERE, NOWHERE, NO_ENDS, 0.59996, 0.6)
    said = Sentence(row, Kind("refused", "line", "none", "", ""), CHECKS[number_of("min_length")], 3, 8, 7, 20)
    assert said.refusal == "0.59996 m < L_min = 0.60000 m (short by 0.00004 m)"


def test_the_kernels_have_every_threshold_under_its_name():
    params = Params()
    assert dict(zip(Limits._fields, limits_of(params), strict=True)) == params.numbers()


def test_explaining_a_refusal_says_what_the_decision_said():
    traced = trace(wall_ahead(bump={20: 0.3}))
    (decision, *_) = [each for each in traced if each.kind == "growth stopped" and each.beam == 20]
    _, _, refusal = decision.text.partition(": ")
    assert refusal in traced.explain(20).text
