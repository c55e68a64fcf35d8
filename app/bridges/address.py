"""Addresses of robots: how to reach one, and a topic."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import urlsplit

SOCKETS = ("ws", "wss")
# Robots that are found by the name of a topic; `//PLACE` is optional.
NAMED = re.compile(r"(ros2|zenoh):(?://([^/]*))?(/.*)?", re.IGNORECASE | re.DOTALL)
TOPIC = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")
LARGEST_DOMAIN = 232
ROUTER_PORT = 7447
SOCKET_EXAMPLES = "ws://robot:9090 (rosbridge) or ws://robot:8765 (Foxglove)"
EXPECTED = f"give one like ros2:/scan, ros2://DOMAIN/scan, zenoh:/scan, zenoh://router:7447/scan, {SOCKET_EXAMPLES}"


@dataclass(frozen=True)
class Address:
    """url: ws://host:port of a bridge, ros2://DOMAIN or zenoh://ROUTER:PORT; topic: of the scans, None for the first.

    The topic may also be part of the URL: ros2:/scan, zenoh:/scan, ws://host:port#/scan. Raises ValueError if it is
    not an address.
    """

    url: str
    topic: str | None = None

    def __post_init__(self) -> None:
        named = NAMED.fullmatch(self.url)
        if named is None and self.url.lower().startswith(("ros2:", "zenoh:")):
            raise ValueError(f"{self.url[:80]!r} is not the address of a robot; {EXPECTED}")
        if named is None:
            url, _, topic = self.url.partition("#")
            check_address(url)
            self._set(url, topic or None)
            return
        scheme, place, topic = named[1].lower(), named[2], (named[3] or "").rstrip("/") or None
        for name in filter(None, (topic, self.topic)):
            if not TOPIC.fullmatch(name):
                raise ValueError(f"{name[:80]!r} is not a topic of ROS; give one like /scan or /robot1/scan")
        if place is not None:
            place = checked_domain(place, f"the domain in {self.url[:80]!r}") if scheme == "ros2" else _router(place)
        self._set(f"{scheme}:" if place is None else f"{scheme}://{place}", topic)

    def _set(self, url: str, topic: str | None) -> None:
        if topic and self.topic and topic != self.topic:
            raise ValueError(f"{self.url[:80]} and --topic {self.topic[:80]} name two topics; name one")
        object.__setattr__(self, "url", url)
        object.__setattr__(self, "topic", topic or self.topic)

    @property
    def scheme(self) -> str:
        return self.url.partition(":")[0].lower()

    @property
    def place(self) -> str:
        """The part that says where, as people know it."""
        return self.url.rstrip(":") if self.scheme not in SOCKETS else urlsplit(self.url).netloc

    @property
    def domain(self) -> int | None:
        """The domain of DDS; None if the environment says it."""
        return int(self.url.partition("//")[2]) if "//" in self.url and self.scheme == "ros2" else None

    @property
    def router(self) -> str:
        """The router of Zenoh; the usual one is on this machine."""
        return self.url.partition("//")[2] or f"localhost:{ROUTER_PORT}"

    @property
    def id(self) -> str:
        return f"live:{self.place.replace('//', '')}{self.topic or ''}"


def is_address(text: str) -> bool:
    return text.lower().startswith(("ws://", "wss://", "ros2:", "zenoh:"))


def check_address(url: str) -> None:
    """Raises ValueError if `url` is not the address of a WebSocket."""
    try:
        parts = urlsplit(url)
        known = parts.scheme.lower() in SOCKETS and parts.hostname and (parts.port is None or parts.port > 0)
    except ValueError:
        known = False
    if not known or re.search(r"[\s\x00-\x1f]", url) or len(url) > 300:
        raise ValueError(f"{url[:80]!r} is not the address of a robot; give one like {SOCKET_EXAMPLES}")


def place_of(url: str) -> tuple[str, str, int, str]:
    """What an address means, however it is written: scheme, host, port and path. Raises ValueError if it is none."""
    check_address(url)
    parts = urlsplit(url)
    scheme = parts.scheme.lower()
    return scheme, parts.hostname or "", parts.port or {"ws": 80, "wss": 443}[scheme], parts.path.rstrip("/")


def checked_domain(text: str, where: str) -> int:
    """The number of a domain. Raises ValueError if it is none."""
    if not re.fullmatch(r"[0-9]{1,9}", text) or int(text) > LARGEST_DOMAIN:
        raise ValueError(f"{where} is {text[:80]!r}; a domain of DDS is a whole number from 0 to {LARGEST_DOMAIN}")
    return int(text)


def _router(place: str) -> str:
    """host:port; a host alone has the usual port."""
    found = re.fullmatch(r"([A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\])(?::([0-9]{1,5}))?", place)
    if found is None or not 0 < int(found[2] or ROUTER_PORT) < 65_536:
        raise ValueError(f"{place[:80]!r} is not the address of a Zenoh router; give one like robot:{ROUTER_PORT}")
    return f"{found[1]}:{found[2] or ROUTER_PORT}"


def domain_of(environ: Mapping[str, str]) -> int:
    """The domain that ROS 2 uses if none is named."""
    return checked_domain(environ.get("ROS_DOMAIN_ID") or "0", "ROS_DOMAIN_ID")
