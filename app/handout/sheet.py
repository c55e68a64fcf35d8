"""A lesson on paper: the picture of each step, the question, and room for the answer."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from html import escape
from string import Template

from lineseg import EXTRACTORS, Params, Scan

from ..frame.findings import findings_in
from ..frame.framing import framing_near, framing_of
from ..frame.geometry import bounds_of
from ..scene.picture import picture
from ..scene.print import print_svg
from ..shelf.lesson import NamedLesson, Step, Task
from ..shelf.lesson_markup import LINK
from ..shelf.lesson_numbers import METHOD, the_one
from ..shelf.lesson_shelf import LessonShelf
from ..view import View

PAGE = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<link rel="stylesheet" href="/static/handout/sheet.css">
</head>
<body class="sheet">$sheet</body>
</html>
""")
EMPHASIS = re.compile(r"\*(\S(?:[^*\n]*\S)?)\*")
INDEX = re.compile(r"(?<!\w)([A-Za-zαγ]′?)_([a-z0-9]+)")
# Empty lines for an answer in one's own words.
LINES = 6
TRY = "Try it in lineseg, and write down what you did and what you saw."
WHY = "Why? Write down your reasons."


def sheet_page(shelf: LessonShelf, lesson: NamedLesson, pictures: Callable[[str], str]) -> str:
    """The HTML page to print, for the server. pictures: the address of a picture beside the lesson."""
    return PAGE.substitute(title=escape(lesson.title), sheet=sheet_of(shelf, lesson, pictures))


def sheet_of(shelf: LessonShelf, lesson: NamedLesson, pictures: Callable[[str], str]) -> str:
    """The same as a part of a page."""
    recording = shelf.scans_of(lesson)
    scan = recording[recording.position(lesson.frame)]
    drawn = partial(_picture, recording, scan, lesson)
    words = partial(_words, pictures)
    steps = [
        f'<section class="sheet-step">{drawn(step)}<div>{words(step.text)}</div></section>' for step in lesson.steps
    ]
    return (
        f"<main><header><h1>{inline(lesson.title)}</h1><p>{inline(lesson.about)}</p>"
        f'<p class="sheet-name">Name: <span></span> Date: <span></span></p></header>{"".join(steps)}'
        f'<section class="sheet-task"><h2>Your turn</h2>{drawn(lesson.task)}'
        f"<div>{words(lesson.task.text)}{''.join(_room(lesson.task))}</div></section></main>"
    )


def _room(task: Task) -> Iterator[str]:
    """Room for the answer."""
    for option in task.choice:
        yield f'<p class="sheet-choice"><span></span>{inline(option.text)}</p>'
    if task.number:
        unit = re.sub(r"^[-−]?[\d.]+\s*", "", task.number.answer)
        yield f'<p class="sheet-number">Answer: <span></span> {escape(unit)}</p>'
    yield f"<p>{TRY if task.goal else WHY}</p>"
    yield '<p class="sheet-line"></p>' * LINES


def _picture(recording, scan: Scan, lesson: NamedLesson, page: Step | Task) -> str:
    """What the page shows at this step, on a light ground."""
    method = (page.method if isinstance(page, Step) else None) or METHOD
    usual = Params().but(**lesson.params | page.params)
    params = usual if method == METHOD else EXTRACTORS[method].params_type()
    found = findings_in(scan, method, params)
    find = page.find if isinstance(page, Step) else None
    step = the_one(found.trace, find).index if find else None
    framing = framing_near(found, page.near, page.names) if step is None else framing_of(found, step)
    if framing is None:
        return ""
    view = View(mode="learn", frame=lesson.frame, method=method, params=params, step=step)
    shown = picture(replace(view, dark=False), recording, found, bounds_of(recording))
    count = len(found.extraction.segments)
    words = found.trace[step].text if step is not None else f"{count} {'line' if count == 1 else 'lines'}"
    return f"<figure>{print_svg(shown, framing, words)}<figcaption>{inline(words)}</figcaption></figure>"


def _words(pictures: Callable[[str], str], text: str) -> str:
    """The paragraphs of a text; nothing in them is read as HTML."""
    parts = []
    for part in text.split("\n\n"):
        link = LINK.fullmatch(part.strip())
        if link and link[1]:
            parts.append(f'<p><img src="{escape(pictures(link[3]))}" alt="{escape(link[2])}"></p>')
        else:
            parts.append(f"<p>{inline(part)}</p>")
    return "".join(parts)


def inline(text: str) -> str:
    """HTML of a text with its emphasis and indices. Paper has no links, so that their words are left."""
    plain = escape(LINK.sub(lambda link: link[2], text), quote=False)
    plain = EMPHASIS.sub(r"<em>\1</em>", plain)
    return INDEX.sub(r"<i>\1</i><sub>\2</sub>", plain)
