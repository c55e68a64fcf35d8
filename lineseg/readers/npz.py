"""NPZ, the exchange format: named arrays, read without pickle."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_recording
from ..failing import reason
from ..poses import PoseSource, Track
from ..scan import Recording, Topic
from ..unfinished import temporary_folder, whole_file
from .arrays import header_of, is_exchange, loaded, recording_of_arrays
from .containers.bounded import Budget, TooLargeError
from .containers.cut_zip import unpack_cut
from .source import Reader, Source

ENTRY = ".npy"
SHAPES = "ranges (frames, beams) or (beams,), angle_min and angle_increment scalars or (frames,)"

LONGEST_SOURCE = 2000
# What a scan without beams takes.
SCAN_BYTES = 64
# Fields of view [rad] that a laser has, and that none has.
NARROW_VIEW, LEAST_VIEW, MOST_VIEW = np.deg2rad((10.0, 60.0, 365.0))


class Npz(Reader):
    """ranges (F, N) or (N,) [m], angle_min, angle_increment [rad] scalars or (F,); optional range_min, range_max [m],
    stamps (F,) [s], frame_id, wall (F, N) int (−1 none, −2 unknown), walls (W, 4), time_increment [s] scalar or (F,).
    poses (F, 3) of x, y [m] and heading [rad] of the laser in the world, NaN where unknown; upside_down, if it is
    mounted so. wall_source: what is said of walls that many views agree on.

    For scans of different length: beams (F,) int, the number of beams in each row. For unevenly spaced beams: bearings
    (F, N) [rad] instead of angle_min and angle_increment.
    """

    format = "NPZ"
    suffixes = (".npz",)
    expects = "a zip archive of arrays, as numpy.savez writes it"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith(b"PK\x03\x04")

    @staticmethod
    def read(source: Source) -> Recording:
        return Npz.read_from(source.path, source)

    @staticmethod
    def read_from(file: Path | BinaryIO, source: Source) -> Recording:
        """Read `file`, which is the file of `source` or an entry in it."""
        source.progress(0, 1)
        arrays = _load(file, source)
        if not is_exchange(arrays):
            return recording_of_arrays(source, arrays, Npz.format)
        recording = recording_of_exchange(source, arrays, Npz.format)
        source.progress(1, 1)
        return recording


def recording_of_exchange(source: Source, arrays: dict[str, NDArray], format: str) -> Recording:
    """The scans of arrays with the names of the exchange format. Raises ValueError if they do not fit together."""
    try:
        recording = _recording(source, _upright(source, arrays))
    except (TypeError, ValueError) as error:
        raise ValueError(f"{source.name}: {error}") from None
    source.choose(list(recording.topics), "array")
    return replace(recording, format=format)


def _upright(source: Source, arrays: dict[str, NDArray]) -> dict[str, NDArray]:
    """The arrays with a scan in each row; turned if only columns fit their angles."""
    ranges, step = arrays.get("ranges"), arrays.get("angle_increment")
    if ranges is None or step is None or ranges.ndim != 2 or step.size != 1 or "wall" in arrays:
        return arrays
    rows, columns = (abs(float(step.ravel()[0])) * (beams - 1) for beams in ranges.shape)
    if not (LEAST_VIEW <= rows <= MOST_VIEW and not NARROW_VIEW <= columns <= MOST_VIEW):
        return arrays
    source.notes.notice("columns", f"Each of {ranges.shape[1]} columns was read as a scan; a row has too few or too "
                        "many beams for its angles.")  # fmt: skip
    return {**arrays, "ranges": ranges.T}


def save_npz(recording: Recording, target: str | Path | BinaryIO) -> None:
    """Write `recording` such that `open_recording` restores it; shorter scans are padded with NaN."""
    need_recording(recording)
    lengths = np.diff(recording.offsets)
    shape = (len(recording), int(lengths.max(initial=0)))
    inside = np.arange(shape[1]) < lengths[:, None]

    def rows(flat: NDArray, fill: float) -> NDArray:
        padded = np.full(shape, fill, flat.dtype)
        padded[inside] = flat
        return padded

    arrays: dict[str, Any] = {name: getattr(recording, name) for name in ("angle_min", "angle_increment", "stamps")}
    arrays |= {name: getattr(recording, name) for name in ("range_min", "range_max")}
    arrays["ranges"] = rows(recording.ranges, np.nan)
    arrays["frame_id"] = np.array(_unless_equal(recording.frame_ids), dtype=np.str_)
    if not inside.all():
        arrays["beams"] = lengths
    if recording.bearings is not None:
        arrays["bearings"] = rows(recording.bearings, np.nan)
    if recording.wall is not None:
        arrays["wall"] = rows(recording.wall, -1)
    if recording.wall_source:
        arrays["wall_source"] = np.array(recording.wall_source)
    tables = ("poses", "walls", "time_increment")
    arrays |= {name: array for name in tables if (array := getattr(recording, name)) is not None}
    if "poses" in arrays and recording.pose_source.upside_down:
        arrays["upside_down"] = np.array(True)
    if not isinstance(target, str | Path):
        np.savez_compressed(target, allow_pickle=False, **arrays)
        return
    # A recording may be written over the one that it was read from.
    with whole_file(Path(target)) as unfinished, unfinished.open("wb") as file:
        np.savez_compressed(file, allow_pickle=False, **arrays)


def _unless_equal(names: tuple[str, ...]) -> str | tuple[str, ...]:
    return names if len(set(names)) > 1 else next(iter(names), "")


def _load(file: Path | BinaryIO, source: Source) -> dict[str, NDArray]:
    try:
        with zipfile.ZipFile(file) as archive:
            entries = [each for each in archive.infolist() if each.filename.endswith(ENTRY)]
        packed = sum(each.compress_size for each in entries)
        Budget(source.name, packed).spend(sum(each.file_size for each in entries))
        with np.load(file, allow_pickle=False) as archive:
            names = [each.filename.removesuffix(ENTRY) for each in entries]
            arrays = {name: _array(archive, name) for name in names}
        Budget(source.name, packed).spend(sum(map(_size_as_scans, arrays.values())))
        return arrays
    except TooLargeError:
        raise
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError) as error:
        if isinstance(file, Path) and (arrays := _of_cut(file, source)):
            return arrays
        raise ValueError(f"{source.name}: a damaged NPZ file ({reason(error)}); save it again.") from None
    except (ValueError, NotImplementedError) as error:
        raise ValueError(f"{source.name}: {error}.") from None


def _size_as_scans(array: NDArray) -> int:
    """The bytes of an array whose numbers become floats, and whose rows become scans."""
    return max(8, array.itemsize) * array.size + (SCAN_BYTES * len(array) if array.ndim > 1 else 0)


def _of_cut(path: Path, source: Source) -> dict[str, NDArray]:
    """The arrays of a file that breaks off, as far as they are there; {} if there are none."""
    arrays: dict[str, NDArray] = {}
    with temporary_folder() as folder:
        for part in unpack_cut(path, folder, source.name):
            name = part.name.removesuffix(ENTRY)
            try:
                arrays[name] = np.array(loaded(part.file, source.notes))
            except (ValueError, OSError, EOFError, MemoryError):
                continue
            announced, rows = header_of(part.file)[0][0][:1], arrays[name].shape[:1]
            if announced != rows:
                # What belongs to scans that are missing.
                arrays = {each: array[: rows[0]] if array.shape[:1] == announced else array
                          for each, array in arrays.items()}  # fmt: skip
    if arrays and not any(notice.kind == "breaks off" for notice in source.notes.notices):
        text = f"The file breaks off after {', '.join(arrays)}; other arrays may be missing."
        source.notes.notice("breaks off", text)
    return arrays


def _array(archive: Mapping[str, NDArray], name: str) -> NDArray:
    try:
        return np.asarray(archive[name])
    except MemoryError:
        raise ValueError(f"{name!r} states a shape that does not fit in memory; save the file again") from None
    except ValueError as error:
        why = "has Python objects, which are not loaded; save plain numbers" if "pickle" in str(error) else str(error)
        raise ValueError(f"{name!r} {why}") from None


def _recording(source: Source, arrays: dict[str, NDArray]) -> Recording:
    has = f"it has {', '.join(sorted(arrays)) or 'nothing'}"
    if "angle_increment" not in arrays and {"ranges", "angle_min", "angle_max"} <= arrays.keys():
        steps = max(np.atleast_2d(arrays["ranges"]).shape[-1] - 1, 1)
        step = (_numbers(arrays, "angle_max", np.float64) - _numbers(arrays, "angle_min", np.float64)) / steps
        arrays["angle_increment"] = np.asarray(step)
    for name in ("ranges",) if "bearings" in arrays else ("ranges", "angle_min", "angle_increment"):
        if name not in arrays:
            raise ValueError(f"there is no array {name!r}; {has}. Required: {SHAPES}.")
    ranges = np.atleast_2d(_numbers(arrays, "ranges", np.float32))
    if ranges.ndim != 2:
        raise ValueError(f"ranges has the shape {arrays['ranges'].shape}; required: {SHAPES}.")
    frames, beams = ranges.shape
    lengths = _per_frame(arrays, "beams", frames, beams).astype(np.int64)
    if ((lengths < 0) | (lengths > beams)).any():
        raise ValueError(f"beams has the value {lengths.max()}; a row of ranges has only {beams}.")
    # None if every row is full, as nearly always: a mask would copy all.
    inside = None if (lengths == beams).all() else np.arange(beams) < lengths[:, None]
    topic = Topic("ranges", frames)
    return Recording(
        name=source.name,
        ranges=_flat(ranges, inside),
        offsets=np.concatenate(([0], np.cumsum(lengths))),
        angle_min=_per_frame(arrays, "angle_min", frames, 0.0),
        angle_increment=_per_frame(arrays, "angle_increment", frames, 0.0),
        range_min=_per_frame(arrays, "range_min", frames, 0.0),
        range_max=_per_frame(arrays, "range_max", frames, np.inf),
        stamps=_per_frame(arrays, "stamps", frames, 0.0),
        frame_ids=_frame_ids(arrays, frames),
        bearings=_rows(arrays, "bearings", ranges.shape, inside, np.float64),
        wall=_rows(arrays, "wall", ranges.shape, inside, np.int64),
        track=_track(arrays, frames),
        walls=_table(arrays, "walls", 4, None),
        wall_source=_wall_source(arrays),
        time_increment=_per_frame(arrays, "time_increment", frames, 0.0) if "time_increment" in arrays else None,
        topic=topic.name,
        topics=(topic,),
        format=Npz.format,
    )


def _track(arrays: dict[str, NDArray], frames: int) -> Track | None:
    poses = _table(arrays, "poses", 3, frames)
    if poses is None:
        return None
    poses = np.where(np.isfinite(poses).all(axis=1, keepdims=True), poses, np.nan)
    nan = np.isnan(poses).any(axis=1)
    missing = f"{'all' if nan.all() else 'the others'} are NaN in the file" if nan.any() else ""
    upside_down = bool(np.any(arrays.get("upside_down", False)))
    return Track.of(poses, PoseSource("the array poses", upside_down=upside_down, missing=missing))


def _wall_source(arrays: dict[str, NDArray]) -> str:
    text = arrays.get("wall_source", np.array(""))
    return str(text)[:LONGEST_SOURCE] if text.shape == () and text.dtype.kind == "U" else ""


def _frame_ids(arrays: dict[str, NDArray], frames: int) -> tuple[str, ...]:
    """One name for all scans, or one each."""
    names = arrays.get("frame_id", np.array(""))
    if names.shape not in ((), (1,), (frames,)):
        raise ValueError(f"frame_id has the shape {names.shape}; it needs one name, or one for each of {frames} scans.")
    return tuple(map(str, np.broadcast_to(names, frames)))


def _numbers(arrays: dict[str, NDArray], name: str, least: type) -> NDArray:
    """The array converted to floats if necessary; float32 stays float32."""
    array = arrays[name]
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name} has the type {array.dtype}; it must contain numbers.")
    return array if array.dtype in (np.float32, np.float64) else array.astype(np.result_type(array, least))


def _per_frame(arrays: dict[str, NDArray], name: str, frames: int, default: float) -> NDArray[np.float64]:
    if name not in arrays:
        return np.full(frames, default, dtype=np.float64)
    array = _numbers(arrays, name, np.float64).astype(np.float64)
    if array.shape not in ((), (1,), (frames,)):
        raise ValueError(f"{name} has the shape {array.shape}; it needs one value, or one for each of {frames} scans.")
    if name.startswith("angle") and not np.isfinite(array).all():
        raise ValueError(f"{name} has a value that is not finite; give finite angles in radians.")
    return np.broadcast_to(array, frames).copy()


def _rows(arrays: dict[str, NDArray], name: str, shape: tuple, inside: NDArray | None, kind: type) -> NDArray | None:
    if name not in arrays:
        return None
    array = _numbers(arrays, name, np.float64)
    if np.atleast_2d(arrays[name]).shape != shape:
        raise ValueError(f"{name} has the shape {arrays[name].shape}; it needs the shape of ranges, {shape}.")
    return _flat(np.atleast_2d(array), inside).astype(kind)


def _flat(rows: NDArray, inside: NDArray | None) -> NDArray:
    return rows.reshape(-1) if inside is None else rows[inside]


def _table(arrays: dict[str, NDArray], name: str, columns: int, rows: int | None) -> NDArray | None:
    if name not in arrays:
        return None
    table = _numbers(arrays, name, np.float64)
    if table.ndim != 2 or table.shape[1] != columns or rows not in (None, len(table)):
        wanted = f"({'any' if rows is None else rows}, {columns})"
        raise ValueError(f"{name} has the shape {table.shape}; it needs {wanted}.")
    return table
