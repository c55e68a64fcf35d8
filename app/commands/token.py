"""The token that a server asks for."""

from __future__ import annotations

import os
import stat
import sys
from pathlib import Path

LONGEST = 4096


def token_of(token: str | None, file: Path | None) -> str | None:
    """The one given by a flag, a file or the environment; None if there is none. Raises ValueError if it is no line."""
    if token is not None and file is not None:
        raise ValueError("give --token or --token-file, not both")
    found = _said_in(file) if file is not None else token or os.environ.get("LINESEG_TOKEN")
    if found == "" or (found and not found.isprintable()):
        raise ValueError(f"{file or '--token'}: the token is empty or not one line; write one line of text")
    return found


def _said_in(file: Path) -> str:
    """The token in a file, which may be a pipe. Warns if others can read the file."""
    with file.open("rb") as opened:
        mode, data = os.fstat(opened.fileno()).st_mode, opened.read(LONGEST + 1)
    if os.name == "posix" and stat.S_ISREG(mode) and mode & 0o077:
        print(f"lineseg: {file}: other users can read this token; `chmod 600 {file}` prevents it.", file=sys.stderr)
    if len(data) > LONGEST:
        raise ValueError(f"{file}: a token has at most {LONGEST} bytes, and this file has more; is it the right one?")
    try:
        return data.decode("utf-8-sig").strip()
    except UnicodeDecodeError:
        raise ValueError(f"{file}: the token is not text in UTF-8; write one line of text") from None
