"""Labels in NAME.lineseg.json next to the recording; several writers may change it at the same time."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..failing import named, plain
from ..scan import Recording
from ..unfinished import whole_file
from .labels import FrameLabels, Labels, TrueLine, check_labels

FORMAT, VERSION = "lineseg labels", 1
SUFFIX = ".lineseg.json"
# In the user's folder.
LABELS = "labels"
MOST_BYTES = 256 << 20
# File systems allow 255 bytes.
LONGEST_NAME = 235
# Labels and the number of beams, by frame of the file.
Entries = dict[int, tuple[FrameLabels, int]]

# For the threads of this process; other processes are kept out by locking the folder.
_writing = threading.Lock()


class ConflictError(ValueError):
    """Somebody else has saved this frame since it was read. theirs: what they saved."""

    def __init__(self, sentence: str, theirs: FrameLabels) -> None:
        super().__init__(sentence)
        self.theirs = theirs


def label_file(recording: str | Path, user_folder: Path | None = None) -> Path:
    """Path of the labels for a recording's file: next to it, or in the user's folder if that is not writable.

    Labels that already exist next to it are always found.
    """
    path = Path(recording).absolute()
    beside = path.with_name(path.name + SUFFIX)
    if len(os.fsencode(beside.name)) <= LONGEST_NAME and (beside.exists() or os.access(path.parent, os.W_OK)):
        return beside
    return users_label_file(path.name, str(path), user_folder)


def users_label_file(name: str, identity: str, user_folder: Path | None = None) -> Path:
    """Path of the labels for a recording that is not a user's file. identity: distinguishes it from others."""
    if user_folder is None:
        import platformdirs

        user_folder = Path(platformdirs.user_data_dir("lineseg", appauthor=False))
    digest = hashlib.sha256(os.fsencode(identity)).hexdigest()[:12]
    short = os.fsencode(name)[: LONGEST_NAME // 2].decode(errors="ignore")
    return user_folder / LABELS / f"{short}.{digest}{SUFFIX}"


def read_labels(path: str | Path, recording: Recording) -> Labels:
    """The labels of each labelled frame of the recording, by its number in the file; empty if there is no label file.

    Raises ValueError for a damaged file, a newer version, or a recording with other frames or beams.
    """
    path = Path(path)
    return {frame: labels for frame, (labels, _) in _all_labels(path, recording).items() if recording.has(frame)}


def _all_labels(path: Path, recording: Recording) -> Entries:
    """The labels of frames that were left out too."""
    with named(path.name, passed=(OSError,)):
        return _read(path, recording)


def _read(path: Path, recording: Recording) -> Entries:
    try:
        if path.stat().st_size > MOST_BYTES:
            raise ValueError(f"{path.name} has {path.stat().st_size} bytes; label files have at most {MOST_BYTES}.")
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return {}
    except UnicodeDecodeError:
        raise ValueError(f"{path.name} is not a text file; labels are JSON. Move it away to start again.") from None
    try:
        tree = json.loads(text)
    except (ValueError, RecursionError) as error:
        where = f":{error.lineno}" if isinstance(error, json.JSONDecodeError) else ""
        raise ValueError(
            f"{path.name}{where}: this is not JSON ({plain(str(error))}). Repair the file or move it away."
        ) from None
    try:
        return _labels_in(tree, recording)
    except (KeyError, TypeError, AttributeError) as error:
        missing = f"{error} is missing" if isinstance(error, KeyError) else str(error)
        raise ValueError(f"{path.name} is not a valid label file: {missing}.") from None
    except OverflowError:
        raise ValueError(f"{path.name} has a number that is too large for a label file.") from None
    except ValueError as error:
        raise ValueError(f"{path.name}: {plain(str(error))}.") from None


def save_labels(path: str | Path, recording: Recording, frame: int, labels: FrameLabels) -> FrameLabels:
    """Save the labels of one frame and keep those of all other frames. Returns them as saved.

    `labels.revision` is the revision that was read or last saved. Raises ConflictError if the file has a newer one, and
    ValueError if the file is not valid (see `read_labels`) or the labels do not fit this frame; then nothing is
    written. The file is replaced atomically, after the new one is on disk.
    """
    # A link stays a link: its target is replaced.
    path = Path(path).resolve()
    if path.exists() and not path.stat().st_mode & 0o222:
        raise PermissionError(errno.EACCES, "the file is write-protected", str(path))
    labels = _clean(labels)
    check_labels(labels, recording, frame)
    path.parent.mkdir(parents=True, exist_ok=True)
    with _alone_in(path.parent):
        known = _all_labels(path, recording)
        theirs, _ = known.get(frame, (FrameLabels(), 0))
        if theirs.revision != labels.revision:
            raise ConflictError(
                f"frame {frame} was changed elsewhere: it is at revision {theirs.revision}, you have "
                f"{labels.revision}. Nothing was saved. Load the newer labels, or save again to overwrite them.",
                theirs,
            )
        saved = replace(labels, revision=labels.revision + 1)
        beams = len(recording[recording.position(frame)])
        _replace(path, _text_of(known | {frame: (saved, beams)}, recording))
    return saved


@contextmanager
def _alone_in(folder: Path) -> Iterator[None]:
    """Keep other writers out. The lock ends with the process, even a killed one."""
    with _writing:
        try:
            import fcntl
        except ImportError:
            # Windows cannot lock a folder.
            yield
            return
        handle = os.open(folder, os.O_RDONLY)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX)
            yield
        finally:
            os.close(handle)


def _replace(path: Path, text: str) -> None:
    """Write the file; its content is on the disk before its name is."""
    with whole_file(path) as part, part.open("w", encoding="utf-8", newline="\n") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    with suppress(OSError):
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def _labels_in(tree: Any, recording: Recording) -> Entries:
    if not isinstance(tree, dict) or tree.get("format") != FORMAT:
        raise ValueError(f'this is not a label file; label files begin with "format": "{FORMAT}"')
    if tree["version"] != VERSION:
        raise ValueError(f"the labels have version {tree['version']}, but this lineseg reads {VERSION}; update lineseg")
    about = tree["recording"]
    frames = recording.whole or len(recording)
    if about["frames"] != frames:
        raise ValueError(
            f"the labels belong to {about['name']} with {about['frames']} frames; {recording.name} has {frames}"
        )
    found: Entries = {}
    for key, entry in tree["frames"].items():
        frame = int(key)
        labels, beams = replace(said_in(entry), revision=int(entry["revision"])), int(entry["beams"])
        if recording.has(frame) or not 0 <= frame < frames:
            _check(labels, beams, recording, frame)
        found[frame] = labels, beams
    return found


def _check(labels: FrameLabels, beams: int, recording: Recording, frame: int) -> None:
    there = len(recording[recording.position(frame)])
    if recording.has(frame) and beams != there:
        raise ValueError(f"the labels of frame {frame} are for {beams} beams; the scan has {there}")
    check_labels(labels, recording, frame)


def _clean(labels: FrameLabels) -> FrameLabels:
    """The labels without halves of characters, which JSON can express and no file can hold."""
    tags = tuple(tag.encode("utf-8", "replace").decode() for tag in labels.tags)
    return replace(labels, tags=tags, note=labels.note.encode("utf-8", "replace").decode())


def said_in(entry: dict[str, Any]) -> FrameLabels:
    """The labels of a frame in JSON: lines of first, last, start and end, or null; tags; note. Never saved yet."""
    lines = entry.get("lines")
    return _clean(
        FrameLabels(
            None if lines is None else tuple(_line(line) for line in lines),
            tuple(str(tag) for tag in entry.get("tags", ())),
            str(entry.get("note", "")),
        )
    )


def _line(entry: dict[str, Any]) -> TrueLine:
    (x1, y1), (x2, y2) = entry["start"], entry["end"]
    return TrueLine(int(entry["first"]), int(entry["last"]), (float(x1), float(y1)), (float(x2), float(y2)))


def _text_of(entries: Entries, recording: Recording) -> str:
    """Readable JSON: one entry per frame, one line of text per true line."""
    about = {"name": recording.name, "frames": recording.whole or len(recording)}
    lines = ["{", f'  "format": "{FORMAT}",', f'  "version": {VERSION},', f'  "recording": {_json(about)},']
    frames = [_entry(frame, labels, beams) for frame, (labels, beams) in sorted(entries.items())]
    return "\n".join([*lines, '  "frames": {', ",\n".join(frames), "  }", "}", ""])


def _entry(frame: int, labels: FrameLabels, beams: int) -> str:
    head = {"revision": labels.revision, "beams": beams, "tags": labels.tags, "note": labels.note}
    if labels.lines is None:
        return f'    "{frame}": {_json(head)}'
    rows = [_json({"first": x.first, "last": x.last, "start": x.start, "end": x.end}) for x in labels.lines]
    listed = "[\n      " + ",\n      ".join(rows) + "\n    ]" if rows else "[]"
    return f'    "{frame}": {_json(head)[:-1]}, "lines": {listed}}}'


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
