"""The lessons of the folder of samples, read once: filling in their numbers takes a second."""

from functools import cache

from lineseg_app.shelf.lessons import ReadLessons, lesson_files, read_lessons


@cache
def taught() -> ReadLessons:
    return read_lessons(lesson_files())
