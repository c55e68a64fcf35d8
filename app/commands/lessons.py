"""`lineseg lessons`: the lessons as web pages that need no server."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from .flag_types import Several, Unset, lessons_folder
from .progress import progress_bar


def lessons(
    lesson: Positional[Annotated[Several[str], arg(metavar="[LESSON ...]")]] = (),
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    lessons: Unset[Path] = None,
) -> None:
    """Write the lessons as web pages that need no server.

    Args:
        lesson: which ones, by the names of their files without .json (default: all).
        out: folder for the pages; a new or an empty one, or one with pages of an earlier run.
        lessons: folder with lessons of your own, which are written after the program's.
    """
    from ..handout.site import INDEX, check_folder, write_site
    from ..shelf.lesson_shelf import LessonShelf

    own = lessons_folder(lessons)
    check_folder(out)
    shelf = LessonShelf(own)
    try:
        known = {each.id: each for each in shelf.told().lessons}
        if unknown := next((id for id in lesson if id not in known), None):
            raise ValueError(f"there is no lesson {unknown!r}; choose from {', '.join(known)}")
        chosen = [known[id] for id in dict.fromkeys(lesson)] or list(known.values())
        with progress_bar("lessons", " lessons") as advance:
            write_site(out, shelf, chosen, advance)
    finally:
        shelf.close()
    print(f"{out / INDEX}: {len(chosen)} {'lesson' if len(chosen) == 1 else 'lessons'}")
