"""The page stays readable: main.js only composes, functions are short, file names follow one style."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from lineseg_app.places import data_folder

STATIC = data_folder("static")
MODULES = sorted(path.relative_to(STATIC).as_posix() for path in STATIC.rglob("*.js"))
LONGEST_FUNCTION = 80
NO_FUNCTION = re.compile(r"\s*(\} )?(if|else|for|while|switch|do|try|catch|finally|return|(export )?class)\b")


def functions(lines: list[str]) -> Iterator[tuple[str, int]]:
    """First line and length of each function of a formatted module: its last brace is indented like its first line."""
    for k, line in enumerate(lines):
        if not line.endswith((") {", "=> {")) or NO_FUNCTION.match(line):
            continue
        indent = re.match(" *", line)[0]
        first = k
        if line.startswith(f"{indent})"):
            first = max(j for j in range(k) if re.match(rf"{indent}\w", lines[j]))
        if NO_FUNCTION.match(lines[first]):
            continue
        last = min(j for j in range(k + 1, len(lines)) if lines[j].startswith(f"{indent}}}"))
        yield lines[first].strip(), last - first + 1


def too_long(module: str) -> list[tuple[str, int]]:
    found = functions((STATIC / module).read_text("utf-8").splitlines())
    return [(head, length) for head, length in found if length > LONGEST_FUNCTION]


@pytest.mark.parametrize("module", MODULES)
def test_no_function_is_long(module: str):
    assert too_long(module) == []


def test_long_functions_are_found():
    body = [f"    line{k}();" for k in range(90)]
    lines = ["class A {", "  method(", "    one,", "  ) {", *body, "  }", "}"]
    assert list(functions(lines)) == [("method(", 94)]


def test_main_only_composes():
    lines = (STATIC / "main.js").read_text("utf-8").splitlines()
    assert len(lines) <= 150
    assert list(functions(lines)) == []


def test_few_files_stand_at_the_root_and_no_name_has_a_dash():
    assert sum(path.is_file() for path in STATIC.iterdir()) <= 20
    assert [path.name for path in STATIC.rglob("*") if "-" in path.name] == []


def test_every_style_sheet_is_linked_and_none_is_twice():
    linked = re.findall(r'<link rel="stylesheet" href="/static/(.*?)"', (STATIC / "index.html").read_text("utf-8"))
    there = {path.relative_to(STATIC).as_posix() for path in STATIC.rglob("*.css")}
    assert sorted(linked) == sorted(
        there - {"rerun/viewer.css", "handout/handout.css", "handout/list.css", "handout/sheet.css"}
    )
