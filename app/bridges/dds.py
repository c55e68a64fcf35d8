"""Topics of ROS 2 on DDS, by Cyclone DDS; no ROS is needed.

ROS 2 puts `rt` before the name of a topic. Scans stay bytes until they are decoded with numpy.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

from cyclonedds.builtin import BuiltinDataReader, BuiltinTopicDcpsPublication
from cyclonedds.core import DDSException, InstanceState, ReadCondition, SampleState, ViewState, WaitSet
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from lineseg.readers.bags.decoders import plain_type
from lineseg.readers.laser_scan import decode_cdr

from .bridge import Told, hand_all
from .dds_domain import join
from .dds_types import serialised_type
from .outgoing import Message, full_type
from .topics import LASER_SCAN, LOOK_SECONDS, Offer, awaited_topic, of_lasers, why_silent

PREFIX = "rt"
MOST_WAITING = 1000
# After so long without a match, two participants that know of each other do not fit.
MATCH_SECONDS = 1.0
QUIET_SECONDS = 3.0
LEAVE_SECONDS = 1.0
POLICIES = {2: "durability", 4: "deadline", 5: "latency budget", 6: "ownership", 8: "liveliness", 10: "partition",
            11: "reliability", 12: "destination order", 23: "data representation"}  # fmt: skip
# Its definition, rather than a quality of service.
TYPE_CONSISTENCY = 24
ENCODED = Policy.DataRepresentation(use_cdrv0_representation=True)
EITHER = Policy.DataRepresentation(use_cdrv0_representation=True, use_xcdrv2_representation=True)
# Kept for those who come late: a reader of any kind can take it.
OFFERED = Qos(
    Policy.Reliability.Reliable(duration(milliseconds=20)),
    Policy.Durability.TransientLocal,
    Policy.History.KeepLast(10),
    Policy.DurabilityService(0, Policy.History.KeepLast(1), -1, -1, -1),
    ENCODED,
)


@dataclass(frozen=True)
class DdsOffer(Offer):
    """reliable, kept: the QoS, of which kept stands for transient local."""

    reliable: bool
    kept: bool


@contextmanager
def open_dds(domain: int | None) -> Iterator[Dds]:
    """Take part in a domain; None: that of the environment. Raises OSError or ValueError if that cannot be."""
    bridge = Dds(join(domain))
    try:
        yield bridge
    finally:
        bridge.leave()


def laser_topics(domain: int | None, seconds: float) -> list[DdsOffer]:
    """The publishers of scans that show up within a time, sorted by topic."""
    with open_dds(domain) as bridge:
        time.sleep(seconds)
        return of_lasers(bridge.offers())


class Dds:
    """A participant. `scans` takes one topic; its reader asks for what all publishers of the topic offer."""

    name = "DDS"

    def __init__(self, participant: DomainParticipant) -> None:
        self._participant = participant
        self._discovered = BuiltinDataReader(participant, BuiltinTopicDcpsPublication)
        self._topics: dict[str, Topic[Any]] = {}
        self._writers: dict[str, DataWriter[Any]] = {}
        self._closing = threading.Event()

    def close(self) -> None:
        self._closing.set()

    def leave(self) -> None:
        """Wait a moment for receivers that have not confirmed the last message, and take everything back."""
        for writer in self._writers.values():
            writer.wait_for_acks(duration(seconds=LEAVE_SECONDS))
        self._writers.clear()
        self._topics.clear()

    def offers(self) -> list[DdsOffer]:
        """All publishers of ROS topics that are known at present."""
        found = self._discovered.read(1000)
        return [
            _offer(each)
            for each in found
            if each.sample_info.instance_state == InstanceState.Alive and each.topic_name.startswith(f"{PREFIX}/")
        ]

    def scans(self, topic: str | None, told: Told) -> None:
        while not self._closing.is_set():
            offers = self._lasers(awaited_topic(topic, self.offers, self._closing, told.waits))
            if offers:
                told.topic_is(offers[0].topic)
                told.waits(f"subscribed to {offers[0].topic}; waiting for its first scan")
                self._receive(offers, told)

    def announce(self, topic: str, message: type[Message]) -> None:
        if topic not in self._writers:
            try:
                to = self._topic(topic, full_type(message.type))
                self._writers[topic] = DataWriter(self._participant, to, qos=OFFERED)
            except DDSException as error:
                raise ValueError(f"nothing can be published to {topic}: {error.msg}") from None

    def publish(self, topic: str, message: Message) -> None:
        self.announce(topic, type(message))
        writer = self._writers[topic]
        try:
            writer.write(writer.data_type(message.cdr()))
        except DDSException as error:
            if error.code != DDSException.DDS_RETCODE_TIMEOUT:  # a slow receiver, which misses this one
                raise ValueError(f"nothing can be published to {topic}: {error.msg}") from None

    def _lasers(self, topic: str | None) -> list[DdsOffer]:
        return [offer for offer in self.offers() if offer.is_laser and offer.topic == topic]

    def _receive(self, offers: list[DdsOffer], told: Told) -> None:
        """Hand over scans until the topic is offered in another way, or on closing."""
        topic, asked = offers[0].topic, _asked(offers)
        reader = DataReader(self._participant, self._topic(topic, LASER_SCAN), qos=asked)
        ready = ReadCondition(reader, SampleState.NotRead | ViewState.Any | InstanceState.Any)
        waiting = WaitSet(self._participant)
        waiting.attach(ready)
        watch = _Watch(topic, time.monotonic())
        while not self._closing.is_set():
            if waiting.wait(duration(seconds=LOOK_SECONDS)):
                arrived = time.perf_counter()
                samples = [each for each in reader.take(MOST_WAITING) if each.sample_info.valid_data]
                hand_all(told, [partial(decode_cdr, sample.data) for sample in samples], arrived)
                watch.said, watch.heard = "", watch.heard or bool(samples)
            now = time.monotonic()
            if now < watch.looks:
                continue
            watch.looks = now + LOOK_SECONDS
            there = self._lasers(topic)
            if there and _asked(there) != asked:
                break
            watch.tell(bool(there), reader, told, now)
        waiting.detach(ready)

    def _topic(self, name: str, type: str) -> Topic[Any]:
        if name not in self._topics:
            self._topics[name] = Topic(self._participant, PREFIX + name, serialised_type(type))
        topic = self._topics[name]
        if topic.data_type is not serialised_type(type):
            raise ValueError(f"{name} has messages of another type; choose another topic for {type}")
        return topic


@dataclass
class _Watch:
    """Tells when the publisher of a topic is gone, does not fit, or sends nothing that can be read.

    since: when it last fitted; fits_since: since when it does, 0 if it does not; heard: whether a scan came.
    """

    topic: str
    since: float
    fits_since: float = 0.0
    looks: float = 0.0
    said: str = ""
    heard: bool = False

    def tell(self, offered: bool, reader: DataReader[Any], told: Told, now: float) -> None:
        matched = bool(reader.get_matched_publications())
        if matched or (offered and now - self.since < MATCH_SECONDS):
            self.said = ""
            if matched:
                self.since, self.fits_since = now, self.fits_since or now
                self._tell_quiet(told, now)
            return
        self.fits_since = 0.0
        why = _why_no_match(self.topic, reader) if offered else why_silent(self.topic)
        if why != self.said:
            self.said = why
            told.misses(why)

    def _tell_quiet(self, told: Told, now: float) -> None:
        """Cyclone DDS drops what it cannot decode, and says so on stderr only."""
        if not self.heard and now - self.fits_since > QUIET_SECONDS:
            told.waits(
                f"{self.topic} has a publisher, but no scan comes from it; if lines with `deserialization` follow on "
                "stderr, it does not send LaserScan as plain CDR"
            )


def _offer(found: Any) -> DdsOffer:
    qos = found.qos
    return DdsOffer(
        found.topic_name.removeprefix(PREFIX),
        plain_type(found.type_name),
        isinstance(qos[Policy.Reliability], Policy.Reliability.Reliable),
        qos[Policy.Durability] is Policy.Durability.TransientLocal,
    )


def _asked(offers: list[DdsOffer]) -> Qos:
    """What every one of these publishers can give."""
    reliable, kept = all(offer.reliable for offer in offers), all(offer.kept for offer in offers)
    return Qos(
        Policy.Reliability.Reliable(duration(milliseconds=100)) if reliable else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if kept else Policy.Durability.Volatile,
        Policy.History.KeepLast(MOST_WAITING),
        Policy.TypeConsistency.AllowTypeCoercion(ignore_member_names=True),
        EITHER,
    )


def _why_no_match(topic: str, reader: DataReader[Any]) -> str:
    status = reader.get_requested_incompatible_qos_status()
    if status is not None and status.total_count and status.last_policy_id != TYPE_CONSISTENCY:
        policy = POLICIES.get(status.last_policy_id, f"policy {status.last_policy_id}")
        return f"{topic} is published, but its {policy} does not fit; give it the usual QoS of sensor data"
    return f"{topic} is published, but with another definition of sensor_msgs/LaserScan, or in another partition"
