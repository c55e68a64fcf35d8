"""Messages of ROS 1 and ROS 2 for bags, written by `rosbags`."""

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

SCAN, TEXT = "sensor_msgs/msg/LaserScan", "std_msgs/msg/String"
TREE, ODOMETRY = "tf2_msgs/msg/TFMessage", "nav_msgs/msg/Odometry"
STORES = {1: get_typestore(Stores.ROS1_NOETIC), 2: get_typestore(Stores.ROS2_HUMBLE)}
STORES[1].register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TREE))


def header(version, stamp, frame_id):
    types = STORES[version].types
    seconds = int(stamp)
    time = types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=round((stamp - seconds) * 1e9))
    sequence = {"seq": 0} if version == 1 else {}
    return types["std_msgs/msg/Header"](stamp=time, frame_id=frame_id, **sequence)


def transform(version, stamp, parent, child, place=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0, 1.0)):
    """geometry_msgs/TransformStamped."""
    types = STORES[version].types
    at = types["geometry_msgs/msg/Vector3"](*place)
    motion = types["geometry_msgs/msg/Transform"](at, types["geometry_msgs/msg/Quaternion"](*turn))
    return types["geometry_msgs/msg/TransformStamped"](header(version, stamp, parent), child, motion)


def odometry(version, stamp, frame, child, place, turn):
    """nav_msgs/Odometry."""
    types, nothing = STORES[version].types, np.zeros(36)
    still = types["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    pose = types["geometry_msgs/msg/Pose"](
        types["geometry_msgs/msg/Point"](*place), types["geometry_msgs/msg/Quaternion"](*turn)
    )
    return types["nav_msgs/msg/Odometry"](
        header(version, stamp, frame), child, types["geometry_msgs/msg/PoseWithCovariance"](pose, nothing),
        types["geometry_msgs/msg/TwistWithCovariance"](types["geometry_msgs/msg/Twist"](still, still), nothing),
    )  # fmt: skip


def message(
    version,
    ranges,
    stamp=12.5,
    frame_id="laser",
    angle_min=-1.5,
    increment=0.01,
    angle_max=0.0,
    limits=(0.1, 30.0),
    time_increment=0.0,
):
    return STORES[version].types[SCAN](
        header=header(version, stamp, frame_id),
        angle_min=angle_min,
        angle_max=angle_max,
        angle_increment=increment,
        time_increment=time_increment,
        scan_time=0.025,
        range_min=limits[0],
        range_max=limits[1],
        ranges=np.asarray(ranges, np.float32),
        intensities=np.full(len(ranges), 7, np.float32),
    )


def encoded(version, scan):
    store = STORES[version]
    return bytes(store.serialize_ros1(scan, SCAN) if version == 1 else store.serialize_cdr(scan, SCAN))


def bag1(path, *publishers, text=(), stamps=(12.5, 12.6, 12.7)):
    """A ROS 1 bag; each publisher is (topic, ranges) and sends its scan once for each stamp."""
    with Writer1(path) as writer:
        if text:
            noise = writer.add_connection("/chatter", TEXT, typestore=STORES[1])
            for word in text:
                writer.write(noise, 1, STORES[1].serialize_ros1(STORES[1].types[TEXT](data=word), TEXT))
        connections = [
            writer.add_connection(topic, SCAN, typestore=STORES[1], callerid=f"/driver_{number}")
            for number, (topic, _) in enumerate(publishers)
        ]
        for number, stamp in enumerate(stamps):
            for connection, (_, ranges) in zip(connections, publishers, strict=True):
                writer.write(connection, 10**9 * (100 + number), encoded(1, message(1, ranges, stamp)))
    return path


def bag2(path, *publishers, plugin=StoragePlugin.SQLITE3, compression=None, stamps=(12.5, 12.6, 12.7)):
    """The folder of a ROS 2 bag, as `bag1`."""
    writer = Writer2(path, version=8, storage_plugin=plugin)
    if compression:
        writer.set_compression(compression, CompressionFormat.ZSTD)
    with writer:
        connections = [writer.add_connection(topic, SCAN, typestore=STORES[2]) for topic, _ in publishers]
        for number, stamp in enumerate(stamps):
            for connection, (_, ranges) in zip(connections, publishers, strict=True):
                writer.write(connection, 10**9 * (100 + number), encoded(2, message(2, ranges, stamp)))
    return path
