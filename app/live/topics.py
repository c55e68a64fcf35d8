"""Words for the topics of a ROS 2 robot."""

from __future__ import annotations

from collections.abc import Sequence


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
