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
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from lineseg_app.live.ring import Ring
from lineseg_app.live.source import Source
from lineseg_app.routes.push import _take
from lineseg_app.shelf.lessons import Home, lesson_files, read_lesson
from lineseg_app.shelf.library import Library
from lineseg_app.shelf.recent import Recent
from lineseg_app.shelf.uploads import Uploads
from lineseg_app.tuning.kept_trials import KeptTrials
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

UNEXPECTED = [
    None, True, 0, -1, 1.5, 10**400, -(2**63), 10**18, 1e308, float("nan"), float("inf"), "", "\ud800", "\0", "\n",
    "nan", "x" * 5000, "9" * 5000, "../../etc/passwd", "<script>", "{epsilon}", [], {}, [[]], [None] * 3000, {"": {}},
    {"self": 1}, json.loads("[" * 300 + "]" * 300),
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


def warped(tree: Any, chance: random.Random) -> Any:
    """A copy of a JSON value with one part of it replaced by what nobody expects there."""
    if not (isinstance(tree, dict | list) and tree) or chance.random() < 0.15:
        return chance.choice(UNEXPECTED)
    if isinstance(tree, list):
        at = chance.randrange(len(tree))
        return [warped(each, chance) if number == at else each for number, each in enumerate(tree)]
    name = chance.choice(list(tree))
    if chance.random() < 0.1:
        return tree | {chance.choice(["", "self", "__proto__", "\ud800", "x" * 5000, "1"]): chance.choice(UNEXPECTED)}
    return {key: warped(value, chance) if key == name else value for key, value in tree.items()}


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


def trees(folder: Path) -> dict[str, tuple[Any, Callable[[str], object]]]:
    """Files of JSON that people pass on or that are kept, with what reads them."""
    lessons = [json.loads(file.read_text("utf-8")) for file in lesson_files()[::4]]
    scans = folder / "scans"
    scans.mkdir(exist_ok=True)
    home = Home(folder, "x/", lambda: scans)
    seed = open_recording(SAMPLES / "hallway.npz").only(np.arange(2))
    packed = io.BytesIO()
    write_pack(packed, seed, 1, Params(), "a note")
    with zipfile.ZipFile(packed) as pack:
        about, frame = (pack.read(name) for name in ("lineseg.json", "frame.npz"))

    def written(name: str, text: str) -> Path:
        file = folder / name
        file.write_text(text, encoding="utf-8", errors="surrogatepass")
        return file

    def of_lesson(text: str) -> object:
        return read_lesson(written("lesson.json", text), home).model_dump_json()

    def of_recent(text: str) -> object:
        uploads, recent = Uploads(10, 1, 10), Recent(written("recent.json", text).parent)
        recent.add(Path("other.npz"))
        library = Library([], recent, uploads)
        return json.dumps([entry.model_dump() for entry in library.entries()]).encode()

    def of_pack(text: str) -> object:
        with zipfile.ZipFile(folder / "pack.zip", "w") as archive:
            archive.writestr("lineseg.json", text.encode("utf-8", "surrogatepass"))
            archive.writestr("frame.npz", frame)
        recording = open_recording(folder / "pack.zip")
        return recording.pack and json.dumps(asdict(recording.pack), allow_nan=False).encode()

    def of_trials(text: str) -> object:
        kept = KeptTrials(folder, {})
        kept.file.write_text(text, encoding="utf-8", errors="surrogatepass")
        return kept.read()

    def of_labels(text: str) -> object:
        return read_labels(written("x.lineseg.json", text), seed)

    found = {f"lesson {number}": (lesson, of_lesson) for number, lesson in enumerate(lessons)}
    reading = {"unit": "mm", "frames": "0:2", "range_max": 5.0}
    labels = {"format": "lineseg labels", "version": 1, "recording": {"name": "x", "frames": 2}, "frames": {
        "1": {"revision": 1, "beams": len(seed[1]), "tags": ["a"], "note": "n", "lines": [
            {"first": 1, "last": 9, "start": [0.0, 0.0], "end": [1.0, 1.0]}]}}}  # fmt: skip
    kept = Params().numbers()
    return found | {
        "recent files": (["/a/b.npz", {"path": "/a/c.csv", "reading": reading}], of_recent),
        "about a pack": (json.loads(about) | {"labels": labels["frames"]["1"]}, of_pack),
        "kept trials": ([kept, 0.5], of_trials),
        "labels": (labels, of_labels),
        "thresholds": ({"method": "region-growing", "params": kept}, read_params),
    }


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

    def of_tree(name: str, tree: Any, read: Callable[[str], object]):
        def make(chance: random.Random):
            changed = tree
            for _ in range(chance.choice([1, 1, 3])):
                changed = warped(changed, chance)
            text = json.dumps(changed, ensure_ascii=chance.random() < 0.5)
            return name, lambda: read(text), None

        return make

    def of_warped_message(message: dict):
        def make(chance: random.Random):
            text = json.dumps(warped(message, chance))
            return f"message {message['type']}", lambda: hear(text), None

        return make

    made = [of_recording(name, content) for name, content in recordings(folder).items()]
    made += [of_text(name, content, read) for name, (content, read) in texts().items()]
    made += [of_tree(name, tree, read) for name, (tree, read) in trees(folder).items()]
    return made + [make(message) for message in MESSAGES for make in (of_message, of_warped_message)]


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
            begun = time.thread_time()
            why = fault(work, place)
            # Of the processor, which other programs may use too.
            took = time.thread_time() - begun
            if why is None and took > SECONDS_A_CASE:
                why = f"took {took:.0f} s"
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
