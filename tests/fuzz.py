"""Damaged recordings, texts and messages: each opens, or is refused with one sentence that names the place.

`make test` runs a few thousand; for more, `.venv/bin/python -m tests.fuzz --minutes 30`. A case is repeated with
`--seed N --cases 1`.
"""

from __future__ import annotations

import argparse
import gzip
import io
import json
import random
import sqlite3
import sys
import tempfile
import time
import traceback
import zipfile
from collections import Counter
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import numpy as np
from lineseg_app.live.ring import Ring
from lineseg_app.live.source import Source
from lineseg_app.routes.push import _take
from lineseg_app.view import View
from lineseg_app.wire import BadMessageError, Change, Hello, OpenLink, parse
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

from lineseg import Params, Recording, Scan, open_recording, write_pack
from lineseg.readers import save_npz
from lineseg.sweep.table import read_table
from lineseg.truth.label_file import read_labels
from lineseg.writers import PARAMS_WRITERS, params_text, read_params

SAMPLES = Path(__file__).parents[1] / "sample_scans"
SECONDS_A_CASE = 20
LONGEST_SENTENCE = 2000
HOSTILE = [
    b"0", b"-1", b"nan", b"inf", b"1e999", b"9" * 400, b"2147483648", b"18446744073709551615", b"", b"\0", b"\xff\xfe",
    b'"\\ud800"', b"null", b"[]", b"{}", b"!!int \"\"", b"\xed\xa0\x80", b"\xe2\x82\xac", b"self", b"\n", b",", b"  ",
    b"9" * 5000,
]  # fmt: skip


def mutant(content: bytes, chance: random.Random) -> bytes:
    """A copy with a few changes: bytes, pieces, numbers, and ends."""
    out = bytearray(content)
    for _ in range(chance.choice([1, 1, 2, 4, 16])):
        at = chance.randrange(len(out) + 1)
        end = min(len(out), at + chance.choice([1, 2, 4, 8, 50, 500]))
        match chance.randrange(7):
            case 0:
                out[at : at + 1] = bytes([chance.randrange(256)])
            case 1:
                del out[at:end]
            case 2:
                out[at:at] = out[at:end]
            case 3:
                out[at:end] = chance.randbytes(end - at)
            case 4:
                del out[at:]
            case 5:
                out[at : at + chance.choice([4, 8])] = chance.choice([b"\xff" * 8, b"\0" * 8, b"\xff\xff\xff\x7f"])
            case 6:
                numbers = [place for place in range(at, min(at + 200, len(out))) if chr(out[place]).isdigit()]
                place = chance.choice(numbers or [at])
                out[place : place + 1] = chance.choice(HOSTILE)
    return bytes(out)


def recordings(folder: Path) -> dict[str, bytes]:
    """A small recording of each format, by the name of its file."""
    hallway = open_recording(SAMPLES / "hallway.npz").only(np.arange(3))
    small = Recording.from_scans([Scan.regular(scan.ranges[::12], -2.3, 0.05) for scan in hallway])
    save_npz(small, folder / "seed.npz")
    pack = io.BytesIO()
    write_pack(pack, small, 0, Params(), "a note")
    lines = {name: (SAMPLES / name).read_bytes().splitlines(keepends=True) for name in ("hallway.log", "hallway.csv")}
    log, table = b"".join(lines["hallway.log"][:6]), b"".join(lines["hallway.csv"][:4])
    scans = [{"ranges": scan.ranges.tolist(), "angle_min": -1.5, "angle_increment": 0.01} for scan in small]
    zipped = io.BytesIO()
    with zipfile.ZipFile(zipped, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("seed.log", log)
    return {
        "seed.npz": (folder / "seed.npz").read_bytes(),
        "seed_pack.zip": pack.getvalue(),
        "seed.log": log,
        "seed.log.gz": gzip.compress(log),
        "seed.zip": zipped.getvalue(),
        "seed.csv": table,
        "seed.json": json.dumps(scans[0]).encode(),
        "seed.jsonl": "\n".join(json.dumps(scan) for scan in scans).encode(),
        "seed.yaml": b"\n---\n".join(b"ranges: " + json.dumps(scan["ranges"]).encode() for scan in scans),
        "seed.mcap": (SAMPLES / "hallway.mcap").read_bytes(),
        "seed.db3": _database(folder / "seed.db3", small),
        "seed.bag": _bag(folder / "seed.bag", small),
    }


def _message(store, scan, version: int):
    types, laser = store.types, "sensor_msgs/msg/LaserScan"
    stamp = types["builtin_interfaces/msg/Time"](sec=1, nanosec=2)
    head = types["std_msgs/msg/Header"](stamp=stamp, frame_id="laser", **({"seq": 0} if version == 1 else {}))
    ranges = scan.ranges.astype(np.float32)
    values = {"angle_min": -1.5, "angle_max": 1.5, "angle_increment": 0.03, "time_increment": 0.0, "scan_time": 0.1}
    limits = {"range_min": 0.1, "range_max": 30.0, "ranges": ranges, "intensities": ranges[:0]}
    message = types[laser](header=head, **values, **limits)
    return bytes(store.serialize_ros1(message, laser) if version == 1 else store.serialize_cdr(message, laser))


def _bag(path: Path, recording: Recording) -> bytes:
    store = get_typestore(Stores.ROS1_NOETIC)
    with Writer(path) as writer:
        connection = writer.add_connection("/scan", "sensor_msgs/msg/LaserScan", typestore=store)
        for number, scan in enumerate(recording):
            writer.write(connection, number, _message(store, scan, 1))
    return path.read_bytes()


def _database(path: Path, recording: Recording) -> bytes:
    store = get_typestore(Stores.ROS2_HUMBLE)
    with closing(sqlite3.connect(path)) as database:
        database.execute("CREATE TABLE topics(id INTEGER, name TEXT, type TEXT, serialization_format TEXT)")
        database.execute("CREATE TABLE messages(id INTEGER, topic_id INTEGER, timestamp INTEGER, data BLOB)")
        database.execute("INSERT INTO topics VALUES (1, '/scan', 'sensor_msgs/msg/LaserScan', 'cdr')")
        rows = [(number, 1, number, _message(store, scan, 2)) for number, scan in enumerate(recording)]
        database.executemany("INSERT INTO messages VALUES (?, ?, ?, ?)", rows)
        database.commit()
    return path.read_bytes()


def texts() -> dict[str, tuple[bytes, Callable[[bytes, Path], object]]]:
    """Other things that people open, with what reads them."""
    recording = Recording.from_scans(list(open_recording(SAMPLES / "hallway.npz").only(np.arange(2))))
    labels = {
        "format": "lineseg labels", "version": 1, "recording": {"name": recording.name, "frames": 2},
        "frames": {"0": {"revision": 1, "beams": len(recording[0]), "tags": ["a"], "note": "n",
                         "lines": [{"first": 1, "last": 9, "start": [0, 0], "end": [1, 1]}]}},
    }  # fmt: skip

    def of_file(content: bytes, path: Path) -> object:
        path.write_bytes(content)
        return read_labels(path, recording)

    def of_text(content: bytes, path: Path) -> object:
        return read_params(content.decode("utf-8", "surrogateescape"))

    found = {f"params.{to}": (params_text(Params(), to).encode(), of_text) for to in PARAMS_WRITERS}
    header = ",".join(["file", *Params().numbers(), "frames"])
    row = ",".join(["a.npz", *map(str, Params().numbers().values()), "5"])
    found["sweep.csv"] = (f"{header}\n{row}\n".encode(), lambda content, path: read_table(content, path.name))
    found["seed.lineseg.json"] = (json.dumps(labels).encode(), of_file)
    pushed = {"header": {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": "laser"}, "angle_min": -1.5,
              "angle_increment": 0.1, "range_min": 0.1, "range_max": 30.0, "ranges": [1.0, 2.0, None, 3.0]}  # fmt: skip
    source = Source("live:x", "x", Ring(5), lambda: None)
    found["pushed"] = (json.dumps(pushed).encode(), lambda content, path: _take(source, content))
    return found


MESSAGES = [
    {"type": "hello", "session": None, "view": {"recording": "sample:hallway", "frame": 1, "mode": "learn"}, "rev": 1},
    {"type": "view", "rev": 3, "patch": {"frame": 1, "params": {"epsilon": 0.02}, "selected": 3, "topic": "/scan"}},
    {"type": "link", "rev": 4, "patch": {"frame": 9, "beam": 3, "self": 1, "mode": "zz", "layers": ["points"]}},
    {"type": "follow", "id": "x"},
    {"type": "cancel"},
]


def hear(text: str) -> object:
    """What the server does with a message, up to the View and the answer on the wire."""
    message = parse(text)
    view = View(recording="sample:hallway")
    complaint = None
    match message:
        case Hello():
            view, complaint = view.salvaged(message.view or {})
        case OpenLink():
            view, complaint = view.salvaged(message.patch)
        case Change():
            view = view.patched(message.patch.changes())
    json.dumps(view.as_json(), allow_nan=False).encode()
    return (complaint or "").encode()


def fault(work: Callable[[], object], place: str | None) -> str | None:
    """Why the outcome is not as promised; None if it is."""
    try:
        work()
    except (ValueError, OSError) as error:
        sentence = str(error)
        if type(error) in (UnicodeDecodeError, UnicodeEncodeError, RecursionError):
            return f"a bare {type(error).__name__}"
        if "\n" in sentence or not sentence or len(sentence) > LONGEST_SENTENCE:
            return f"not one sentence: {sentence[:200]!r}"
        if "set_int_max_str_digits" in sentence:
            return f"Python's advice to programmers: {sentence[:200]}"
        if place is not None and place not in sentence:
            return f"does not name the file: {sentence[:200]}"
        if not isinstance(error, BadMessageError):
            try:
                sentence.encode()
            except UnicodeEncodeError:
                return "a sentence that cannot be sent"
    except Exception:
        return traceback.format_exc(limit=-3)
    return None


def opened(path: Path) -> object:
    """What a file was taken for; most of it is found out only when asked for."""
    account = open_recording(path).account
    return account and account.findings


def cases(folder: Path) -> list[Callable[[random.Random], tuple[str, Callable[[], object], str | None]]]:
    """Makers of a case: its kind, what to do, and the name that an error must have."""

    def of_recording(name: str, content: bytes):
        def make(chance: random.Random):
            path = folder / f"bad_{name}"
            path.write_bytes(mutant(content, chance))
            return name, lambda: opened(path), path.name

        return make

    def of_text(name: str, content: bytes, read: Callable[[bytes, Path], object]):
        def make(chance: random.Random):
            changed = mutant(content, chance)
            return name, lambda: read(changed, folder / name), None

        return make

    def of_message(message: dict):
        def make(chance: random.Random):
            text = mutant(json.dumps(message).encode(), chance).decode("utf-8", chance.choice(["replace", "ignore"]))
            return f"message {message['type']}", lambda: hear(text), None

        return make

    made = [of_recording(name, content) for name, content in recordings(folder).items()]
    made += [of_text(name, content, read) for name, (content, read) in texts().items()]
    return made + [of_message(message) for message in MESSAGES]


def run(seed: int, number: int, seconds: float = float("inf"), tell: Callable[[str], None] = print) -> Counter[str]:
    """Run cases `seed` … `seed + number - 1`, or until the time is over; returns counts of "cases" and of faults."""
    counts: Counter[str] = Counter()
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as folder:
        makers = cases(Path(folder))
        for case in range(seed, seed + number):
            if time.monotonic() > end:
                break
            kind, work, place = makers[case % len(makers)](random.Random(case))
            begun = time.monotonic()
            why = fault(work, place)
            if why is None and time.monotonic() - begun > SECONDS_A_CASE:
                why = f"took {time.monotonic() - begun:.0f} s"
            counts["cases"] += 1
            if why is not None:
                counts[kind] += 1
                tell(f"case {case}, {kind}: {why}")
    return counts


def main() -> int:
    flags = argparse.ArgumentParser(description=__doc__)
    flags.add_argument("--minutes", type=float, default=1.0)
    flags.add_argument("--seed", type=int, default=random.randrange(10**9), help="the first case")
    flags.add_argument("--cases", type=int, default=10**9)
    given = flags.parse_args()
    counts = run(given.seed, given.cases, 60 * given.minutes)
    faults = counts.total() - counts["cases"]
    print(f"{counts['cases']} cases from seed {given.seed}, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
