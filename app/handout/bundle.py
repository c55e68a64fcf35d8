"""The page's own modules and styles as one script and one style sheet."""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Mapping
from pathlib import Path

IMPORT = re.compile(r'^import (?P<names>\{[^}]*\}|\* as \w+) from "(?P<path>\.[^"]+)";$', re.MULTILINE)
EXPORT = re.compile(r"^export (?P<kind>async function|function|class|const|let) (?P<name>\w+)", re.MULTILINE)
# Comments on lines of their own.
COMMENT = re.compile(r"^[ \t]*(//.*|/\*\*?(?:(?!\*/)[\s\S])*\*/)[ \t]*\n", re.MULTILINE)
STYLE_COMMENT = re.compile(r"/\*[\s\S]*?\*/")


def script_of(static: Path, entry: str, instead: Mapping[str, str]) -> str:
    """The module `entry` with all that it imports, as one script.

    Each module becomes a function that returns what it exports, called once, after those that it imports. instead: the
    module that takes the place of another. Raises ValueError for a module that this cannot do: one of a circle, or with
    an import or export of another form.
    """
    parts: list[str] = []
    names: dict[str, str] = {}
    _add(static, entry, instead, names, parts, ())
    return '"use strict";\n' + "".join(parts)


def _add(
    static: Path, path: str, instead: Mapping[str, str], names: dict[str, str], parts: list[str], above: tuple[str, ...]
) -> str:
    """The name of a module's exports in the script, to which it is added with its imports."""
    if path in above:
        raise ValueError(f"{path} imports itself: {' → '.join((*above, path))}")
    if path in names:
        return names[path]
    text = COMMENT.sub("", (static / path).read_text("utf-8"))

    def imported(found: re.Match[str]) -> str:
        other = posixpath.normpath(posixpath.join(posixpath.dirname(path), found["path"]))
        other = instead.get(other, other)
        module = _add(static, other, instead, names, parts, (*above, path))
        if found["names"].startswith("*"):
            return f"const {found['names'].removeprefix('* as ')} = {module};"
        return f"const {found['names'].replace(' as ', ': ')} = {module};"

    text = IMPORT.sub(imported, text)
    exported = [found["name"] for found in EXPORT.finditer(text)]
    text = EXPORT.sub(r"\g<kind> \g<name>", text)
    if strange := re.search(r"^(import|export)\b.*", text, re.MULTILINE):
        raise ValueError(f"{path}: “{strange[0]}” cannot be put into one script")
    text = text.replace("import.meta.url", json.dumps(f"lineseg:/{path}"))
    names[path] = f"_{len(names)}"
    parts.append(f"const {names[path]} = (() => {{\n{text}\nreturn {{ {', '.join(exported)} }};\n}})();\n")
    return names[path]


def style_of(static: Path, sheets: list[str]) -> str:
    """The style sheets in this order."""
    return "\n".join(STYLE_COMMENT.sub("", (static / sheet).read_text("utf-8")) for sheet in sheets)
