"""Messages of ROS 1 and ROS 2 for bags, written by `rosbags`."""

import numpy as np
from rosbags.typesys import Stores, get_typestore

SCAN, TEXT = "sensor_msgs/msg/LaserScan", "std_msgs/msg/String"
STORES = {1: get_typestore(Stores.ROS1_NOETIC), 2: get_typestore(Stores.ROS2_HUMBLE)}


def message(
    version, ranges, stamp=12.5, frame_id="laser", angle_min=-1.5, increment=0.01, angle_max=0.0, limits=(0.1, 30.0)
):
    types = STORES[version].types
    seconds = int(stamp)
    time = types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=round((stamp - seconds) * 1e9))
    sequence = {"seq": 0} if version == 1 else {}
    return types[SCAN](
        header=types["std_msgs/msg/Header"](stamp=time, frame_id=frame_id, **sequence),
        angle_min=angle_min,
        angle_max=angle_max,
        angle_increment=increment,
        time_increment=0.0,
        scan_time=0.025,
        range_min=limits[0],
        range_max=limits[1],
        ranges=np.asarray(ranges, np.float32),
        intensities=np.full(len(ranges), 7, np.float32),
    )


def encoded(version, scan):
    store = STORES[version]
    return bytes(store.serialize_ros1(scan, SCAN) if version == 1 else store.serialize_cdr(scan, SCAN))
