"""Topics of ROS 2 on Zenoh, as rmw_zenoh has them; no ROS is needed.

A message travels on the key DOMAIN/TOPIC/TYPE/HASH as CDR, with the number, the time and the writer of the message
attached. Who publishes what is declared by liveliness tokens,
@ros2_lv/DOMAIN/SESSION/NODE/ENTITY/KIND/ENCLAVE/NAMESPACE/NAME/TOPIC/TYPE/HASH/QOS, where / within a part is %.
Design: github.com/ros2/rmw_zenoh, docs/design.md.
"""

from __future__ import annotations

import itertools
import os
import queue
import socket
import struct
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import zenoh
from zenoh.ext import HistoryConfig, declare_advanced_subscriber

from lineseg.readers.bags.decoders import plain_type
from lineseg.readers.laser_scan import decode_cdr

from .bridge import LARGEST_SAMPLE, OPEN_SECONDS, Told, hand_all
from .outgoing import Message, dds_type, full_type, typestore
from .topics import LASER_SCAN, LOOK_SECONDS, Offer, awaited_topic, of_lasers, why_silent

SPACE = "@ros2_lv"
PUBLISHER, NODE, SUBSCRIPTION = "MP", "NN", "MS"
NODE_NAME = "lineseg"
# Reliable, volatile, the last 10: every field as by default.
QOS = "::,10:,:,:,,"
TRANSIENT_LOCAL = "1"
# What ROS 2 Humble has in place of the hash of a definition.
HASHLESS = "TypeHashNotSupported"
# Tokens and messages come in any order.
GONE_SECONDS = 0.5
MOST_WAITING = 1000
MOST_WRITERS = 100
MOST_OFFERS = 10_000
STATE = struct.Struct("<qqB")


@dataclass(frozen=True)
class ZenohOffer(Offer):
    """hash: of the definition of the type, as the publisher has it; kept: it keeps scans for those who come late."""

    hash: str
    kept: bool


class Arrived(NamedTuple):
    """A message, when it arrived (`time.perf_counter`), and what is attached to it."""

    moment: float
    data: bytes
    attached: bytes


class _Writer(NamedTuple):
    """Receivers tell by its id and the numbers of its messages whether one is lost."""

    publisher: zenoh.Publisher
    id: bytes
    numbers: Iterator[int]


@contextmanager
def open_zenoh(router: str, domain: int) -> Iterator[Zenoh]:
    """Connect to a router. Raises OSError if there is none."""
    host, _, port = router.rpartition(":")
    try:
        # Zenoh itself keeps trying, and does not say so.
        socket.create_connection((host.strip("[]"), int(port)), OPEN_SECONDS).close()
        session = zenoh.open(_config(router))
    except (zenoh.ZError, OSError) as error:
        raise OSError(f"no Zenoh router answers at {router}; `ros2 run rmw_zenoh_cpp rmw_zenohd` starts one") from error
    try:
        yield Zenoh(session, domain)
    finally:
        session.close()


def zenoh_topics(router: str, domain: int, seconds: float) -> list[Offer]:
    """The publishers of scans that show up within a time, sorted by topic."""
    with open_zenoh(router, domain) as bridge:
        time.sleep(seconds)
        return of_lasers(bridge.offers())


class Zenoh:
    """A node of ROS 2 in a session of Zenoh."""

    name = "Zenoh"

    def __init__(self, session: zenoh.Session, domain: int) -> None:
        self._session, self._domain = session, domain
        self._ids = itertools.count(1)
        self._writers: dict[str, _Writer] = {}
        self._announced: dict[str, type[Message]] = {}
        self._offers: dict[str, ZenohOffer] = {}
        self._hashless = False
        self._closing = threading.Event()
        self._arrived: queue.Queue[Arrived] = queue.Queue(MOST_WAITING)
        self._last_numbers: dict[bytes, int] = {}
        self._declared = [
            session.liveliness().declare_token(self._token(0, NODE)),
            session.liveliness().declare_subscriber(f"{SPACE}/{domain}/**", self._hear, history=True),
        ]

    def close(self) -> None:
        self._closing.set()

    def offers(self) -> list[ZenohOffer]:
        """All publishers that are known at present."""
        return list(self._offers.copy().values())

    def scans(self, topic: str | None, told: Told) -> None:
        chosen = awaited_topic(topic, self.offers, self._closing, told.waits)
        if chosen is None:
            return
        told.topic_is(chosen)
        offers = [each for each in self.offers() if each.topic == chosen]
        self._hashless = any(each.hash == HASHLESS for each in offers)
        for to, message in self._announced.items():
            self._writer(to, message)
        told.waits(f"subscribed to {chosen}; waiting for its first scan")
        subscriber = self._subscriber(f"{self._domain}{chosen}/{dds_type(LASER_SCAN)}/*", any(o.kept for o in offers))
        token = self._session.liveliness().declare_token(self._token(next(self._ids), SUBSCRIPTION, chosen, LASER_SCAN))
        try:
            self._hand_over(chosen, told)
        finally:
            token.undeclare()
            subscriber.undeclare()

    def _subscriber(self, key: str, kept: bool) -> zenoh.Subscriber | zenoh.ext.AdvancedSubscriber:
        """kept: ask for the scans that the publisher keeps, too."""
        if not kept:
            return self._session.declare_subscriber(key, self._keep)
        history = HistoryConfig(detect_late_publishers=True, max_samples=MOST_WAITING)
        return declare_advanced_subscriber(self._session, key, self._keep, history=history)

    def announce(self, topic: str, message: type[Message]) -> None:
        """Wait with it for a publisher of scans, which tells the kind of hash that this robot has."""
        self._announced[topic] = message

    def publish(self, topic: str, message: Message) -> None:
        writer = self._writer(topic, type(message))
        attached = STATE.pack(next(writer.numbers), time.time_ns(), len(writer.id)) + writer.id
        try:
            writer.publisher.put(message.cdr(), attachment=attached)
        except zenoh.ZError as error:
            raise ValueError(f"nothing can be published to {topic}: {error}") from None

    def _writer(self, topic: str, message: type[Message]) -> _Writer:
        if topic not in self._writers:
            type = full_type(message.type)
            key = f"{self._domain}{topic}/{dds_type(type)}/{self._hash(type)}"
            try:
                publisher = self._session.declare_publisher(key, encoding=zenoh.Encoding.APPLICATION_CDR)
                token = self._token(next(self._ids), PUBLISHER, topic, type)
                self._declared.append(self._session.liveliness().declare_token(token))
            except zenoh.ZError as error:
                raise ValueError(f"nothing can be published to {topic}: {error}") from None
            self._writers[topic] = _Writer(publisher, os.urandom(16), itertools.count(1))
        return self._writers[topic]

    # --- in threads of Zenoh ------------------------------------------------------------------------------------------

    def _hear(self, sample: zenoh.Sample) -> None:
        """A token appears or disappears."""
        key = str(sample.key_expr)
        parts = key.split("/")
        if len(parts) < 12 or parts[5] != PUBLISHER:
            return
        if sample.kind != zenoh.SampleKind.PUT:
            self._offers.pop(key, None)
        elif len(self._offers) < MOST_OFFERS:
            kept = len(parts) > 12 and parts[12].split(":")[1:2] == [TRANSIENT_LOCAL]
            self._offers[key] = ZenohOffer(parts[9].replace("%", "/"), plain_type(parts[10]), parts[11], kept)

    def _keep(self, sample: zenoh.Sample) -> None:
        """The newest scans; the oldest makes room."""
        attached = sample.attachment.to_bytes() if sample.attachment else b""
        arrived = Arrived(time.perf_counter(), sample.payload.to_bytes(), attached)
        while True:
            try:
                return self._arrived.put_nowait(arrived)
            except queue.Full:
                self._take()

    # --- in the thread of `scans` -------------------------------------------------------------------------------------

    def _take(self) -> Arrived | None:
        try:
            return self._arrived.get_nowait()
        except queue.Empty:
            return None

    def _hand_over(self, topic: str, told: Told) -> None:
        gone, heard = False, time.monotonic()
        while not self._closing.is_set():
            try:
                waiting = [self._arrived.get(timeout=LOOK_SECONDS)]
            except queue.Empty:
                waiting = []
            while (scan := self._take()) is not None:
                waiting.append(scan)
            if waiting:
                told.loses(sum(self._lost_before(each.attached) for each in waiting))
                hand_all(told, [partial(decode_cdr, each.data) for each in waiting], waiting[-1].moment)
                gone, heard = False, time.monotonic()
            elif not gone and time.monotonic() - heard > GONE_SECONDS and not self._offered(topic):
                gone = True
                told.misses(why_silent(topic))

    def _lost_before(self, attached: bytes) -> int:
        """How many messages of the same writer are missing between this one and the one before it."""
        if len(attached) < STATE.size:
            return 0
        number, _, _ = STATE.unpack_from(attached)
        writer = attached[STATE.size :]
        before = self._last_numbers.pop(writer, number - 1)
        if len(self._last_numbers) >= MOST_WRITERS:
            self._last_numbers.clear()
        self._last_numbers[writer] = number
        return max(number - before - 1, 0)

    def _offered(self, topic: str) -> bool:
        return any(offer.is_laser and offer.topic == topic for offer in self.offers())

    def _token(self, entity: int, kind: str, topic: str = "", type: str = "") -> str:
        parts = [SPACE, self._domain, self._session.info.zid(), 0, entity, kind, "%", "%", NODE_NAME]
        if topic:
            parts += [topic.replace("/", "%"), dds_type(type), self._hash(type), QOS]
        return "/".join(map(str, parts))

    def _hash(self, type: str) -> str:
        """The hash of a definition that rmw_zenoh has in the key of its messages."""
        return HASHLESS if self._hashless else typestore("ROS2_JAZZY").hash_rihs01(type)


def _config(router: str) -> zenoh.Config:
    config = zenoh.Config()
    milliseconds = int(1000 * OPEN_SECONDS)
    for path, value in (
        ("mode", '"client"'),
        ("connect/endpoints", f'["tcp/{router}"]'),
        ("connect/timeout_ms", str(milliseconds)),
        ("connect/exit_on_failure", "true"),
        ("scouting/multicast/enabled", "false"),
        ("transport/link/rx/max_message_size", str(LARGEST_SAMPLE)),
    ):
        config.insert_json5(path, value)
    return config
