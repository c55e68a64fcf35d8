"""Shared by tests with a robot: scans of a wall, a server that watches the robot, and the messages to its page."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lineseg_app.bridges.address import Address as RobotAddress
from lineseg_app.server import Settings
from live import Address, serving


def wall(distance: float) -> list[float]:
    """Ranges of 91 beams, one degree apart, to a wall straight ahead."""
    return [distance / math.cos(math.radians(beam - 45)) for beam in range(91)]


@contextlib.contextmanager
def watching(url: str, tmp_path: Path, topic: str | None = "/scan", **settings: Any) -> Iterator[Address]:
    robots = (RobotAddress(url, topic),)
    with serving(Settings(robots=robots, data_folder=tmp_path, **settings)) as server:
        yield server


def nearest(state: dict[str, Any]) -> float:
    return -state["segments"][0]["line"][2] if state["segments"] else math.inf
