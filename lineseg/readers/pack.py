"""Reads failure packs: a zip with one frame as NPZ and the results for it."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..failing import reason
from ..scan import PackAbout, Recording
from .npz import Npz
from .source import Reader, Source

FORMAT, VERSION = "lineseg failure pack", 1
ABOUT, FRAME = "lineseg.json", "frame.npz"
MOST_BYTES = 1 << 28
LAST_FRAME = 2**31
# Offset of the name in the local header of a zip's first entry.
NAME_AT = 30


class FailurePack(Reader):
    """lineseg.json first, with the description, and frame.npz; see `lineseg.writers.pack`."""

    format = "failure pack"
    suffixes = (".zip",)
    expects = f"{ABOUT} as its first entry and {FRAME}"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith(b"PK\x03\x04") and head[NAME_AT:].startswith(ABOUT.encode())

    @staticmethod
    def read(source: Source) -> Recording:
        about = read_pack(source.path)
        content = io.BytesIO(_entry(source.path, FRAME))
        recording = Npz.read_from(content, source)
        # Its frame keeps the number that it has in the recording it was taken from.
        numbers = about.frame + np.arange(len(recording))
        return replace(recording, format=FailurePack.format, pack=about, numbers=numbers)


def read_pack(path: str | Path) -> PackAbout:
    """The description in a pack; `open_recording` reads its frame. Raises ValueError if it is not a pack."""
    about = _about(Path(path))
    return PackAbout(**{name: about[name] for name in PackAbout.__dataclass_fields__ if name in about})


def _about(path: Path) -> dict[str, Any]:
    """lineseg.json of a pack. Raises ValueError, with one sentence, if it is not a pack or of a newer version."""
    try:
        about = _whole(json.loads(_entry(path, ABOUT)))
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise ValueError(f"{path.name}: a damaged failure pack; its {ABOUT} is no JSON ({reason(error)}).") from None
    except ValueError as error:
        raise ValueError(f"{path.name}: a damaged failure pack ({reason(error)}).") from None
    if not isinstance(about, dict) or about.get("format") != FORMAT:
        raise ValueError(f"{path.name} is not a failure pack.")
    if about.get("version") != VERSION:
        raise ValueError(
            f"{path.name}: a failure pack of version {about.get('version')}, but this lineseg reads {VERSION}; update "
            "it."
        )
    wanted = {"recording": str, "frame": int, "method": str, "params": dict, "note": str}
    for name, kind in wanted.items():
        if not isinstance(about.get(name), kind):
            raise ValueError(
                f"{path.name}: {name} in {ABOUT} is {about.get(name)!r}; it must have the type {kind.__name__}."
            )
    if not 0 <= about["frame"] <= LAST_FRAME:
        frame = str(about["frame"])
        raise ValueError(f"{path.name}: frame in {ABOUT} is {frame[:60]}; frames count from 0 to {LAST_FRAME}.")
    if not isinstance(about.get("labels"), dict | None):
        raise ValueError(f"{path.name}: labels in {ABOUT} is {about['labels']!r}; it must have the type dict.")
    return about


def _whole(said: Any) -> Any:
    """The same with ? for each half of a character, which JSON can express and no page can be told."""
    return json.loads(json.dumps(said, ensure_ascii=False).encode("utf-8", "replace"))


def _entry(path: Path, name: str) -> bytes:
    """An entry of the zip, up to a size limit."""
    try:
        with zipfile.ZipFile(path) as pack, pack.open(name) as entry:
            content = entry.read(MOST_BYTES + 1)
    except (zipfile.BadZipFile, KeyError, EOFError, NotImplementedError, zlib.error) as error:
        raise ValueError(f"{name} cannot be taken from the zip: {reason(error).strip(chr(39))}") from None
    if len(content) > MOST_BYTES:
        raise ValueError(f"{name} has more than {MOST_BYTES >> 20} MB unpacked")
    return content
