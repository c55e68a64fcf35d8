"""A small rosbridge, written from the specification of its protocol, for the tests to connect to.

Topics with a type, services, and nodes with parameters. Errors of a client are answered like rosbridge does:
with a status of level "error", or a service_response whose result is false and whose values say why.
"""

from __future__ import annotations

import json
import math
import queue
import threading
from typing import Any

from waiting import SECONDS
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import ServerConnection, serve

SCAN, TEXT = "sensor_msgs/msg/LaserScan", "std_msgs/msg/String"


class RosBridgePeer:
    """Serves in threads until `close`, on a free port unless one is given."""

    def __init__(
        self,
        topics: dict[str, str] | None = None,
        nodes: dict[str, dict[str, int | float]] | None = None,
        rosapi: bool = True,
        port: int = 0,
    ) -> None:
        self.topics = {"/chatter": TEXT, "/scan": SCAN} if topics is None else topics
        self.nodes = nodes or {}
        self.rosapi = rosapi
        self.store: dict[str, str] = {}  # the parameter server of ROS 1
        self.received: queue.Queue[tuple[str, Any]] = queue.Queue()
        self.subscribed = threading.Event()
        self._subscribers: dict[ServerConnection, set[str]] = {}
        self._advertised: dict[ServerConnection, dict[str, str]] = {}
        self._lock = threading.Lock()
        self._server = serve(self._serve, "127.0.0.1", port, open_timeout=SECONDS, ping_interval=None)
        self.port = self._server.socket.getsockname()[1]
        self._thread = threading.Thread(target=self._server.serve_forever, name="rosbridge peer")
        self._thread.start()

    @property
    def url(self) -> str:
        return f"ws://127.0.0.1:{self.port}"

    def close(self) -> None:
        with self._lock:
            open_sockets = list(self._subscribers)
        self._server.shutdown()
        for socket in open_sockets:
            socket.close()
        self._thread.join(SECONDS)

    def publish(self, topic: str, message: Any) -> None:
        """To every subscriber; NaN and infinities are null in the JSON of rosbridge."""
        text = json.dumps({"op": "publish", "topic": topic, "msg": _json(message)})
        with self._lock:
            to = [socket for socket, topics in self._subscribers.items() if topic in topics]
        for socket in to:
            socket.send(text)

    def wait_until_heard(self) -> None:
        """Until every subscriber has taken in what was published. It answers the first ping perhaps a moment before."""
        with self._lock:
            sockets = list(self._subscribers)
        for socket in sockets:
            for _ in range(2):
                assert socket.ping().wait(SECONDS), "a subscriber does not answer"

    # --- one connection -----------------------------------------------------------------------------------------------

    def _serve(self, socket: ServerConnection) -> None:
        with self._lock:
            self._subscribers[socket], self._advertised[socket] = set(), {}
        try:
            for data in socket:
                self._answer(socket, data)
        except ConnectionClosed:
            pass
        finally:
            with self._lock:
                del self._subscribers[socket], self._advertised[socket]

    def _answer(self, socket: ServerConnection, data: str | bytes) -> None:
        try:
            message = json.loads(data)
            operation = getattr(self, f"_{message['op']}")
        except (ValueError, KeyError, AttributeError):
            return self._status(socket, f"Unknown operation: {data!r}")
        return operation(socket, message)

    def _status(self, socket: ServerConnection, words: str, id: str | None = None) -> None:
        status = {"op": "status", "level": "error", "msg": words}
        socket.send(json.dumps(status | ({"id": id} if id is not None else {})))

    def _subscribe(self, socket: ServerConnection, message: dict[str, Any]) -> None:
        topic, type = message["topic"], message.get("type")
        there = self.topics.get(topic)
        if there is None and type is None:
            return self._status(socket, f"Cannot infer type for topic {topic} as it is not yet advertised")
        if there is not None and type is not None and _short(type) != _short(there):
            words = f"Tried to subscribe to topic {topic} with type {type}, but it is already type {there}"
            return self._status(socket, words, message.get("id"))
        with self._lock:
            self._subscribers[socket].add(topic)
        self.subscribed.set()
        return None

    def _unsubscribe(self, socket: ServerConnection, message: dict[str, Any]) -> None:
        with self._lock:
            self._subscribers[socket].discard(message["topic"])

    def _advertise(self, socket: ServerConnection, message: dict[str, Any]) -> None:
        there = self.topics.get(message["topic"], message["type"])
        if _short(there) != _short(message["type"]):
            return self._status(socket, f"{message['topic']} is already established with type {there}")
        self._advertised[socket][message["topic"]] = message["type"]
        return None

    def _publish(self, socket: ServerConnection, message: dict[str, Any]) -> None:
        if message["topic"] not in self._advertised[socket]:
            return self._status(socket, f"Cannot publish to {message['topic']}: it is not advertised")
        return self.received.put((message["topic"], message["msg"]))

    def _call_service(self, socket: ServerConnection, message: dict[str, Any]) -> None:
        service, args = message["service"], message.get("args", {})
        try:
            values: Any = self._service(service, args)
            result = True
        except LookupError as error:
            values, result = str(error.args[0]), False
        answer = {"op": "service_response", "service": service, "values": values, "result": result}
        socket.send(json.dumps(answer | ({"id": message["id"]} if "id" in message else {})))

    # --- services -----------------------------------------------------------------------------------------------------

    def _service(self, service: str, args: dict[str, Any]) -> dict[str, Any]:
        node, _, name = service.rpartition("/")
        if node == "/rosapi" and self.rosapi:
            if name == "topics":
                return {"topics": list(self.topics), "types": list(self.topics.values())}
            if name == "set_param":
                self.store[args["name"]] = args["value"]
                return {}
            if name == "get_param":
                return {"value": self.store.get(args["name"], args["default"])}
        if node in self.nodes and name == "set_parameters":
            return {"results": [self._set(self.nodes[node], parameter) for parameter in args["parameters"]]}
        if node in self.nodes and name == "get_parameters":
            return {"values": [_value(self.nodes[node].get(name)) for name in args["names"]]}
        raise LookupError(f"Service {service} does not exist")

    def _set(self, there: dict[str, int | float], parameter: dict[str, Any]) -> dict[str, Any]:
        """As rclcpp answers: only declared parameters, only of their type."""
        name, value = parameter["name"], parameter["value"]
        if name not in there:
            return {"successful": False, "reason": f"parameter '{name}' cannot be set because it was not declared"}
        type = 2 if isinstance(there[name], int) else 3
        if value["type"] != type:
            words = "integer" if type == 2 else "double"
            return {"successful": False, "reason": f"Wrong parameter type, parameter {{{name}}} is of type {{{words}}}"}
        there[name] = value["integer_value" if type == 2 else "double_value"]
        return {"successful": True, "reason": ""}


def scan_message(ranges: list[float], second: int = 0, **fields: Any) -> dict[str, Any]:
    """A LaserScan of beams one degree apart, as ROS 2 sends it."""
    header = {"stamp": {"sec": second, "nanosec": 123456789}, "frame_id": "laser"}
    half = math.radians((len(ranges) - 1) / 2)
    angles = {"angle_min": -half, "angle_max": half, "angle_increment": math.radians(1.0)}
    rest = {"time_increment": 0.0, "scan_time": 0.1, "range_min": 0.1, "range_max": 30.0, "intensities": []}
    return {"header": header, **angles, **rest, "ranges": ranges} | fields


def _value(value: int | float | None) -> dict[str, Any]:
    all = {"type": 0, "bool_value": False, "integer_value": 0, "double_value": 0.0, "string_value": ""}
    if value is None:
        return all
    return all | ({"type": 2, "integer_value": value} if isinstance(value, int) else {"type": 3, "double_value": value})


def _json(value: Any) -> Any:
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {name: _json(each) for name, each in value.items()}
    return [_json(each) for each in value] if isinstance(value, list) else value


def _short(type: str) -> str:
    return type.replace("/msg/", "/")
