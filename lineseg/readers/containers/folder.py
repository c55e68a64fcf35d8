"""Finds the one recording in a folder, and the folder of a bag's metadata.yaml."""

from __future__ import annotations

import re
from itertools import islice
from pathlib import Path

from ..source import known_suffixes
from .wrapping import BAG_PARTS, MOST_NAMED

METADATA = "metadata.yaml"
MOST_ENTRIES = 10_000
# Suffixes of recordings that other files have too.
OF_ANYTHING = (".txt", ".csv", ".log", ".yaml", ".yml", ".json", ".xml", ".dat", ".m")
LISTED = re.compile(r"^\s*-\s+(\S+\.(?:db3|mcap)(?:\.zstd)?)\s*$", re.MULTILINE)


def bag_of_metadata(path: Path) -> Path:
    """The folder that a `metadata.yaml` describes; any other path unchanged.

    Raises ValueError if its files are gone.
    """
    if path.name != METADATA or not path.is_file():
        return path
    named = listed_in(path)
    if any((path.parent / name).exists() for name in named):
        return path.parent
    files = ", ".join(named[:MOST_NAMED]) or "no file"
    raise ValueError(f"{path.name} describes a ROS 2 bag of {files}, which is not beside it; open the bag's folder.")


def listed_in(metadata: Path) -> list[str]:
    """The storage files that a `metadata.yaml` names, in order."""
    with metadata.open(encoding="utf-8", errors="replace") as file:
        return list(dict.fromkeys(Path(name).name for name in LISTED.findall(file.read(1 << 20))))


def storage_files(folder: Path) -> list[Path]:
    """The storage files of a bag in its folder, in the order of recording: bag_2 comes before bag_10.

    Raises ValueError if the folder holds those of several bags.
    """
    files = [path for path in _entries(folder) if path.name.endswith(BAG_PARTS) and path.is_file()]
    named = listed_in(folder / METADATA) if (folder / METADATA).is_file() else []
    # A file may have been compressed, or unpacked, after the metadata were written.
    bare = {name.removesuffix(".zstd") for name in named}
    files = [path for path in files if path.name.removesuffix(".zstd") in bare] or files
    stems = {re.sub(r"_\d+$", "", path.name.split(".")[0]): path for path in files}
    if len(stems) > 1 and not named:
        raise ValueError(f"{folder.name} holds several bags: {_listed(list(stems.values()))}; open one of them.")
    return sorted(files, key=lambda path: [int(part) if part.isdecimal() else part for part in _parts(path.name)])


def missing_parts(folder: Path, files: list[Path]) -> list[str]:
    """The storage files that a bag's metadata name beside these; none if it names none of these, which were renamed."""
    named = listed_in(folder / METADATA) if (folder / METADATA).is_file() else []
    there = {path.name.removesuffix(".zstd") for path in files}
    missing = [name for name in named if name.removesuffix(".zstd") not in there]
    return missing if len(missing) < len(named) else []


def recording_in(folder: Path) -> Path:
    """The folder itself if it is a bag, else the one recording in it.

    Raises ValueError if there are none or several.
    """
    if storage_files(folder):
        return folder
    bag_of_metadata(folder / METADATA)
    suffixes = known_suffixes()
    bags = [path for path in _entries(folder) if path.is_dir() and storage_files(path)]
    files = [path for path in _entries(folder) if path.is_file() and path.suffix.lower() in suffixes]
    # Notes and settings often lie beside the one recording.
    certain = [path for path in files if path.suffix.lower() not in OF_ANYTHING]
    found = bags or (certain if len(certain) == 1 else files)
    if len(found) == 1:
        return found[0]
    if found:
        what = "bags" if bags else "recordings"
        raise ValueError(f"{folder.name} holds several {what}: {_listed(found)}; open one of them.")
    raise ValueError(
        f"{folder.name} is a folder without a ROS 2 recording, which has .db3 or .mcap files. "
        "Open other recordings one file at a time."
    )


def _entries(folder: Path) -> list[Path]:
    return sorted(path for path in islice(folder.iterdir(), MOST_ENTRIES) if not path.name.startswith("."))


def _listed(paths: list[Path]) -> str:
    more = f" and {len(paths) - MOST_NAMED} more" if len(paths) > MOST_NAMED else ""
    return ", ".join(path.name for path in paths[:MOST_NAMED]) + more


def _parts(name: str) -> list[str]:
    return re.split(r"(\d+)", name)
