"""Addresses of robots: the WebSocket of a bridge, and a topic."""

from __future__ import annotations

import re
from dataclasses import dataclass
from urllib.parse import urlsplit


@dataclass(frozen=True)
class Address:
    """url: ws://host:port of a robot's bridge; topic: of its scans, None for the first."""

    url: str
    topic: str | None = None

    def __post_init__(self) -> None:
        check_address(self.url)

    @property
    def id(self) -> str:
        return f"live:{urlsplit(self.url).netloc}{self.topic or ''}"


def is_address(text: str) -> bool:
    return text.lower().startswith(("ws://", "wss://"))


def check_address(url: str) -> None:
    """Raises ValueError if `url` is not the address of a WebSocket."""
    expected = "give one like ws://robot:9090 (rosbridge) or ws://robot:8765 (Foxglove)"
    try:
        parts = urlsplit(url)
        known = is_address(url) and parts.hostname and (parts.port is None or parts.port > 0)
    except ValueError:
        known = False
    if not known or re.search(r"[\s\x00-\x1f]", url) or len(url) > 300:
        raise ValueError(f"{url[:80]!r} is not the address of a robot; {expected}")


def place_of(url: str) -> tuple[str, str, int, str]:
    """What an address means, however it is written: scheme, host, port and path. Raises ValueError if it is none."""
    check_address(url)
    parts = urlsplit(url)
    scheme = parts.scheme.lower()
    return scheme, parts.hostname or "", parts.port or {"ws": 80, "wss": 443}[scheme], parts.path.rstrip("/")
