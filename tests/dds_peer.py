"""A participant of DDS in a process of its own, as a robot would have it: types written out, by Cyclone DDS alone.

Run as a program it obeys one JSON command a line, and answers each with one line.
"""

import contextlib
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import float32, float64, int32, sequence, uint8, uint32
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

# On the loopback interface alone, apart from every other program.
DOMAIN = 5
URI = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='true'/></Interfaces></General>"
    "<Discovery><Tag>lineseg-{}</Tag></Discovery></Domain></CycloneDDS>"
)


@dataclass
class Time(IdlStruct, typename="builtin_interfaces::msg::dds_::Time_"):
    sec: int32
    nanosec: uint32


@dataclass
class Duration(IdlStruct, typename="builtin_interfaces::msg::dds_::Duration_"):
    sec: int32
    nanosec: uint32


@dataclass
class Header(IdlStruct, typename="std_msgs::msg::dds_::Header_"):
    stamp: Time
    frame_id: str


@dataclass
class LaserScan(IdlStruct, typename="sensor_msgs::msg::dds_::LaserScan_"):
    header: Header
    angle_min: float32
    angle_max: float32
    angle_increment: float32
    time_increment: float32
    scan_time: float32
    range_min: float32
    range_max: float32
    ranges: sequence[float32]
    intensities: sequence[float32]


@dataclass
class OtherScan(IdlStruct, typename="sensor_msgs::msg::dds_::LaserScan_"):
    ranges: sequence[float32]
    angle_min: float64
    header: Header


@dataclass
class String(IdlStruct, typename="std_msgs::msg::dds_::String_"):
    data: str


@dataclass
class Point(IdlStruct, typename="geometry_msgs::msg::dds_::Point_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Vector3(IdlStruct, typename="geometry_msgs::msg::dds_::Vector3_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Quaternion(IdlStruct, typename="geometry_msgs::msg::dds_::Quaternion_"):
    x: float64
    y: float64
    z: float64
    w: float64


@dataclass
class Pose(IdlStruct, typename="geometry_msgs::msg::dds_::Pose_"):
    position: Point
    orientation: Quaternion


@dataclass
class ColorRGBA(IdlStruct, typename="std_msgs::msg::dds_::ColorRGBA_"):
    r: float32
    g: float32
    b: float32
    a: float32


@dataclass
class CompressedImage(IdlStruct, typename="sensor_msgs::msg::dds_::CompressedImage_"):
    header: Header
    format: str
    data: sequence[uint8]


@dataclass
class UVCoordinate(IdlStruct, typename="visualization_msgs::msg::dds_::UVCoordinate_"):
    u: float32
    v: float32


@dataclass
class MeshFile(IdlStruct, typename="visualization_msgs::msg::dds_::MeshFile_"):
    filename: str
    data: sequence[uint8]


@dataclass
class Marker(IdlStruct, typename="visualization_msgs::msg::dds_::Marker_"):
    header: Header
    ns: str
    id: int32
    type: int32
    action: int32
    pose: Pose
    scale: Vector3
    color: ColorRGBA
    lifetime: Duration
    frame_locked: bool
    points: sequence[Point]
    colors: sequence[ColorRGBA]
    texture_resource: str
    texture: CompressedImage
    uv_coordinates: sequence[UVCoordinate]
    text: str
    mesh_resource: str
    mesh_file: MeshFile
    mesh_use_embedded_materials: bool


@dataclass
class MarkerArray(IdlStruct, typename="visualization_msgs::msg::dds_::MarkerArray_"):
    markers: sequence[Marker]


@dataclass
class PointField(IdlStruct, typename="sensor_msgs::msg::dds_::PointField_"):
    name: str
    offset: uint32
    datatype: uint8
    count: uint32


@dataclass
class PointCloud2(IdlStruct, typename="sensor_msgs::msg::dds_::PointCloud2_"):
    header: Header
    height: uint32
    width: uint32
    fields: sequence[PointField]
    is_bigendian: bool
    point_step: uint32
    row_step: uint32
    data: sequence[uint8]
    is_dense: bool


TYPES = {each.__name__: each for each in (LaserScan, OtherScan, String, MarkerArray, PointCloud2)}


# --- the program ------------------------------------------------------------------------------------------------------


class Obeying:
    def __init__(self) -> None:
        self.participant = DomainParticipant(DOMAIN)
        self.topics: dict[str, Topic] = {}
        self.ends: dict[str, Any] = {}

    def open(self, topic: str, kind: str, write: bool, **qos: bool) -> None:
        """A writer or a reader of a topic, under its name."""
        if topic not in self.topics:
            self.topics[topic] = Topic(self.participant, f"rt{topic}", TYPES[kind])
        of = DataWriter if write else DataReader
        self.ends[topic] = of(self.participant, self.topics[topic], qos=qos_of(**qos))

    def matched(self, topic: str) -> int:
        end = self.ends[topic]
        others = end.get_matched_subscriptions() if isinstance(end, DataWriter) else end.get_matched_publications()
        return len(others)

    def scan(
        self,
        topic: str,
        ranges: list[float],
        second: int = 0,
        angles: tuple[float, float] = (-0.7853982, 0.017453292),
        limits: tuple[float, float] = (0.0, 30.0),
        times: int = 1,
    ) -> None:
        """Scans of beams from the first of `angles` on, the second apart."""
        for each in range(times):
            header = Header(Time(second + each, 123456789), "laser")
            angle_max = angles[0] + angles[1] * (len(ranges) - 1)
            self.ends[topic].write(LaserScan(header, angles[0], angle_max, angles[1], 0.0, 0.1, *limits, ranges, []))
            if times > 1:
                time.sleep(0.001)

    def take(self, topic: str) -> list[Any]:
        return [asdict(each) for each in self.ends[topic].take(100) if each.sample_info.valid_data]


def qos_of(reliable: bool = False, kept: bool = False, xcdr2: bool = False, exclusive: bool = False) -> Qos:
    return Qos(
        Policy.Reliability.Reliable(100_000_000) if reliable else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if kept else Policy.Durability.Volatile,
        Policy.History.KeepLast(10),
        Policy.Ownership.Exclusive if exclusive else Policy.Ownership.Shared,
        Policy.DataRepresentation(use_cdrv0_representation=not xcdr2, use_xcdrv2_representation=xcdr2),
    )


def obey() -> None:
    obeying = Obeying()
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(obeying, command.pop("do"))(**command)), flush=True)


# --- the other end ----------------------------------------------------------------------------------------------------


def start() -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


@contextlib.contextmanager
def loopback() -> Iterator[None]:
    """Keep this process and its children on the loopback interface, apart from all others."""
    before = {name: os.environ.get(name) for name in ("CYCLONEDDS_URI", "ROS_DOMAIN_ID")}
    os.environ.update(CYCLONEDDS_URI=URI.format(os.getpid()), ROS_DOMAIN_ID=str(DOMAIN))
    try:
        yield
    finally:
        for name, value in before.items():
            os.environ.pop(name, None) if value is None else os.environ.__setitem__(name, value)


if __name__ == "__main__":
    obey()
