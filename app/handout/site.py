"""Lessons as a folder of pages that stand alone, with a list of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from string import Template
from urllib.parse import quote

from lineseg.unfinished import write_whole

from ..shelf.lesson import NamedLesson
from ..shelf.lesson_shelf import LessonShelf
from .handouts import lesson_page
from .page import GENERATOR, document, list_style
from .sheet import inline

INDEX = "index.html"
TITLE = "Lessons on line extraction"
LIST = Template("""<body class="handout-list">
<main class="lesson">
<h1>$title</h1>
<p class="hint">How line segments are found in a laser scan by seeded region growing (Gao et al. 2018). Each lesson
takes a few minutes and ends with a task.</p>
<ol class="lesson-list">
$items
</ol>
</main>
</body>""")
ITEM = Template(
    '<li><a class="lesson-item" href="$address"><span class="lesson-item-title">$title</span>'
    '<span class="muted">$about</span></a></li>'
)


def write_site(
    folder: Path, shelf: LessonShelf, lessons: Sequence[NamedLesson], advance: Callable[[int, int], None]
) -> None:
    """Write a page for each lesson, and the list of them. advance: told how many of them are made.

    Raises ValueError, before anything is written, if the folder holds other files; OSError if it cannot be written.
    """
    names = {lesson.id: f"{lesson.id}.html" for lesson in lessons}
    if INDEX in names.values():
        raise ValueError(f"{INDEX} is the list of the lessons; rename the lesson “index”")
    check_folder(folder)
    folder.mkdir(parents=True, exist_ok=True)
    following = [*(quote(names[lesson.id]) for lesson in lessons[1:]), ""]
    # Each is written when it is made, so that a disk that says no is told after the first, not after the last.
    for done, (lesson, after) in enumerate(zip(lessons, following, strict=True), 1):
        write_whole(folder / names[lesson.id], lesson_page(shelf, lesson, after, INDEX))
        advance(done, len(lessons))
    # The list comes last, so that each lesson in it is there.
    write_whole(folder / INDEX, index_page(lessons, names))


def check_folder(folder: Path) -> None:
    """Raises ValueError if the folder holds anything but pages that were written here before."""
    if folder.exists() and not folder.is_dir():
        raise ValueError(f"{folder} is a file; name a folder for the pages")
    for path in sorted(folder.iterdir()) if folder.exists() else ():
        if not _is_ours(path):
            raise ValueError(f"{folder} holds {path.name}, which is no page of lessons; name a new or an empty folder")


def _is_ours(path: Path) -> bool:
    if path.suffix != ".html" or not path.is_file():
        return False
    with path.open(encoding="utf-8", errors="replace") as file:
        return GENERATOR.split(" content")[0] + ' content="lineseg ' in file.read(2000)


def index_page(lessons: Sequence[NamedLesson], names: dict[str, str]) -> str:
    """The list of lessons. names: of their files, by id."""
    items = [
        ITEM.substitute(address=quote(names[lesson.id]), title=inline(lesson.title), about=inline(lesson.about))
        for lesson in lessons
    ]
    return document(TITLE, LIST.substitute(title=TITLE, items="\n".join(items)), list_style())
