"""How long segments take to come back: 4 lasers of 1081 beams at 40 Hz, on the loopback interface.

Each `lineseg node` is a process of its own. It says itself, when it ends, how long it took from the arrival of a scan
until its segments were published. The process that writes the scans measures the time until it has read the
PointCloud2, which includes the transport both ways. With `--wire` it measures, without a
node, how long a scan takes from another process until its ranges are an array.

    .venv/bin/python tests/benchmarks/node_latency.py --seconds 10
"""

from __future__ import annotations

import argparse
import itertools
import math
import struct
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from cyclonedds.core import InstanceState, ReadCondition, SampleState, ViewState, WaitSet
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from dds_peer import loopback, qos_of
from lineseg_app.bridges.cdr import CdrWriter
from lineseg_app.bridges.dds_domain import join
from lineseg_app.bridges.dds_types import serialised_type

from lineseg import open_recording
from lineseg.readers.laser_scan import decode_cdr

STAMP = struct.Struct("<iI")
RATE = 40
SAMPLE = Path(__file__).parents[2] / "sample_scans" / "laboratory.npz"


def scans() -> list[bytearray]:
    """LaserScan messages whose stamp is to be filled in."""
    recording = open_recording(SAMPLE)
    found = []
    for frame in range(0, len(recording), max(len(recording) // 50, 1)):
        cdr = CdrWriter()
        cdr.numbers("2I", 0, 0)
        cdr.text("laser")
        angle_min, step = float(recording.angle_min[frame]), float(recording.angle_increment[frame])
        ranges = recording[frame].ranges.astype(np.float32)
        cdr.numbers("7f", angle_min, -angle_min, step, 0.0, 1 / RATE, 0.0, 30.0)
        cdr.sequence(ranges)
        cdr.sequence(np.empty(0, np.float32))
        found.append(bytearray(cdr.bytes()))
    return found


def received(participant: Any, topics: list[str], stop: threading.Event, delays: list[float]) -> None:
    readers = [
        DataReader(
            participant, Topic(participant, f"rt{topic}/cloud", serialised_type("sensor_msgs/msg/PointCloud2")),
            qos=qos_of(reliable=True),
        )
        for topic in topics
    ]  # fmt: skip
    waiting = WaitSet(participant)
    conditions = [ReadCondition(each, SampleState.NotRead | ViewState.Any | InstanceState.Any) for each in readers]
    for each in conditions:
        waiting.attach(each)
    while not stop.is_set():
        waiting.wait(duration(milliseconds=100))
        for reader in readers:
            for sample in reader.take(100):
                if sample.sample_info.valid_data:
                    seconds, nanoseconds = STAMP.unpack_from(sample.data, 4)
                    delays.append(time.time() - seconds - 1e-9 * nanoseconds)


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--seconds", type=float, default=10.0)
    options.add_argument("--lasers", type=int, default=4)
    options.add_argument("--wire", action="store_true")
    options.add_argument("--write", action="store_true", help=argparse.SUPPRESS)
    given = options.parse_args()
    if given.wire:
        with loopback():
            writing = subprocess.Popen([sys.executable, __file__, "--write"])
            try:
                return wire_to_array()
            finally:
                writing.terminate()
    if given.write:
        return write_scans()
    topics = [f"/laser{number}" for number in range(given.lasers)]
    with loopback():
        nodes = [
            subprocess.Popen(
                [sys.executable, "-m", "lineseg_app", "node", f"ros2:{topic}", "--markers", f"{topic}/markers",
                 "--cloud", f"{topic}/cloud"], stderr=subprocess.PIPE, text=True,
            )
            for topic in topics
        ]  # fmt: skip
        try:
            measure(topics, given.seconds)
        finally:
            for node in nodes:
                node.terminate()
            for topic, node in zip(topics, nodes, strict=True):
                print(topic, node.communicate()[1].splitlines()[-1].removeprefix("lineseg: "))


def write_scans() -> None:
    """Until it is terminated; the stamp says when."""
    participant, kind, messages = join(None), serialised_type("sensor_msgs/msg/LaserScan"), scans()
    writer = DataWriter(participant, Topic(participant, "rt/wire", kind), qos=qos_of(reliable=True))
    for message in itertools.cycle(messages):
        now = time.time()
        STAMP.pack_into(message, 4, int(now), int(now % 1 * 1e9))
        writer.write(kind(bytes(message)))
        time.sleep(0.005)


def wire_to_array(times: int = 500) -> None:
    participant = join(None)
    topic = Topic(participant, "rt/wire", serialised_type("sensor_msgs/msg/LaserScan"))
    reader = DataReader(participant, topic, qos=qos_of(reliable=True))
    waiting, ready = WaitSet(participant), ReadCondition(reader, SampleState.Any | ViewState.Any | InstanceState.Any)
    waiting.attach(ready)
    beams, delays, spent = 0, [], 0.0
    while len(delays) < times:
        waiting.wait(duration(seconds=1))
        for sample in reader.take(1):
            scan = decode_cdr(sample.data)
            beams, spent = len(scan.ranges), spent or time.process_time()
            delays.append(1e3 * (time.time() - scan.stamp))
    spent = 1e3 * (time.process_time() - spent) / times
    middle, most = np.percentile(delays, (50, 95))
    print(f"{beams} beams, from another process to an array: p50 {middle:.2f} ms, p95 {most:.2f} ms; "
          f"the reader takes {spent:.2f} ms of processor for a scan")  # fmt: skip


def measure(topics: list[str], seconds: float) -> None:
    participant, stop, delays = join(None), threading.Event(), []
    kind = serialised_type("sensor_msgs/msg/LaserScan")
    writers = [DataWriter(participant, Topic(participant, f"rt{topic}", kind), qos=qos_of()) for topic in topics]
    thread = threading.Thread(target=received, args=(participant, topics, stop, delays))
    thread.start()
    messages = scans()
    while not all(writer.get_matched_subscriptions() for writer in writers):
        time.sleep(0.1)
    sent, began = 0, time.monotonic()
    for tick in range(math.ceil(seconds * RATE)):
        time.sleep(max(0.0, began + tick / RATE - time.monotonic()))
        for number, writer in enumerate(writers):
            now = time.time()
            message = messages[(tick + 7 * number) % len(messages)]
            STAMP.pack_into(message, 4, int(now), int(now % 1 * 1e9))
            writer.write(kind(bytes(message)))
            sent += 1
    time.sleep(0.5)
    stop.set()
    thread.join()
    at = np.percentile(1e3 * np.array(delays), (50, 95, 99))
    print(f"{len(delays)} of {sent} came back; p50 {at[0]:.2f} ms, p95 {at[1]:.2f} ms, p99 {at[2]:.2f} ms")


if __name__ == "__main__":
    main()
