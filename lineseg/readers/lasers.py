"""Tells apart the lasers that share a topic, by frame_id or by geometry, and keeps one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import numpy as np

from ..scan import Recording
from .account import Notes
from .reading import Reading
from .source import Source
from .tables.dialect import Dialect, Row, text_of
from .tables.headers import LASERS, LAYERS, Name, column_of

MOST_LASERS, MOST_LAYERS = 8, 128
# Scans of one laser vary in length; those of two lasers differ by more than this.
FEW_BEAMS, FEW_DEGREES = 0.2, 10.0
# A geometry with fewer scans than these is a slip, not a laser; two that change over once are one laser, set anew.
RARE, FEW_SCANS = 0.1, 3
STUMP, MANY_BEAMS, FEW_STUMPS = 0.1, 20, 0.25


def one_laser(recording: Recording, reading: Reading, notes: Notes) -> Recording:
    """The scans of one laser, without broken ones. Raises ValueError if the wanted one does not exist."""
    recording = _without_stumps(recording, notes)
    recording = _one_frame_id(recording, reading, notes)
    return _one_geometry(recording, reading, notes)


def _without_stumps(recording: Recording, notes: Notes) -> Recording:
    """Without the few scans that have next to no beams, if the others have many."""
    lengths = np.diff(recording.offsets)
    usual = int(np.sort(lengths)[len(lengths) // 2]) if len(lengths) else 0
    stumps = lengths < STUMP * usual
    if usual < MANY_BEAMS or not stumps.any() or stumps.mean() > FEW_STUMPS:
        return recording
    for frame in np.flatnonzero(stumps).tolist():
        beams = int(lengths[frame])
        notes.skip(f"scan {frame}", f"it has {beams} beam{'' if beams == 1 else 's'}, but others have {usual}")
    return _kept(recording, ~stumps, notes)


def _one_frame_id(recording: Recording, reading: Reading, notes: Notes) -> Recording:
    names = dict.fromkeys(recording.frame_ids)
    wanted = reading.frame_id
    if wanted is not None:
        need_laser(recording.name, wanted, list(names))
    if len(names) < 2:
        return recording
    ids = np.array(recording.frame_ids)
    counts = {name: int(np.count_nonzero(ids == name)) for name in names}
    taken = choose_laser(counts, "scans", recording.topic or "the file", wanted, notes)
    return _kept(recording, ids == taken, notes)


def rows_of_one_laser(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name], what: str = "beams"
) -> tuple[Iterable[Row], str]:
    """The rows of one laser and its name, if a column of a table tells it; otherwise all rows, and "".

    what: what a row has, in the plural.
    """
    column, most = column_of(names, lambda name: name.element < 0 and name.plain in LASERS), MOST_LASERS
    if column is None:
        # Beside a roll or a yaw, a pitch is that of a robot.
        layers = {*LAYERS} - ({"pitch"} if any(name.plain in ("roll", "yaw") for name in names) else set())
        column, most = column_of(names, lambda name: name.element < 0 and name.plain in layers), MOST_LAYERS
    if column is None:
        return rows, ""
    rows = list(rows)
    cells = [dialect.cells(row.text) for row in rows]
    lasers = [text_of(row[column]).strip() if len(row) > column else "" for row in cells]
    counts = Counter(filter(None, lasers))
    if not counts or len(counts) > most:
        return rows, ""
    if reading.frame_id is not None:
        need_laser(source.name, reading.frame_id, list(counts))
    if len(counts) == 1:
        return rows, next(iter(counts))
    taken = choose_laser(counts, what, "the file", reading.frame_id, source.notes)
    return [row for row, laser in zip(rows, lasers, strict=True) if laser == taken], taken


def need_laser(file: str, wanted: str, names: list[str]) -> None:
    """Raises ValueError if the file has no laser of this name."""
    if wanted not in names:
        raise ValueError(f"{file} has no frame_id {wanted!r}; it has {', '.join(map(repr, names[:MOST_LASERS]))}.")


def laser_of(source: Source, reading: Reading, counts: dict[str, int], what: str, where: str = "the file") -> str:
    """`choose_laser` as the Reading says. Raises ValueError if the wanted laser does not exist."""
    if reading.frame_id is not None:
        need_laser(source.name, reading.frame_id, list(counts))
    return choose_laser(counts, what, where, reading.frame_id, source.notes)


def choose_laser(counts: dict[str, int], what: str, where: str, wanted: str | None, notes: Notes) -> str:
    """The frame_id that is wanted, or else the first of several, which is told. counts: of scans or beams, by name."""
    taken = next(iter(counts)) if wanted is None else wanted
    notes.found["frame_id"], notes.lasers["frame_id"] = taken, tuple(counts)
    if wanted is None:
        listed = ", ".join(f"{name} ({count} {what})" for name, count in list(counts.items())[:MOST_LASERS])
        other = next(name for name in counts if name != taken)
        notes.notice(
            "several lasers",
            f"{len(counts)} lasers share {where}: {listed}. {taken} is shown; show another?",
            frame_id=other,
        )
    return taken


def _one_geometry(recording: Recording, reading: Reading, notes: Notes) -> Recording:
    """Scans of the geometry that is wanted, if two or more alternate; or of the publisher, if only these alternate."""
    kinds, what = _geometries(recording), "geometries"
    if not kinds.any() and notes.publishers is not None:
        kinds, what = _publishers(notes.publishers), "publishers"
    wanted = reading.geometry
    count = int(kinds.max(initial=0)) + 1
    if wanted is not None and wanted >= count:
        raise ValueError(f"{recording.name} has no geometry {wanted}; it has {count}, numbered from 0.")
    if count < 2:
        return recording
    notes.found["geometry"], notes.lasers["geometry"] = wanted or 0, tuple(map(str, range(count)))
    if wanted is None:
        shares = ", ".join(_described(recording, kinds == kind, kind) for kind in range(count))
        notes.notice(
            "several lasers",
            f"Scans of {count} {what} alternate: {shares}. Number 0 is shown; show another?",
            geometry=1,
        )
    return _kept(recording, kinds == (wanted or 0), notes)


def _geometries(recording: Recording) -> np.ndarray:
    """(frames,) the number of each scan's geometry, in the order of appearance; all 0 unless they alternate."""
    frames = len(recording)
    lengths = np.diff(recording.offsets)
    if frames < 2 or recording.bearings is not None or (lengths.max() == lengths.min() and _equal(recording)):
        return np.zeros(frames, np.int64)
    ends = recording.angle_min + recording.angle_increment * (lengths - 1)
    rows = np.column_stack((lengths, np.rad2deg(recording.angle_min), np.rad2deg(ends)))
    if (np.abs(rows - rows[0]) <= np.array((FEW_BEAMS * rows[0, 0], FEW_DEGREES, FEW_DEGREES))).all():
        return np.zeros(frames, np.int64)
    leaders: list[np.ndarray] = []
    kinds = np.full(frames, -1, np.int64)
    while (left := np.flatnonzero(kinds < 0)).size and len(leaders) < MOST_LASERS:
        leader = rows[left[0]]
        near = np.abs(rows[left] - leader) <= np.array((FEW_BEAMS * leader[0], FEW_DEGREES, FEW_DEGREES))
        kinds[left[near.all(axis=1)]] = len(leaders)
        leaders.append(leader)
    counts = np.bincount(kinds[kinds >= 0], minlength=len(leaders))
    steady = (kinds >= 0).all() and (counts >= max(RARE * frames, FEW_SCANS)).all()
    alternate = np.count_nonzero(np.diff(kinds)) >= counts.min()
    return kinds if steady and alternate and len(leaders) > 1 else np.zeros(frames, np.int64)


def _publishers(senders: np.ndarray) -> np.ndarray:
    """(frames,) the number of each scan's publisher, in the order of appearance; all 0 unless they alternate."""
    names = list(dict.fromkeys(senders.tolist()))
    kinds = np.array([names.index(sender) for sender in senders.tolist()])
    counts = np.bincount(kinds)
    alternate = np.count_nonzero(np.diff(kinds)) >= counts.min() >= FEW_SCANS
    return kinds if alternate else np.zeros(len(kinds), np.int64)


def _equal(recording: Recording) -> bool:
    return bool(np.ptp(recording.angle_min) < 1e-3 and np.ptp(recording.angle_increment) < 1e-6)


def _described(recording: Recording, these: np.ndarray, kind: int) -> str:
    first = int(np.flatnonzero(these)[0])
    return f"{kind}: {len(recording[first])} beams ({np.count_nonzero(these)} scans)"


def _kept(recording: Recording, these: np.ndarray, notes: Notes) -> Recording:
    frames = np.flatnonzero(these)
    if notes.recorded is not None:
        notes.recorded = notes.recorded[frames]
    if notes.publishers is not None:
        notes.publishers = notes.publishers[frames]
    return recording.only(frames)
