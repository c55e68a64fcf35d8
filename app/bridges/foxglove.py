"""The Foxglove WebSocket protocol: each channel has an encoding; JSON for control, binary messages for data."""

from __future__ import annotations

import base64
import json
import struct
from functools import partial
from typing import Any

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
MOST_CHANNELS = 10_000


class Foxglove:
    """The client side of a connection. Channels come and go; it waits for the first one that fits and takes it."""

    name = "Foxglove WebSocket"

    def __init__(self, socket: Connection) -> None:
        self._socket = socket
        self._channels: dict[int, dict[str, Any]] = {}
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
                there = [each for each in list_of(message.get("channels")) if _is_channel(each)]
                self._channels |= {channel["id"]: channel for channel in there[: MOST_CHANNELS - len(self._channels)]}
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

    def _choose(self, topic: str | None, told: Told) -> None:
        troubles: list[str] = []
        for id, channel in self._channels.items():
            if topic in (None, channel["topic"]) and _is_laser(channel):
                try:
                    self._decode = _decoder(channel)
                except ValueError as error:
                    troubles.append(f"{_shown(channel)}: {error}")
                    continue
                self._chosen = id
                told.topic_is(channel["topic"])
                told.waits(f"subscribed to {channel['topic']}; waiting for its first scan")
                self._send(op="subscribe", subscriptions=[{"id": SUBSCRIPTION, "channelId": id}])
                return
        told.waits(next(iter(troubles), "") or self._why_none(topic))

    def _why_none(self, topic: str | None) -> str:
        named = [channel for channel in self._channels.values() if channel["topic"] == topic]
        if named:
            return f"{_shown(named[0])}; choose a sensor_msgs/LaserScan or foxglove.LaserScan as {', '.join(ENCODINGS)}"
        lasers = [channel for channel in self._channels.values() if topic is None and is_laser(channel["schemaName"])]
        if lasers:
            return f"{_shown(lasers[0])}, which cannot be read; publish it as {', '.join(ENCODINGS)}"
        there = ", ".join(_shown(channel) for channel in list(self._channels.values())[:8])
        missing = f"has no topic {topic}" if topic else "has no sensor_msgs/LaserScan topic"
        return f"the robot {missing} yet; it has {there or 'no topic at all'}"

    def _send(self, **message: Any) -> None:
        self._socket.send(json.dumps(message))


def _is_channel(channel: Any) -> bool:
    """Whether it has what every channel has: an id, and the names of its topic, its type and its encoding."""
    named = isinstance(channel, dict) and type(channel.get("id")) is int
    return named and all(isinstance(channel.get(name), str) for name in ("topic", "schemaName", "encoding"))


def _is_laser(channel: dict[str, Any]) -> bool:
    try:
        schema = _schema(channel)
    except ValueError:
        schema = b""  # told when it is needed to decode
    return channel["encoding"] in ENCODINGS and is_laser(channel["schemaName"], channel["encoding"], schema)


def _decoder(channel: dict[str, Any]) -> Decoder:
    """Raises ValueError if the channel's schema cannot be used."""
    return decoder_of(channel["schemaName"], channel["encoding"], _schema(channel), 0)


def _schema(channel: dict[str, Any]) -> bytes:
    """The schema of a channel; binary ones come as base64. Raises ValueError for other text."""
    text = str(channel.get("schema", ""))
    if channel["encoding"] != "protobuf":
        return text.encode("utf-8", "replace")
    try:
        return base64.b64decode(text, validate=True)
    except ValueError as error:
        raise ValueError(f"its schema is not base64 ({error})") from None


def _shown(channel: dict[str, Any]) -> str:
    return f"{channel['topic'][:80]} is {channel['schemaName'][:80] or 'of no type'} as {channel['encoding'][:40]}"
