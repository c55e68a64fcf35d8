"""The rosbridge protocol, version 2: JSON objects with an `op` over a WebSocket. ROS 1 and ROS 2."""

from __future__ import annotations

import itertools
import math
import time
from collections.abc import Mapping
from functools import partial
from typing import Any

from websockets.sync.connection import Connection

from lineseg.readers.laser_scan import TYPES, LaserScan, decode_json

from .arrivals import arrivals
from .bridge import Told, hand_all
from .heard import object_of, strings_of
from .outgoing import Message, as_json

# Both versions of ROS accept the short type name.
LASER_SCAN = "sensor_msgs/LaserScan"
CALL_SECONDS = 5.0


class RobotError(ValueError):
    """The robot refused; the message is in its own words."""


class RosBridge:
    """The client side of a connection. `call` may be used while `scans` is not running.

    seconds: how long all calls together may take.
    """

    name = "rosbridge"

    def __init__(self, socket: Connection, seconds: float = math.inf) -> None:
        self._socket = socket
        self._ends = time.monotonic() + seconds
        self._ids = (f"lineseg:{n}" for n in itertools.count(1))
        self._advertised: set[str] = set()
        self._ros1 = False

    def call(self, service: str, args: Mapping[str, Any], seconds: float = CALL_SECONDS) -> dict[str, Any]:
        """The answer of a service. Raises RobotError with the robot's words, or TimeoutError without an answer."""
        id = next(self._ids)
        self._send(op="call_service", id=id, service=service, args=dict(args))
        late = min(time.monotonic() + seconds, self._ends)
        while (left := late - time.monotonic()) > 0:
            message = object_of(self._socket.recv(timeout=left))
            if message.get("op") == "service_response" and message.get("id") == id:
                break
            if _is_trouble(message) and message.get("id") in (id, None):
                raise RobotError(str(message.get("msg")))
        else:
            # Other messages came all the time.
            raise TimeoutError
        values = message.get("values")
        if message.get("result") is False:
            raise RobotError(values if isinstance(values, str) and values else f"{service} failed without a reason")
        return values if isinstance(values, dict) else {}

    def scans(self, topic: str | None, told: Told) -> None:
        topic = self._laser_topic(topic)
        told.topic_is(topic)
        self._send(op="subscribe", id=next(self._ids), topic=topic, type=LASER_SCAN, queue_length=1)
        told.waits(f"subscribed to {topic}; waiting for its first scan")
        for arrived, waiting in arrivals(self._socket):
            messages = [object_of(data) for data in waiting]
            scans = [each for each in messages if each.get("op") == "publish" and each.get("topic") == topic]
            hand_all(told, [partial(self._decoded, each.get("msg")) for each in scans], arrived)
            for each in messages:
                if _is_trouble(each):
                    raise RobotError(f"{topic}: {each.get('msg')}")

    def _decoded(self, message: Any) -> LaserScan:
        scan = decode_json(message)
        self._ros1 = "secs" in message.get("header", {}).get("stamp", {})
        return scan

    def announce(self, topic: str, message: type[Message]) -> None:
        if topic not in self._advertised:
            self._send(op="advertise", topic=topic, type=message.type)
            self._advertised.add(topic)

    def publish(self, topic: str, message: Message) -> None:
        self.announce(topic, type(message))
        self._send(op="publish", topic=topic, msg=message.fields(self._ros1))

    def close(self) -> None:
        self._socket.close()

    def _laser_topic(self, wanted: str | None) -> str:
        """The topic to use, checked with rosapi; if rosapi is not running, the wanted topic unchecked."""
        try:
            values = self.call("/rosapi/topics", {})
        except (RobotError, TimeoutError) as error:
            if wanted is None:
                said = str(error) or "no answer"
                raise ValueError(f"the robot does not list its topics ({said}); name one: --topic /scan") from None
            return wanted
        rows = zip(strings_of(values.get("topics")), strings_of(values.get("types")), strict=False)
        topics = {name: type for name, type in rows if name}
        lasers = [name for name, type in topics.items() if type in TYPES]
        if wanted is None:
            if not lasers:
                raise ValueError(f"the robot has no sensor_msgs/LaserScan topic; it has {_listed(topics)}")
            return lasers[0]
        if wanted in lasers:
            return wanted
        if wanted in topics:
            others = f", such as {', '.join(lasers)}" if lasers else ""
            raise ValueError(
                f"{wanted} is {topics[wanted] or 'of no type'}; choose a sensor_msgs/LaserScan topic{others}"
            )
        raise ValueError(f"the robot has no topic {wanted}; its laser topics: {', '.join(lasers) or 'none'}")

    def _send(self, **message: Any) -> None:
        self._socket.send(as_json(message))


def _is_trouble(message: Mapping[str, Any]) -> bool:
    return message.get("op") == "status" and message.get("level") == "error"


def _listed(topics: Mapping[str, str]) -> str:
    shown = [f"{name} ({type.replace('/msg/', '/')})" for name, type in list(topics.items())[:8]]
    return ", ".join(shown) + ("…" if len(topics) > 8 else "") or "no topic at all"
