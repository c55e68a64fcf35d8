"""The topics of a ROS 2 robot, and words for them."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from lineseg.readers.laser_scan import TYPES

LASER_SCAN = TYPES[1]
LOOK_SECONDS = 0.1


@dataclass(frozen=True)
class Offer:
    """What a publisher offers. type: as ROS 2 names it."""

    topic: str
    type: str

    @property
    def is_laser(self) -> bool:
        return self.type == LASER_SCAN


Offers = TypeVar("Offers", bound=Offer)


def of_lasers(offers: Iterable[Offers]) -> list[Offers]:
    """The publishers of scans, each once, sorted by topic."""
    return sorted({offer for offer in offers if offer.is_laser}, key=lambda offer: offer.topic)


def chosen_topic(wanted: str | None, offers: Sequence[Offer]) -> tuple[str | None, str]:
    """The topic of scans that is wanted, or the first if None is; or None, and why there is none."""
    lasers = list(dict.fromkeys(offer.topic for offer in of_lasers(offers)))
    chosen = wanted or next(iter(lasers), None)
    if chosen in lasers:
        return chosen, ""
    return None, why_none(wanted, [(offer.topic, offer.type) for offer in offers], lasers)


def awaited_topic(
    wanted: str | None, offers: Callable[[], Sequence[Offer]], closing: threading.Event, waits: Callable[[str], None]
) -> str | None:
    """The topic of scans that is wanted, or the first, as soon as it is published; None on closing.

    waits: called with the reason while there is none.
    """
    while not closing.is_set():
        chosen, why = chosen_topic(wanted, offers())
        if chosen is not None:
            return chosen
        waits(why)
        closing.wait(LOOK_SECONDS)
    return None


def why_silent(topic: str) -> str:
    """What is said of a topic that was published before."""
    return f"{topic} is no longer published; waiting for it"


def why_none(topic: str | None, offers: Sequence[tuple[str, str]], lasers: Sequence[str]) -> str:
    """Why there are no scans of `topic`, or of any if it is None. offers: topics and types; lasers: topics of scans."""
    if topic is None:
        there = sorted({f"{name} ({type})" for name, type in offers})
        return f"nobody publishes a sensor_msgs/LaserScan yet; topics there: {', '.join(there[:8]) or 'none'}"
    named = [type for name, type in offers if name == topic]
    if named:
        return (
            f"{topic} is {named[0]}; choose a sensor_msgs/LaserScan topic{f', such as {lasers[0]}' if lasers else ''}"
        )
    if not offers:
        return f"nobody publishes {topic} yet, nor any other topic; check the domain"
    others = f"its laser topics: {', '.join(lasers[:8])}" if lasers else "it has no sensor_msgs/LaserScan topic"
    return f"nobody publishes {topic} yet; {others}"
