"""A robot with rmw_zenoh in a process of its own: a router, and a node by zenoh-ros2-sdk, another implementation.

Run as a program with a port it obeys one JSON command a line, and answers each with one line.
"""

import json
import os
import struct
import subprocess
import sys
from collections import defaultdict
from typing import Any

import numpy as np
import zenoh
from rosbags.typesys import Stores, get_typestore
from zenoh.ext import CacheConfig, declare_advanced_publisher

LOOPBACK = "127.0.0.1"
STORE = get_typestore(Stores.ROS2_JAZZY)


class Obeying:
    def __init__(self, port: int) -> None:
        config = zenoh.Config()
        config.insert_json5("mode", '"router"')
        config.insert_json5("listen/endpoints", f'["tcp/{LOOPBACK}:{port}"]')
        config.insert_json5("scouting/multicast/enabled", "false")
        self.router = zenoh.open(config)
        self.where = {"router_ip": LOOPBACK, "router_port": port}
        self.received: dict[str, list[Any]] = defaultdict(list)
        self.ends: dict[str, Any] = {}
        self.attached: dict[str, list[bytes]] = defaultdict(list)

    def publisher(self, topic: str, type: str = "sensor_msgs/msg/LaserScan", hash: str | None = None) -> None:
        from zenoh_ros2_sdk import ROS2Publisher

        self.ends[topic] = ROS2Publisher(topic, type, **defined(type, hash), **self.where)

    def subscriber(self, topic: str, type: str, hash: str | None = None) -> None:
        from zenoh_ros2_sdk import ROS2Subscriber

        self.ends[topic] = ROS2Subscriber(topic, type, self.received[topic].append, **defined(type, hash), **self.where)
        self.router.declare_subscriber(f"0{topic}/**", lambda s: self.attached[topic].append(s.attachment.to_bytes()))

    def scan(self, topic: str, ranges: list[float], second: int = 0, losing: int = 0) -> None:
        """losing: messages before it that seem to be lost."""
        end = self.ends[topic]
        end.sequence_number += losing
        end.publish(**fields_of(end.session_mgr.store.types, ranges, second))

    def keeper(self, topic: str, ranges: list[float], seconds: list[int]) -> None:
        """Publish scans of these stamps as rmw_zenoh does with a transient local topic: they are kept."""
        name, dds = "sensor_msgs/msg/LaserScan", "sensor_msgs::msg::dds_::LaserScan_"
        hash = STORE.hash_rihs01(name)
        kept = {"cache": CacheConfig(len(seconds)), "publisher_detection": True}
        end = declare_advanced_publisher(self.router, f"0{topic}/{dds}/{hash}", **kept)
        for number, second in enumerate(seconds, 1):
            data = STORE.serialize_cdr(STORE.types[name](**fields_of(STORE.types, ranges, second)), name)
            end.put(bytes(data), attachment=struct.pack("<qqB", number, 0, 16) + bytes(16))
        entity = f"@ros2_lv/0/{self.router.info.zid()}/0/1/MP/%/%/laser/{topic.replace('/', '%')}/{dds}/{hash}"
        self.ends[topic] = end, self.router.liveliness().declare_token(f"{entity}/:1:,{len(seconds)}:,:,:,,")

    def take(self, topic: str) -> list[Any]:
        taken, self.received[topic][:] = self.received[topic][:], []
        return [plain(each) for each in taken]

    def numbers(self, topic: str) -> list[list[Any]]:
        """The number of each message and the id of its writer, as rmw_zenoh attaches them."""
        return [[int.from_bytes(each[:8], "little"), each[17:].hex()] for each in self.attached[topic]]

    def close(self, topic: str) -> None:
        self.ends.pop(topic).close()


def fields_of(types: Any, ranges: list[float], second: int) -> dict[str, Any]:
    stamp = types["builtin_interfaces/msg/Time"](sec=second, nanosec=7)
    numbers = {"angle_min": -0.7853982, "angle_max": 0.7853982, "angle_increment": 0.017453292, "time_increment": 0.0}
    limits = {"scan_time": 0.1, "range_min": 0.0, "range_max": 30.0}
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="laser")
    arrays = {"ranges": np.array(ranges, np.float32), "intensities": np.empty(0, np.float32)}
    return {"header": header, **numbers, **limits, **arrays}


def defined(type: str, hash: str | None) -> dict[str, str]:
    """The definition as text, with those it consists of; the library would fetch it otherwise."""
    text = STORE.generate_msgdef(type, ros_version=2)[0]
    return {"msg_definition": text, "type_hash": hash or STORE.hash_rihs01(type)}


def plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, list):
        return [plain(each) for each in value]
    fields = getattr(value, "__dataclass_fields__", None)
    return value if fields is None else {name: plain(getattr(value, name)) for name in fields if name[0] != "_"}


def obey(port: int) -> None:
    obeying = Obeying(port)
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(obeying, command.pop("do"))(**command)), flush=True)


def start(port: int) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, __file__, str(port)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"GIT_ALLOW_PROTOCOL": "none"},
    )


if __name__ == "__main__":
    obey(int(sys.argv[1]))
