"""Reads thresholds from a ROS 1 launch file, ROS 2 parameters in YAML, JSON, Python, or flags."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar
from xml.parsers import expat

from ..failing import named, plain
from ..knobs import Thresholds
from ..params import Params

MOST_CHARACTERS = 1 << 20
MOST_BYTES = 4 * MOST_CHARACTERS
# Its parser, in Python, takes about a second for so many.
MOST_YAML = 1 << 17
ALIAS = re.compile(r"(?:^|[\s\[{,:])\*\w", re.MULTILINE)
CALL = re.compile(r"^[^#\n]*Params\(", re.MULTILINE)
COMMENT = re.compile(r"(?:^|(?<=\s))#.*")
NESTED = re.compile(r"(?:[\[{]\s*){50}")
# What drivers of lasers are told, and scans have.
OF_LASER = re.compile(r"(?:angle|range|scan|time)_(?:min|max|increment|time)$|(?:min|max)_(?:angle|range)$")
FLAG = re.compile(r"(?<!\S)(?:--([a-z][a-z0-9_-]*)|([a-z][a-z0-9_]*)(?==))")
Found = tuple[str, Any, int]  # name as written, value, line (0: unknown)
Known = Mapping[str, str]  # name or alias → name
T = TypeVar("T", bound=Thresholds)


def read_params(text: str, kind: type[T] = Params) -> T:
    """The thresholds in a ROS 1 launch file, ROS 2 parameters, JSON, Python or flags; others keep their defaults.

    kind: type of the method's thresholds. Names may be those of the ROS program (`least_thresh`) or of the fields
    (`epsilon`). Raises ValueError, with the line if known, for an unknown name or a value that is not allowed.
    """
    return kind(**given_params(text, kind))


def params_file(file: Path) -> str:
    """The text of a file of thresholds; no more is read than it may have. Raises ValueError if it is no text."""
    with file.open("rb") as opened:
        data = opened.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise ValueError(f"it has more than {MOST_BYTES >> 20} MB; a file of thresholds has less.")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError("this is not text; give a launch file, YAML or JSON.") from None


def given_params(text: str, kind: type[Thresholds] = Params) -> dict[str, int | float]:
    """The same, but only the values in the text, by field."""
    if len(text) > MOST_CHARACTERS:
        raise ValueError(f"the text has {len(text)} characters; a file of thresholds has at most {MOST_CHARACTERS}.")
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise ValueError(f"character {error.start + 1} is half of a pair; save the file as UTF-8.") from None
    start = text.lstrip("\ufeff \t\r\n")[:1]
    if not start:
        raise ValueError("the text is empty; give a ROS 1 launch file, ROS 2 YAML or JSON with thresholds.")
    with named("", what="the text cannot be read"):
        return _read(text, start, kind)


def _read(text: str, start: str, kind: type[Thresholds]) -> dict[str, int | float]:
    known = {alias: name for name, _, knob in kind.knobs() for alias in (name, knob.ros) if alias}
    values = _values(_finder(text, start)(text.removeprefix("\ufeff"), known), kind, known)
    if not values:
        raise ValueError(f"there is no threshold in the text; give some of {_names(kind)}.")
    return values


def _finder(text: str, start: str) -> Callable[[str, Known], Iterator[Found]]:
    if start in "<{":
        # YAML merges an object into another with <<.
        return _in_json if start == "{" else _in_yaml if "<<" in text.lstrip("\ufeff \t\r\n")[:2] else _in_xml
    if CALL.search(text):
        return _in_python
    return _in_flags if re.search(r"(?<!\S)--[a-z]", COMMENT.sub("", text)) else _in_yaml


def _values(found: Iterable[Found], kind: type[Thresholds], known: Known) -> dict[str, int | float]:
    """Raises ValueError for the first that cannot be, and looks no further: finding the line of each takes long."""
    values: dict[str, int | float] = {}
    for written, value, line in found:
        where = f"line {line}: " if line else ""
        name = known.get(written)
        if name is None and OF_LASER.match(written):
            raise ValueError(
                f"{where}{written} is a setting of a laser, not a threshold; to see its scans, open a recording of "
                f"them. Thresholds are {_names(kind)}."
            )
        if name is None:
            raise ValueError(f"{where}there is no threshold {written!r}; choose from {_names(kind)}.")
        try:
            kind(**{name: (value := _number(value))})
        except ValueError as error:
            alias = f" (written {written})" if written != name else ""
            raise ValueError(f"{where}{error}{alias}.") from None
        values[name] = value
    return values


def _number(value: Any) -> Any:
    """A number that the format stores as text; any other value unchanged, for Params to refuse."""
    if not isinstance(value, str):
        return value
    try:
        return int(value)
    except ValueError:
        try:
            return float(value)
        except ValueError:
            return value


def _is_meant(name: str, value: Any, known: Known) -> bool:
    """Whether a setting of a node is a threshold or may be a misspelt one; others, such as topics, are not numbers."""
    return name in known or (isinstance(_number(value), int | float) and not isinstance(value, bool))


def _names(kind: type[Thresholds]) -> str:
    return ", ".join(f"{knob.ros} ({name})" if knob.ros else name for name, _, knob in kind.knobs())


def _in_xml(text: str, known: Known) -> Iterator[Found]:
    """<param name value> anywhere in the file. Refuses entities, because a few lines of them can fill the memory."""
    found: list[Found] = []
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        name = attributes.get("name", "").rsplit("/", 1)[-1]
        if tag == "param" and name:
            if "value" not in attributes:
                raise ValueError(f"line {parser.CurrentLineNumber}: the param {name!r} has no value.")
            found.append((name, attributes["value"], parser.CurrentLineNumber))

    def refuse(*_: Any) -> None:
        raise ValueError(f"line {parser.CurrentLineNumber}: a document type is not allowed; remove it.")

    parser.StartElementHandler = start
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise ValueError(f"line {error.lineno}: this is not a launch file: {expat.ErrorString(error.code)}.") from None
    yield from (each for each in found if _is_meant(each[0], each[1], known))


def _in_yaml(text: str, known: Known) -> Iterator[Found]:
    """The entries under every `ros__parameters`, or all entries if there is none."""
    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    if len(text) > MOST_YAML:
        raise ValueError(f"this YAML has {len(text)} characters; with thresholds it has at most {MOST_YAML}.")
    if alias := ALIAS.search(text):
        raise ValueError(
            f"line {text.count(chr(10), 0, alias.start()) + 1}: aliases are not allowed; write the value out."
        )
    if nested := NESTED.search(text):
        # Its parser takes minutes for thousands of them.
        line = text.count("\n", 0, nested.start()) + 1
        raise ValueError(f"line {line}: this is not YAML with thresholds: dozens of brackets are opened in a row.")
    try:
        tree = YAML(typ="safe", pure=True).load(text)
    except MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 0
        raise ValueError(f"line {line}: this is not YAML: {error.problem}.") from None
    except (YAMLError, RecursionError) as error:
        raise ValueError(f"this is not YAML: {str(error).splitlines()[0]}.") from None
    except Exception as error:  # of several kinds, for dates and numbers that cannot be
        raise ValueError(f"this is not YAML with thresholds: a value cannot be read ({plain(str(error))}).") from None
    if not isinstance(tree, Mapping):
        raise ValueError("this is neither a launch file, nor YAML with ros__parameters, nor a JSON object.")
    for entries in list(_ros_parameters(tree)) or [tree]:
        for name, value in entries.items():
            if _is_meant(str(name), value, known):
                yield str(name), value, _line_of(text, str(name))


def _ros_parameters(tree: Mapping[Any, Any]) -> Iterator[Mapping[Any, Any]]:
    for key, value in tree.items():
        if key == "ros__parameters" and isinstance(value, Mapping):
            yield value
        elif isinstance(value, Mapping):
            yield from _ros_parameters(value)


def _line_of(text: str, name: str) -> int:
    """The line that sets `name`; 0 if it cannot be found."""
    found = re.search(rf"(?:^|[\s{{,\"'])({re.escape(name)})[\"']?\s*:", text, re.MULTILINE)
    return text.count("\n", 0, found.start(1)) + 1 if found else 0


def _in_json(text: str, known: Known) -> Iterator[Found]:
    """An object of thresholds, or an object with one under "params"."""
    try:
        tree = json.loads(text)
    except json.JSONDecodeError as error:
        raise ValueError(f"line {error.lineno}: this is not JSON: {error.msg}.") from None
    except RecursionError:
        raise ValueError("this is not JSON with thresholds: it is nested too deeply.") from None
    tree = tree["params"] if isinstance(tree.get("params"), dict) else tree
    for name, value in tree.items():
        yield name, value, _line_of(text, name)


def _in_python(text: str, known: Known) -> Iterator[Found]:
    """The keywords of the first call of Params, or of another method's type; the text is parsed, never run."""
    try:
        tree = ast.parse(text)
    except SyntaxError as error:
        raise ValueError(f"line {error.lineno}: this is not Python: {error.msg}.") from None
    except (RecursionError, MemoryError, ValueError):
        raise ValueError("this is not Python with thresholds.") from None
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and ast.unparse(call.func).endswith("Params"):
            for keyword in call.keywords:
                try:
                    value = ast.literal_eval(keyword.value)
                except ValueError:
                    value = ast.unparse(keyword.value)
                yield keyword.arg or "**", value, keyword.lineno
            return


def _in_flags(text: str, known: Known) -> Iterator[Found]:
    """--epsilon 0.02, --epsilon=0.02 or --set epsilon=0.02; skips other flags, such as --topic /scan."""
    for flag in FLAG.finditer(text):
        name, rest = (flag[1] or flag[2]).replace("-", "_"), text[flag.end() :].lstrip(" \t=\\\r\n")
        value = "" if not rest or rest.startswith("--") else rest.split(maxsplit=1)[0].strip("'\"")
        if _is_meant(name, value, known):
            yield name, value, text.count("\n", 0, flag.start()) + 1
