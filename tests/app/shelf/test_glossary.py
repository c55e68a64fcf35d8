"""The terms that the page explains."""

from __future__ import annotations

import re

from taught import taught

from lineseg import Params
from lineseg.tracing.glossary import TERMS

FORMS = [form for term in TERMS for form in term.forms]
SYMBOL = re.compile(r"(?<!\w)(?:[A-Za-zαγ]_[a-z0-9]+|[εδρθκσ]′?|P′)(?!\w)")


def test_each_form_belongs_to_one_term_and_every_threshold_is_one():
    assert len(FORMS) == len(set(FORMS))
    assert {knob.symbol for _, _, knob in Params.knobs()} <= set(FORMS)


def test_every_symbol_in_a_lesson_is_explained():
    for lesson in taught().lessons:
        texts = [*(step.text for step in lesson.steps), lesson.task.text, lesson.task.hint, lesson.task.done]
        for symbol in SYMBOL.findall(" ".join(texts)):
            assert symbol in FORMS, f"{lesson.id}: {symbol}"


def test_terms_lead_to_lessons_that_exist():
    known = {lesson.id for lesson in taught().lessons}
    assert {term.lesson for term in TERMS} - {""} <= known
