"""Emphasis, links and pictures in the texts of a lesson. static/learn/markup.js draws them.

`*word*` is emphasised; `[words](https://…)` or `[words](lesson:ID)` is a link; `![what it shows](picture.png)`, as a
paragraph of its own, is a picture beside the file of the lesson.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

LINK = re.compile(r"(!?)\[([^\]\n]*)\]\(([^()\s]*)\)")
MEDIA = {
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".gif": "image/gif",
    ".webp": "image/webp",
}
LARGEST_PICTURE = 5_000_000


def check_text(text: str, folder: Path | None) -> None:
    """Raises ValueError for a link to anything but a web page or a lesson, and for a picture that is not there."""
    for _, words, target in links(text):
        if not words.strip():
            raise ValueError(f"({target}) has no words in its square brackets; write what it leads to or shows")
    for picture, _, target in links(text):
        if picture:
            picture_file(folder, target)
        elif not target.startswith(("https://", "http://", "lesson:")):
            raise ValueError(f"the link {target[:60]!r} must begin with https://, http:// or lesson:")


def links(text: str) -> Iterator[tuple[bool, str, str]]:
    """(whether it is a picture, its words, its target) of each."""
    for found in LINK.finditer(text):
        yield bool(found[1]), found[2], found[3]


def picture_file(folder: Path | None, name: str) -> Path:
    """The picture with this name beside a lesson. Raises ValueError if it is none."""
    if Path(name).suffix.lower() not in MEDIA:
        raise ValueError(f"the picture {name[:60]!r} must end with {', '.join(MEDIA)}")
    path = beside(folder, name)
    if path.stat().st_size > LARGEST_PICTURE:
        raise ValueError(f"the picture {name} is larger than {LARGEST_PICTURE / 1e6:g} MB; make it smaller")
    return path


def _instead(folder: Path, suffix: str) -> str:
    """Which files may have been meant: those with this ending first, and other lessons not at all."""
    files = [each.name for each in folder.iterdir() if each.is_file() and not each.name.startswith(".")]
    meant = [name for name in files if suffix == ".json" or not name.lower().endswith(".json")]
    if not meant:
        return "put it there"
    return f"there is {', '.join(sorted(meant, key=lambda name: (not name.lower().endswith(suffix), name))[:8])}"


def beside(folder: Path | None, name: str) -> Path:
    """A file directly in the folder of a lesson. Raises ValueError if it is not there, or would be elsewhere."""
    if folder is None:
        raise ValueError(f"{name[:60]!r} cannot be beside this lesson, which has no folder")
    if not name or name != Path(name).name or "\\" in name or "\0" in name:
        raise ValueError(f"{name[:60]!r} must be the name of a file beside the lesson, without folders")
    path = folder / name
    if not path.is_file():
        raise ValueError(f"there is no {name} beside the lesson; {_instead(folder, Path(name).suffix.lower())}")
    if path.resolve().parent != folder.resolve():
        raise ValueError(f"{name} leads out of the folder of the lesson; put the file itself there")
    return path
