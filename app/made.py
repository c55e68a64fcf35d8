"""How results were made, for the files that they are written to."""

from __future__ import annotations

from typing import Any

from lineseg import Recording, Thresholds, __version__


def about_of(recording: Recording, method: str, params: Thresholds) -> dict[str, Any]:
    """How a file was read and its segments extracted, for JSON: enough to do it again."""
    about: dict[str, Any] = {"lineseg": __version__, "file": recording.name}
    if (account := recording.account) is not None:
        about |= {
            "taken_for": account.line,
            "reading": account.used.given(),
            "guessed": [guess.field for guess in account.guesses],
        }
    return about | {"method": method, "params": params.numbers()}
