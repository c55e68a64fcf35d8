"""The token that a server asks for."""

from __future__ import annotations

import os
from pathlib import Path


def token_of(token: str | None, file: Path | None) -> str | None:
    """The one given by a flag, a file or the environment; None if there is none. Raises ValueError if it is no line."""
    if token is not None and file is not None:
        raise ValueError("give --token or --token-file, not both")
    found = file.read_text(encoding="utf-8").strip() if file is not None else token or os.environ.get("LINESEG_TOKEN")
    if found == "" or (found and not found.isprintable()):
        raise ValueError(f"{file or '--token'}: the token is empty or not one line; write one line of text")
    return found
