"""Poses of the laser from the messages of a bag: its tree of frames (`/tf`, `/tf_static`), or a topic of poses."""

from __future__ import annotations

import struct
from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...poses import Found, Poses, PoseSource
from ..bags.decoders import MessageBytes, unpacked
from ..bags.topics import Stream
from .moving import Array, Motion, Rigid

TREES = ("tf2_msgs/TFMessage", "tf2_msgs/msg/TFMessage", "tf/tfMessage", "tf/msg/tfMessage")
# From the one that localises best on.
TOPICS = (
    "geometry_msgs/PoseWithCovarianceStamped", "geometry_msgs/PoseStamped", "geometry_msgs/TransformStamped",
    "nav_msgs/Odometry",
)  # fmt: skip
WITH_CHILD = ("geometry_msgs/TransformStamped", "nav_msgs/Odometry")
# Topics of poses that no robot has yet.
WISHES = ("goal", "target", "setpoint", "initialpose", "initial_pose", "waypoint")
BODIES = ("base_link", "base_footprint", "base")
# Numbers kept of one transform; transforms kept of all frames, 64 bytes each.
ROW, MOST_KEPT = 8, 2_000_000
LONGEST_CHAIN = 50
# Of a transform: stamp and length of a name, a length, x, y, z and the quaternion.
LAYOUTS = {order: tuple(struct.Struct(order + form) for form in ("III", "I", "7d")) for order in "<>"}
MOST_IN_MESSAGE = 10_000
LEAST_UP = 0.9
OTHER_CLOCK = "their stamps go from {:.3f} to {:.3f} s, those of the scans from {:.3f} to {:.3f} s: another clock"

Message = tuple[Stream, int, bytes]


def plain(type: str) -> str:
    """The name of a type without the "/msg/" of ROS 2."""
    return type.replace("/msg/", "/")


def has_poses(stream: Stream) -> bool:
    """Whether the messages of a stream are poses that can be read."""
    return stream.encoding in ("cdr", "ros1") and (stream.type in TREES or plain(stream.type) in TOPICS)


class Wanted(NamedTuple):
    """The scans whose poses are wanted. topic: where from, None for any; recorded: times are those of the recorder.

    mirrored: whether the scans are mirrored already, as for a laser that is mounted upside down.
    """

    stamps: Array
    frame_ids: frozenset[str]
    topic: str | None = None
    recorded: bool = False
    mirrored: bool = False


@dataclass
class Edge:
    """The transforms of a frame in its parent's: rows of time, x, y, z and a quaternion."""

    parent: str
    rows: array = field(default_factory=lambda: array("d"))
    fixed: bool = False
    step: int = 1
    seen: int = 0

    def add(self, time: float, numbers: tuple[float, ...]) -> None:
        self.seen += 1
        if self.fixed:
            self.rows = array("d", (time, *numbers))
        elif self.seen % self.step == 0:
            self.rows.extend((time, *numbers))

    def thin(self) -> None:
        """Keep every other transform, also of those to come."""
        rows = np.frombuffer(self.rows).reshape(-1, ROW)[::2].copy()
        self.rows, self.step = array("d", rows.tobytes()), 2 * self.step

    def motion(self) -> Motion | None:
        rows = np.frombuffer(self.rows).reshape(-1, ROW)
        return Motion.of(rows[:, 0], Rigid.of(rows[:, 1:]), self.fixed)


class Tree:
    """The frames of a robot, each with its parent."""

    def __init__(self, lasers: Iterable[str]) -> None:
        self.edges: dict[str, Edge] = {}
        self.kept = 0
        self._lasers = frozenset(lasers)
        self.known: dict[str, Motion | None] = {}

    def add(self, child: str, parent: str, time: float, numbers: tuple[float, ...], fixed: bool) -> None:
        edge = self.edges.get(child)
        if edge is None:
            edge = self.edges[child] = Edge(parent, fixed=fixed)
        if edge.parent != parent:
            return
        before = len(edge.rows)
        edge.add(time, numbers)
        self.kept += (len(edge.rows) - before) // ROW
        if self.kept > MOST_KEPT:
            self._shrink()

    def _shrink(self) -> None:
        """Forget the moving frames that no laser hangs on, or else every other transform."""
        on_chain = {name for laser in self._lasers for name in self.chain(laser)}
        aside = [name for name, edge in self.edges.items() if name not in on_chain and len(edge.rows) > ROW]
        if on_chain & self.edges.keys() and aside:
            for name in aside:
                self.edges[name].rows = array("d")
        else:
            for edge in self.edges.values():
                if not edge.fixed:
                    edge.thin()
        self.kept = sum(len(edge.rows) for edge in self.edges.values()) // ROW

    def chain(self, frame: str) -> list[str]:
        """The frame and those it hangs on, up to the root."""
        names = [frame]
        while (edge := self.edges.get(names[-1])) is not None and edge.parent not in names:
            names.append(edge.parent)
            if len(names) > LONGEST_CHAIN:
                break
        return names

    def motion(self, child: str) -> Motion | None:
        """How the frame moves in its parent's."""
        if child not in self.known:
            self.known[child] = self.edges[child].motion()
        return self.known[child]

    def at(self, chain: list[str], times: Array) -> Rigid:
        """The first frame of a chain in the last, at some times; NaN where a link is not known."""
        pose = Rigid(np.zeros((len(times), 3)), np.tile((0.0, 0.0, 0.0, 1.0), (len(times), 1)))
        for child in chain[:-1]:
            motion = self.motion(child)
            link = (
                motion.at(times)
                if motion
                else Rigid(np.full((len(times), 3), np.nan), np.full((len(times), 4), np.nan))
            )
            pose = link.then(pose)
        return pose

    def moves(self, chain: list[str]) -> bool:
        return any((motion := self.motion(child)) is not None and not motion.still for child in chain[:-1])

    def apart(self, chain: list[str], times: Array) -> Array:
        motions = [motion for child in chain[:-1] if (motion := self.motion(child))]
        return np.max([motion.apart(times) for motion in motions], axis=0, initial=0.0)


class Topic(NamedTuple):
    """The messages of one topic of poses: rows of time, x, y, z and a quaternion. body: the frame that has the pose."""

    name: str
    type: str
    frame: str
    body: str
    rows: array


def found_in(messages: Iterable[Message], wanted: Wanted) -> Found:
    """The poses of the laser, from one pass over the messages of all streams that `has_poses`."""
    tree, topics = Tree(wanted.frame_ids), dict[str, Topic]()
    for stream, nanoseconds, data in messages:
        try:
            _take(stream, 1e-9 * nanoseconds, data, tree, topics, wanted.recorded)
        except Exception:  # a damaged message may raise anything, and has no pose
            continue
    return _best(tree, topics, wanted)


def _take(stream: Stream, recorded: float, message: bytes, tree: Tree, topics: dict[str, Topic], always: bool) -> None:
    """Add the poses of one message. always: whether the time of recording is to be used."""
    if stream.type in TREES:
        fixed = stream.topic.endswith("tf_static")
        for stamp, parent, child, numbers in transforms_in(message, stream.encoding):
            tree.add(child, parent, recorded if always or not stamp else stamp, numbers, fixed)
        return
    data = MessageBytes(message, stream.encoding)
    type = plain(stream.type)
    stamp, frame = _header(data)
    body = _frame(data.text()) if type in WITH_CHILD else ""
    numbers = data.numbers("7d")
    topic = topics.setdefault(stream.topic, Topic(stream.topic, type, frame, body, array("d")))
    topic.rows.extend((recorded if always or not stamp else stamp, *numbers))


def transforms_in(message: bytes, encoding: str) -> Iterator[tuple[float, str, str, tuple[float, ...]]]:
    """(stamp [s], parent, child, x, y, z and quaternion) of a TFMessage; a bag has millions of them."""
    aligned = encoding == "cdr"
    data = unpacked(message)[4:] if aligned else message
    head, size, numbers = LAYOUTS["<" if not aligned or unpacked(message)[1] & 1 else ">"]
    (count,) = size.unpack_from(data, 0)
    at = 4
    for _ in range(min(count, MOST_IN_MESSAGE)):
        # In ROS 1 a sequence number comes first.
        at = (at + 3) & ~3 if aligned else at + 4
        seconds, nanoseconds, length = head.unpack_from(data, at)
        parent = _frame_of(data[at + 12 : at + 12 + length])
        at += 12 + length
        at = (at + 3) & ~3 if aligned else at
        (length,) = size.unpack_from(data, at)
        child = _frame_of(data[at + 4 : at + 4 + length])
        at += 4 + length
        at = (at + 7) & ~7 if aligned else at
        yield seconds + 1e-9 * nanoseconds, parent, child, numbers.unpack_from(data, at)
        at += 56


@lru_cache(maxsize=1024)
def _frame_of(name: bytes) -> str:
    return _frame(name.rstrip(b"\0").decode("utf-8", "replace"))


def _header(data: MessageBytes) -> tuple[float, str]:
    """The stamp [s] and the frame."""
    if not data.aligned:
        data.numbers("I")
    seconds, nanoseconds = data.numbers("2I")
    return seconds + 1e-9 * nanoseconds, _frame(data.text())


def _frame(name: str) -> str:
    """Frames were written with a slash before tf2."""
    return name.lstrip("/")


class Way(NamedTuple):
    """One way to the poses of the laser: `motion` of a body, None if the tree moves it, and a chain of the tree."""

    source: str
    frames: tuple[str, ...]
    tree: Tree
    chain: list[str]
    motion: Motion | None = None
    note: str = ""

    def at(self, times: Array) -> Poses:
        return self.laid(times)[0]

    def laid(self, times: Array) -> tuple[Poses, Array]:
        pose = self.tree.at(self.chain, times)
        return (pose if self.motion is None else self.motion.at(times).then(pose)).flat()

    def apart(self, times: Array) -> Array:
        return self.tree.apart(self.chain, times) if self.motion is None else self.motion.apart(times)

    @property
    def span(self) -> tuple[float, float]:
        """The first and the last time at which it is known [s]."""
        links = [self.motion] if self.motion else [self.tree.motion(child) for child in self.chain[:-1]]
        moving = [each for each in links if each is not None and not each.still]
        return max(each.times[0] for each in moving), min(each.times[-1] for each in moving)


def _best(tree: Tree, topics: dict[str, Topic], wanted: Wanted) -> Found:
    """The first way that gives at least half as many poses as the best one."""
    laser = _frame(next(iter(wanted.frame_ids), ""))
    chain = tree.chain(laser)
    ways = [
        way for way in (*_of_tree(tree, chain), *_of_topics(tree, chain, topics)) if wanted.topic in (None, way.source)
    ]
    laid = [way.laid(wanted.stamps) for way in ways]
    known = [int(np.isfinite(poses).all(axis=1).sum()) for poses, _ in laid]
    if not any(known):
        poses = np.full((len(wanted.stamps), 3), np.nan)
        return Found(poses, PoseSource(missing=_why_none(tree, topics, laser, ways, wanted)))
    chosen = next(number for number, count in enumerate(known) if 2 * count >= max(known))
    way, (poses, up) = ways[chosen], laid[chosen]
    level = float(np.nanmedian(up))
    if abs(level) < LEAST_UP:
        tilt = np.rad2deg(np.arccos(abs(level)))
        return Found(
            np.full_like(poses, np.nan), PoseSource(missing=f"{way.source} has the laser tilted by {tilt:.0f}°")
        )
    whole = known[chosen] == len(poses)
    missing = [way.note] if way.note else []
    if not whole:
        missing.append(_why_some(way, wanted.stamps))
    others = [name for name in dict.fromkeys(each.source for each in ways) if name != way.source]
    if others:
        missing.append(f"also there: {', '.join(others)}")
    apart = way.apart(wanted.stamps[np.isfinite(poses).all(axis=1)])
    upside_down = level < 0 and not wanted.mirrored
    source = PoseSource(
        way.source, way.frames, float(np.median(apart)), upside_down, "; ".join(missing), mounted=not way.note
    )
    return Found(poses, source, way.at)


def _of_tree(tree: Tree, chain: list[str]) -> Iterator[Way]:
    """From the root of the tree, then from nearer frames, as long as the laser moves in them."""
    note = ""
    if chain[0] not in tree.edges:
        body = next((name for name in BODIES if name in tree.edges), chain[0])
        note, chain = f"{body} is taken for the laser, because /tf has no frame {chain[0]!r}", tree.chain(body)
    for stop in range(len(chain), 1, -1):
        if tree.moves(chain[:stop]):
            yield Way("/tf", tuple(reversed(chain[:stop])), tree, chain[:stop], None, note)


def _of_topics(tree: Tree, chain: list[str], topics: dict[str, Topic]) -> Iterator[Way]:
    for topic in sorted(topics.values(), key=lambda topic: TOPICS.index(topic.type)):
        rows = np.frombuffer(topic.rows).reshape(-1, ROW)
        motion = Motion.of(rows[:, 0], Rigid.of(rows[:, 1:]))
        if motion is None or any(word in topic.name.lower() for word in WISHES):
            continue
        body = topic.body or next((name for name in BODIES if name in chain), "")
        mount = chain[: chain.index(body) + 1] if body in chain else chain[:1]
        note = "" if body in chain else f"{topic.name} is taken for the pose of the laser, whose mount is not known"
        yield Way(topic.name, (topic.frame, *reversed(mount)), tree, mount, motion, note)


def _why_none(tree: Tree, topics: dict[str, Topic], laser: str, ways: list[Way], wanted: Wanted) -> str:
    if not tree.edges and not topics:
        return "the bag has neither /tf nor a topic of poses"
    if not wanted.stamps.any():
        return "the scans have no stamps"
    if not ways and wanted.topic is not None:
        there = ", ".join(dict.fromkeys((*(["/tf"] if tree.edges else []), *topics)))
        return f"{wanted.topic} has no poses of {laser or 'the laser'}; there is {there}"
    if not ways:
        frames = sorted(tree.edges.keys() | {edge.parent for edge in tree.edges.values()})[:8]
        still = laser in frames
        return f"{laser} does not move in /tf" if still else f"/tf has no frame {laser!r}; it has {', '.join(frames)}"
    return _why_some(ways[0], wanted.stamps)


def _why_some(way: Way, stamps: Array) -> str:
    (first, last), low, high = way.span, float(np.min(stamps)), float(np.max(stamps))
    if first > high or last < low:
        return f"{way.source}: {OTHER_CLOCK.format(first, last, low, high)}"
    return f"{way.source} has gaps, or begins later or ends earlier"
