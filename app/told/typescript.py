"""Python types as TypeScript: TypedDicts, models and dataclasses become interfaces, docstrings become comments."""

from __future__ import annotations

import inspect
import textwrap
import types
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Annotated, Any, Literal, NamedTuple, NotRequired, Union, get_args, get_origin, get_type_hints

from pydantic import BaseModel
from typing_extensions import is_typeddict

PLAIN = {str: "string", int: "number", float: "number", bool: "boolean", type(None): "null", Any: "unknown"}
WIDTH = 116


class As(NamedTuple):
    """In an annotation: the TypeScript type, where Python cannot express it."""

    name: str


def interface(declared: type, name: str | None = None, sent: bool = False) -> str:
    """A class as an interface. sent: by the page, which may omit fields that have defaults."""
    lines = [f"export interface {name or declared.__name__} {{"]
    for field, annotation, optional in _fields_of(declared, sent):
        lines.append(f"  {field}{'?' if optional else ''}: {written(annotation)};")
    return _comment(declared) + "\n".join([*lines, "}"])


def alias(name: str, annotation: Any) -> str:
    """A type alias."""
    return f"export type {name} = {written(annotation)};"


def written(annotation: Any) -> str:
    """A type in TypeScript; classes by name."""
    if annotation in PLAIN:
        return PLAIN[annotation]
    origin, args = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return next((each.name for each in args[1:] if isinstance(each, As)), None) or written(args[0])
    if origin is Literal:
        return " | ".join(f'"{value}"' if isinstance(value, str) else str(value) for value in args)
    if origin in (Union, types.UnionType):
        return " | ".join(dict.fromkeys(written(each) for each in args))
    if origin is tuple and args[-1] is not ...:
        return f"[{', '.join(map(written, args))}]"
    if origin in (list, tuple, Sequence):
        inner = written(args[0])
        return f"({inner})[]" if " | " in inner else f"{inner}[]"
    if origin in (dict, Mapping):
        return f"Record<{written(args[0])}, {written(args[1])}>"
    if isinstance(annotation, type):
        return annotation.__name__
    raise TypeError(f"{annotation!r} has no counterpart in TypeScript here")


def _fields_of(declared: type, sent: bool) -> Iterable[tuple[str, Any, bool]]:
    """Name, type, and whether the field may be missing."""
    hints = get_type_hints(declared, include_extras=True)
    if is_typeddict(declared):
        return [(name, *_present(hint, name in declared.__optional_keys__)) for name, hint in hints.items()]  # type: ignore[attr-defined]
    if issubclass(declared, BaseModel):
        shown = {name: field for name, field in declared.model_fields.items() if not field.exclude}
        return [(name, hints[name], sent and not field.is_required()) for name, field in shown.items()]
    if is_dataclass(declared):
        return [(field.name, hints[field.name], False) for field in fields(declared)]
    raise TypeError(f"{declared!r} has no fields")


def _present(hint: Any, optional: bool) -> tuple[Any, bool]:
    """The type of a key, and whether it may be missing."""
    # With postponed annotations, the class treats NotRequired as required.
    return (get_args(hint)[0], True) if get_origin(hint) is NotRequired else (hint, optional)


def _comment(declared: type) -> str:
    """The docstring, if there is one of its own."""
    doc = inspect.cleandoc(declared.__dict__.get("__doc__") or "")
    if not doc or doc.startswith(f"{declared.__name__}("):
        return ""
    paragraphs = doc.split("\n\n")
    if len(paragraphs) == 1 and len(doc) + 8 <= WIDTH and "\n" not in doc:
        return f"/** {doc} */\n"
    lines = [line for paragraph in paragraphs for line in (*textwrap.wrap(paragraph, WIDTH - 3), "")]
    return "\n".join(["/**", *(f" * {line}".rstrip() for line in lines[:-1]), " */", ""])
