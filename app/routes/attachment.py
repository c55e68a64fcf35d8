"""Responses that the browser saves as a file."""

from __future__ import annotations

import re
from urllib.parse import quote


def attachment(label: str, suffix: str) -> dict[str, str]:
    """Headers that name the file after a recording, with any characters in its label."""
    stem = re.sub(r"[^\w.-]+", "_", label) or "recording"
    return {"Content-Disposition": f"attachment; filename*=UTF-8''{quote(stem)}.{suffix}"}
