"""`lineseg node`: segments from a robot's scans, published to the robot."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Any

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.covariance import Noise
from lineseg.knobs import Thresholds
from lineseg.scan import Scan
from lineseg.segment import Extraction

from .flag_types import Switch, Unset
from .noise import noise_of
from .sources import address_of, list_topics
from .thresholds import Choice, Flags
from .token import token_of

if TYPE_CHECKING:
    from ..bridges.address import Address
    from ..node.running import Running


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
    host: Annotated[str, arg(metavar="ADDRESS")] = "127.0.0.1",
    port: int = 0,
    token_file: Unset[Path] = None,
    once: Switch = False,
) -> None:
    """Publish the segments of a robot's scans to the robot.

    Ctrl-C or SIGTERM ends it. The file of --params is read again when it changes. The page sends thresholds to a
    running node: Export, "Send parameters to a robot"; they hold until the file changes.

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
        host: address at which the page may send thresholds; any but the loopback needs a token.
        port: TCP port for that; 0 picks a free one.
        token_file: file with the token for that (default: the environment variable LINESEG_TOKEN, or a random one). A
            page on another machine gives it as LINESEG_NODE_TOKEN, and names the node with --robot.
        once: publish the segments of one scan, write them as a line of JSON to standard output, and end.
    """
    address = address_of(source, topic)
    if list_topics(address):
        return
    running = _running(method, threshold)
    noise = noise_of(range_noise, bearing_noise)

    from ..live.source import Publishing
    from ..node.node import OWNER, Node, warm_up

    to_markers, to_cloud = _topics(markers, cloud)
    publisher = Node(address, Publishing(OWNER, to_markers, *running.now, to_cloud, noise), running, _tell, once)

    def prepare(method: str, params: Thresholds) -> None:
        warm_up(method, params, noise)

    def door() -> AbstractContextManager[None]:
        return nullcontext() if once else _door(address, running, prepare, host, port, token_file)

    prepare(*running.now)
    with _until_signal(publisher.stop), door():
        last = publisher.run()
    if once and last is not None:
        _write(last.scan, last.extraction, noise)


def _write(scan: Scan, extraction: Extraction, noise: Noise | None) -> None:
    from lineseg.writers import write_segments

    write_segments(sys.stdout, "jsonl", [(0, scan, extraction)], noise)


def _topics(markers: str, cloud: str) -> tuple[str, str]:
    """The names of both topics. Raises ValueError if they are the same, or no names of topics."""
    from ..routes.robot import ros_name

    to = ros_name("--markers", markers), ros_name("--cloud", cloud)
    if to[0] == to[1]:
        raise ValueError(f"--markers and --cloud are both {to[0]}; messages of two types need two topics")
    return to


def _door(
    address: Address,
    running: Running,
    prepare: Callable[[str, Thresholds], None],
    host: str,
    port: int,
    token_file: Path | None,
) -> AbstractContextManager[None]:
    """Where the page may send thresholds."""
    from ..node.door import open_door
    from ..places import user_folder

    laser = f"{address.place} {address.topic or ''}".strip()
    return open_door(laser, running, prepare, _tell, user_folder(), host, port, token_of(None, token_file))


@contextmanager
def _until_signal(stop: Callable[[], None]) -> Iterator[None]:
    """Ctrl-C and SIGTERM stop it."""

    def heard(number: int, frame: FrameType | None) -> None:
        stop()

    before = {each: signal.signal(each, heard) for each in (signal.SIGTERM, signal.SIGINT)}
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


def _running(method: Choice, flags: Any) -> Running:
    """What runs at first, and again when the file changes."""
    from ..node.running import Running

    if method.params is None:
        return Running(method.name, method.thresholds(flags))
    from ..node.watched import WatchedParams

    kind = method.extractor.params_type
    file = WatchedParams(method.params, kind, _tell)
    return Running(
        method.name,
        method.thresholds(flags),
        lambda: method.overriding(kind(**file.given), flags) if file.changed() else None,
    )


def _tell(line: str) -> None:
    print(f"lineseg: {line}", file=sys.stderr, flush=True)
