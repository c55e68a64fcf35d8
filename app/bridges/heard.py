"""JSON of a robot: what has the wrong kind is left out."""

from __future__ import annotations

import json
from typing import Any


def object_of(data: str | bytes) -> dict[str, Any]:
    """The message, or an empty one if the text is not a JSON object."""
    try:
        message = json.loads(data)
    except (ValueError, RecursionError):
        return {}
    return message if isinstance(message, dict) else {}


def list_of(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def strings_of(value: Any) -> list[str]:
    """Its texts; another value is an empty one, so that lists of the same length stay so."""
    return [each if isinstance(each, str) else "" for each in list_of(value)]
