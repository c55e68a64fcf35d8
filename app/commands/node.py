"""`lineseg node`: segments from a robot's scans, published to the robot."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from types import FrameType
from typing import Annotated, Any

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.knobs import Thresholds

from .flag_types import Switch, Unset
from .noise import noise_of
from .sources import address_of, list_topics
from .thresholds import Choice, Flags


def node(
    source: Positional[Annotated[str, arg(metavar="SOURCE")]],
    method: OmitArgPrefixes[Choice],
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    *,
    topic: Annotated[Unset[str], arg(metavar="TOPIC")] = None,
    markers: Annotated[str, arg(metavar="TOPIC")] = "/lineseg/segments",
    cloud: Annotated[str, arg(metavar="TOPIC")] = "/lineseg/cloud",
    range_noise: Unset[float] = None,
    bearing_noise: Unset[float] = None,
    once: Switch = False,
) -> None:
    """Publish the segments of a robot's scans to the robot, until Ctrl-C or SIGTERM.

    The file of --params is read again when it changes.

    Args:
        source: ros2:/scan or ros2://DOMAIN/scan (DDS; ros2: lists the topics), zenoh:/scan or zenoh://router:7447/scan
            (Zenoh), ws://robot:9090 (rosbridge), or ws://robot:8765 (Foxglove).
        method: the method, and where its thresholds come from (default: the method's defaults).
        threshold: thresholds of region growing; they override --params.
        topic: topic of the scans, for an address without one (default: the first topic with scans).
        markers: topic to publish a visualization_msgs/MarkerArray to.
        cloud: topic to publish a sensor_msgs/PointCloud2 to, one point for each segment: x, y, z, x2, y2, rho, theta,
            length, points, rms, first, last, var_rho, cov_rho_theta, var_theta.
        range_noise: standard deviation of a range [m], for the covariance (default: from each segment's rms).
        bearing_noise: standard deviation of a bearing [rad], for the covariance.
        once: publish the segments of one scan, write them as a line of JSON to standard output, and end.
    """
    address = address_of(source, topic)
    if list_topics(address):
        return
    newest = _thresholds(method, threshold)
    noise = noise_of(range_noise, bearing_noise)

    from ..live.node import OWNER, Node
    from ..live.source import Publishing
    from ..routes.robot import ros_name

    to = ros_name("--markers", markers), ros_name("--cloud", cloud)
    publishing = Publishing(OWNER, to[0], method.name, newest(), to[1], noise)
    running = Node(address, publishing, newest, _tell, once)

    def stop(number: int, frame: FrameType | None) -> None:
        running.stop()

    before = {each: signal.signal(each, stop) for each in (signal.SIGTERM, signal.SIGINT)}
    try:
        last = running.run()
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)
    if once and last is not None:
        from lineseg.writers import write_segments

        write_segments(sys.stdout, "jsonl", [(0, last.scan, last.extraction)], noise)


def _thresholds(method: Choice, flags: Any) -> Callable[[], Thresholds]:
    """The newest thresholds, each time it is called."""
    present = method.thresholds(flags)
    if method.params is None:
        return lambda: present
    from ..live.watched import WatchedParams

    kind = method.extractor.params_type
    file = WatchedParams(method.params, kind, _tell)

    def newest() -> Thresholds:
        nonlocal present
        if file.changed():
            present = method.overriding(kind(**file.given), flags)
        return present

    return newest


def _tell(line: str) -> None:
    print(f"lineseg: {line}", file=sys.stderr, flush=True)
