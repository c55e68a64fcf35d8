"""The Foxglove WebSocket protocol: each channel has an encoding; JSON for control, binary messages for data."""

from __future__ import annotations

import base64
import json
import struct
from functools import partial
from typing import Any, NamedTuple

from websockets.sync.connection import Connection
from websockets.typing import Subprotocol

from lineseg.readers.bags.decoders import ENCODINGS, Decoder, decoder_of, is_laser

from .arrivals import arrivals
from .bridge import Told, hand_all
from .heard import list_of, object_of, strings_of
from .outgoing import Message, encoded

SUBPROTOCOLS = [Subprotocol("foxglove.sdk.v1"), Subprotocol("foxglove.websocket.v1")]
MESSAGE_DATA = 1
HEADER = struct.Struct("<BIQ")
SUBSCRIPTION = 1
MOST_CHANNELS, MOST_BYTES = 10_000, 16 * 1024 * 1024
# Those of ROS have at most 255 letters.
LONGEST_NAME = 1000


class Channel(NamedTuple):
    """schema: kept of channels of scans alone, because robots offer many others; trouble: why it cannot be used."""

    topic: str
    type: str
    encoding: str
    schema: bytes
    trouble: str
    is_laser: bool

    @property
    def size(self) -> int:
        return sum(map(len, (self.topic, self.type, self.encoding, self.schema, self.trouble)))

    def __str__(self) -> str:
        return f"{self.topic[:80]} is {self.type[:80] or 'of no type'} as {self.encoding[:40]}"


class Foxglove:
    """The client side of a connection. Channels come and go; it waits for the first one that fits and takes it."""

    name = "Foxglove WebSocket"

    def __init__(self, socket: Connection) -> None:
        self._socket = socket
        self._channels: dict[int, Channel] = {}
        self._chosen: int | None = None
        self._decode: Decoder | None = None
        self._server: dict[str, Any] = {}
        self._advertised: dict[str, int] = {}

    def scans(self, topic: str | None, told: Told) -> None:
        for arrived, waiting in arrivals(self._socket):
            scans = []
            for data in waiting:
                if isinstance(data, str):
                    self._hear(object_of(data), topic, told)
                elif self._chosen is not None and len(data) >= HEADER.size:
                    opcode, subscription, _ = HEADER.unpack_from(data)
                    if (opcode, subscription) == (MESSAGE_DATA, SUBSCRIPTION):
                        assert self._decode is not None
                        scans.append(partial(self._decode, data[HEADER.size :]))
            hand_all(told, scans, arrived)

    def announce(self, topic: str, message: type[Message]) -> None:
        """Nothing to do before `publish`: the robot says only after a while what it accepts."""

    def publish(self, topic: str, message: Message) -> None:
        if "clientPublish" not in strings_of(self._server.get("capabilities")):
            raise ValueError("the robot accepts no messages; enable clientPublish on its Foxglove server")
        supported = strings_of(self._server.get("supportedEncodings"))
        encoding = next((name for name in message.encodings if name in supported), None)
        if encoding is None:
            taken = ", ".join(supported) or "nothing"
            raise ValueError(f"the robot accepts messages as {taken}; this server sends {', '.join(message.encodings)}")
        if topic not in self._advertised:
            id = self._advertised[topic] = len(self._advertised) + 1
            channel = {"id": id, "topic": topic, "encoding": encoding, "schemaName": message.type}
            self._send(op="advertise", channels=[channel])
        self._socket.send(struct.pack("<BI", MESSAGE_DATA, self._advertised[topic]) + encoded(message, encoding))

    def close(self) -> None:
        self._socket.close()

    def _hear(self, message: dict[str, Any], topic: str | None, told: Told) -> None:
        match message.get("op"):
            case "serverInfo":
                self._server = message
            case "advertise":
                for each in list_of(message.get("channels")):
                    self._add(each)
            case "unadvertise":
                for id in list_of(message.get("channelIds")):
                    if isinstance(id, int):
                        self._channels.pop(id, None)
                if self._chosen is not None and self._chosen not in self._channels:
                    self._send(op="unsubscribe", subscriptionIds=[SUBSCRIPTION])
                    self._chosen = None
            case "status" if message.get("level") == 2:
                told.waits(f"the robot says: {str(message.get('message'))[:300]}")
                return
            case None:
                told.waits("the robot sends messages that are not those of Foxglove; is this the right port?")
                return
        if self._chosen is None:
            self._choose(topic, told)

    def _add(self, said: Any) -> None:
        """A channel, if it has what every channel has: an id, and the names of its topic, its type and its encoding."""
        named = isinstance(said, dict) and type(said.get("id")) is int
        names = [said.get(name) for name in ("topic", "schemaName", "encoding")] if named else []
        if not named or not all(isinstance(name, str) and len(name) <= LONGEST_NAME for name in names):
            return
        channel = _channel(said)
        self._channels.pop(said["id"], None)
        held = sum(each.size for each in self._channels.values()) if channel.is_laser else 0
        if len(self._channels) < MOST_CHANNELS and held + channel.size <= MOST_BYTES:
            self._channels[said["id"]] = channel

    def _choose(self, topic: str | None, told: Told) -> None:
        troubles: list[str] = []
        for id, channel in self._channels.items():
            if topic in (None, channel.topic) and channel.is_laser:
                try:
                    self._decode = _decoder(channel)
                except ValueError as error:
                    troubles.append(f"{channel}: {error}")
                    continue
                self._chosen = id
                told.topic_is(channel.topic)
                told.waits(f"subscribed to {channel.topic}; waiting for its first scan")
                self._send(op="subscribe", subscriptions=[{"id": SUBSCRIPTION, "channelId": id}])
                return
        told.waits(next(iter(troubles), "") or self._why_none(topic))

    def _why_none(self, topic: str | None) -> str:
        there = list(self._channels.values())
        named = [channel for channel in there if channel.topic == topic]
        if named:
            return f"{named[0]}; choose a sensor_msgs/LaserScan or foxglove.LaserScan as {', '.join(ENCODINGS)}"
        lasers = [channel for channel in there if topic is None and is_laser(channel.type)]
        if lasers:
            return f"{lasers[0]}, which cannot be read; publish it as {', '.join(ENCODINGS)}"
        missing = f"has no topic {topic}" if topic else "has no sensor_msgs/LaserScan topic"
        return f"the robot {missing} yet; it has {', '.join(map(str, there[:8])) or 'no topic at all'}"

    def _send(self, **message: Any) -> None:
        self._socket.send(json.dumps(message))


def _channel(said: dict[str, Any]) -> Channel:
    topic, type, encoding = said["topic"], said["schemaName"], said["encoding"]
    text, trouble = str(said.get("schema", "")), ""
    try:
        # Binary schemas come as base64.
        packed = encoding == "protobuf"
        schema = base64.b64decode(text, validate=True) if packed else text.encode("utf-8", "replace")
    except ValueError as error:
        schema, trouble = b"", f"its schema is not base64 ({error})"
    is_scans = encoding in ENCODINGS and is_laser(type, encoding, schema)
    return Channel(topic, type, encoding, schema if is_scans else b"", trouble, is_scans)


def _decoder(channel: Channel) -> Decoder:
    """Raises ValueError if the channel's schema cannot be used."""
    if channel.trouble:
        raise ValueError(channel.trouble)
    return decoder_of(channel.type, channel.encoding, channel.schema, 0)
