"""Arrays of numpy that are not in the exchange format: one array, or arrays with other names."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..scan import Recording
from .account import Notes
from .guessing import angle_unit_of
from .reading import RADIANS, around_ranges, columns_of
from .source import Reader, Source
from .stamping import in_seconds
from .tables.beam_rows import LEAST_REGULAR, beams_of, words_of
from .tables.headers import LENGTHS, STAMPS, TURNS, Name, geometry_in, is_angle, is_distance, name_of
from .tables.scan_columns import alike, with_angles
from .tables.scan_rows import scans_of
from .tables.turns import regularity

ANGLE_NAMES = ("ang", "bearing", "theta", "azimuth", "phi")
STAMP_NAMES = ("stamp", "time")
# What an array of scans is called if another stands beside it.
SCAN_NAMES = ("scan", "scans", "laser", "lasers", "lidar", "data")
MOST_COLUMNS = 8
# How many numbers a beam may have in an array of its own.
OF_BEAM, LEAST_BEAMS = (2, 3, 4), 10
# Angles without a name are as even as this.
EVEN = 0.01


class Npy(Reader):
    """One array: a scan a row, or a beam a row."""

    format = "NPY"
    suffixes = (".npy",)
    expects = "an array, as numpy.save writes it"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith(b"\x93NUMPY")

    @staticmethod
    def read(source: Source) -> Recording:
        source.progress(0, 1)
        try:
            array = loaded(source.path, source.notes)
        except (ValueError, OSError, EOFError, MemoryError) as error:
            pickled = "pickle" in str(error) or "Python objects" in str(error)
            why = "Python objects, which are not loaded; save plain numbers" if pickled else str(error).rstrip(".")
            raise ValueError(f"{source.name}: a damaged NPY file, or one with more than numbers ({why}).") from None
        if array.dtype.names:
            arrays = {name: np.asarray(array[name]) for name in array.dtype.names}
            return recording_of_arrays(source, arrays, Npy.format)
        return recording_of_arrays(source, {"array": np.asarray(array)}, Npy.format)


def loaded(path: Path, notes: Notes) -> NDArray:
    """The array; without its last rows if the file breaks off in them."""
    (shape, fortran, kind), start = header_of(path)
    left = path.stat().st_size - start
    row = kind.itemsize * int(np.prod(shape[1:], dtype=np.int64))
    if kind.hasobject or fortran or not shape or not row or left // row >= shape[0] or left < row:
        # Not mapped into memory: a file that another program makes shorter would end this process.
        return np.load(path, allow_pickle=False)
    rows = left // row
    notes.notice("breaks off", f"The array announces {shape[0]} rows, but only {rows} are there.")
    with path.open("rb") as file:
        file.seek(start)
        return np.fromfile(file, kind, rows * (row // kind.itemsize)).reshape(rows, *shape[1:])


def header_of(path: Path) -> tuple[tuple[tuple[int, ...], bool, np.dtype], int]:
    """(shape, whether columns come first, type) of an array in a file, and where its values begin."""
    with path.open("rb") as file:
        major = np.lib.format.read_magic(file)[0]
        header = np.lib.format.read_array_header_1_0 if major == 1 else np.lib.format.read_array_header_2_0
        return header(file), file.tell()


def is_exchange(arrays: Mapping[str, NDArray]) -> bool:
    """Whether arrays are meant as the exchange format, so that its reader says what is missing."""
    known = {"ranges", "angle_min", "angle_increment", "bearings"} & arrays.keys()
    usable = any(_plain(array) or _pairs(array) is not None for array in arrays.values())
    return ("ranges" in arrays and len(known) > 1) or not usable


def _plain(array: NDArray) -> bool:
    return array.dtype.kind in "fiu" and 1 <= array.ndim <= 2 and array.size > 2


def _pairs(array: NDArray) -> NDArray | None:
    """(scans, beams, 2 to 4): complex numbers as x and y, or an array that has a few numbers of each beam already; None
    for others."""
    if array.dtype.kind == "c" and 1 <= array.ndim <= 2 and array.size > 2:
        return np.atleast_3d(np.stack([np.atleast_2d(np.real(array)), np.atleast_2d(np.imag(array))], axis=-1))
    if array.dtype.kind not in "fiu" or array.ndim != 3 or array.size < 6:
        return None
    if array.shape[2] in OF_BEAM and array.shape[1] > 1:
        return array
    return array.swapaxes(1, 2) if array.shape[1] in OF_BEAM and array.shape[2] > 1 else None


def _joined(arrays: Mapping[str, NDArray]) -> NDArray | None:
    """(scans, beams, 2 to 4): arrays that have a scan each, with a few numbers of each beam; None for others."""
    shapes = {array.shape for array in arrays.values() if array.dtype.kind in "fiu"}
    (shape,) = shapes if len(shapes) == 1 else ((),)
    if len(arrays) < 2 or len(shape) != 2 or shape[1] not in OF_BEAM or shape[0] < LEAST_BEAMS:
        return None
    numbers = {name: [int(each) for each in re.findall(r"\d+", name)] for name in arrays}
    if not all(numbers.values()):
        return None
    # The tenth comes after the ninth.
    return np.stack([arrays[name] for name in sorted(arrays, key=numbers.__getitem__)])


def _of_pairs(source: Source, pairs: NDArray, are_points: bool, format: str) -> Recording:
    """The scans of (scans, beams, 2 to 4): of x and y, or of what the first of them looks like."""
    scans, beams, numbers = pairs.shape
    table = pairs.reshape(-1, numbers).astype(np.float64)
    numbered = np.column_stack([np.repeat(np.arange(scans), beams), table])
    given = None if source.reading.columns is None else columns_of(source.reading.columns)
    if given is not None and (len(given) != numbers or "ranges" in given):
        such = ",".join(["x", "y", "-", "-"][:numbers])
        raise ValueError(f"{source.name} has {numbers} numbers for each beam; columns must name them, such as {such}.")
    words = given or (("x", "y") if are_points else words_of(source, table[:beams]))
    names = [Name("scan"), *map(Name, words)]
    return beams_of(source, source.reading, numbered, names, format=format)


def _of_two(source: Source, pair: list[tuple[Name, NDArray]], format: str) -> Recording:
    """The scans of two arrays (scans, beams): angles and distances, or x and y."""
    words = ("angle", "distance") if is_angle(pair[0][0]) else ("x", "y")
    columns = [array.ravel().astype(np.float64) * name.scale for name, array in pair]
    scans = np.repeat(np.arange(len(pair[0][1]), dtype=np.float64), pair[0][1].shape[1])
    names = [Name("scan"), *(Name(word, name.unit) for word, (name, _) in zip(words, pair, strict=True))]
    return beams_of(source, source.reading, np.column_stack([scans, *columns]), names, format=format)


def recording_of_arrays(source: Source, arrays: Mapping[str, NDArray], format: str) -> Recording:
    """The scans of arrays of which one can be the ranges. Raises ValueError with the line of Python that helps."""
    said = geometry_in((name, array.item()) for name, array in arrays.items() if array.size == 1)
    said = {name: value for name, value in said.items() if getattr(source.reading, name) is None}
    source = replace(source, reading=source.reading.but(**said))
    found = {name: pairs for name, array in arrays.items() if (pairs := _pairs(array)) is not None}
    if len(found) == 1 and all(array.ndim < 2 for name, array in arrays.items() if name not in found):
        ((name, pairs),) = found.items()
        recording = _of_pairs(source, pairs, arrays[name].dtype.kind == "c" or "point" in name.lower(), format)
        return _with_stamps(source, recording, arrays)
    if (joined := _joined(arrays)) is not None:
        return _of_pairs(source, joined, False, format)
    tables = {name: array for name, array in arrays.items() if _plain(array) and array.ndim == 2}
    if (pair := _beam_columns(tables)) and len(tables[pair[0]]) > 1:
        return _of_two(source, [(name_of(name), tables[name]) for name in pair], format)
    rows = {name: array for name, array in arrays.items() if _plain(array) and array.ndim == 1}
    plain = {name: name_of(name) for name in rows}
    turning = [name for name in rows if name.lower().startswith(ANGLE_NAMES) or is_angle(plain[name])]
    angles = next(iter(turning), None)
    stamps = next((name for name in rows if name.lower().startswith(STAMP_NAMES) or plain[name].plain in STAMPS), None)
    named = {name: array for name, array in rows.items() if name not in (angles, stamps)}
    if len(tables) > 1:
        likely = [name for name in tables if is_distance(name_of(name)) or name_of(name).plain in SCAN_NAMES]
        chosen = ["ranges"] if "ranges" in tables else likely
        tables = {name: tables[name] for name in chosen} if len(chosen) == 1 else tables
    if (beams := _beam_columns(rows)) and not tables:
        names = [name_of(name) for name in beams]
        table = np.column_stack([rows[name].astype(np.float64) for name in beams])
        return beams_of(source, source.reading, table, names, format=format)
    found = tables or named
    if len(found) != 1:
        raise ValueError(_which(source, arrays, f"{len(found)} of them may be the ranges"))
    ((name, array),) = found.items()
    if array.dtype.itemsize == 1 and array.ndim == 2 and min(array.shape) > MOST_COLUMNS and not source.reading.columns:
        raise ValueError(
            f"{source.name} has {name} {array.shape} of one byte a value, as pictures and maps have, not ranges; open "
            "the scans themselves. If these are ranges after all, say so with --columns ranges."
        )
    said = name_of(name)
    array = array.astype(np.float64) * said.scale
    if unit := LENGTHS.get(said.unit):
        source.notes.found["unit"] = unit
    else:
        source.notes.unstated.add("unit")
    angles = next((each for each in turning if len(rows[each]) == array.shape[-1]), angles)
    if angles is not None and array.ndim == 2 and array.shape[1] != len(rows[angles]) == array.shape[0]:
        # Angles that do not go around evenly are the robot's, one for each scan.
        array, angles = (array.T, angles) if _unevenness(rows[angles]) < LEAST_REGULAR else (array, None)
    if angles is not None and (turn := TURNS.get(name_of(angles).unit)):
        source.notes.found["angle_unit"] = turn
    if angles is None and array.ndim == 2:
        angles = next((each for each in named if _may_be_angles(rows[each], array)), None)
    if angles is not None and len(rows[angles]) != array.shape[-1]:
        raise ValueError(_which(source, arrays, f"{angles} has {len(rows[angles])} values, but a row of {name} "
                                f"{array.shape[-1]}"))  # fmt: skip
    if angles is not None:
        times = None if stamps is None else rows[stamps]
        return with_angles(source, np.atleast_2d(array), rows[angles].astype(np.float64), times, format)
    return _guessed(source, name, array, arrays, format)


def _may_be_angles(row: NDArray, ranges: NDArray[np.float64]) -> bool:
    """Whether numbers rise, or fall, evenly, one for each beam, while the ranges do not."""
    if len(row) != ranges.shape[-1] or len(row) < LEAST_BEAMS or ranges.shape[0] == len(row):
        return False
    return _unevenness(row) < EVEN <= regularity(ranges[0])


def _unevenness(row: NDArray) -> float:
    """How unequal the steps of angles are, in the unit that they seem to have; see `regularity`."""
    values = row.astype(np.float64)
    return regularity(values * RADIANS[angle_unit_of(values)])


def _with_stamps(source: Source, recording: Recording, arrays: Mapping[str, NDArray]) -> Recording:
    """The recording with the stamps of the array that is called so, if it has one for each scan."""
    name = next(
        (name for name in arrays if name.lower().startswith(STAMP_NAMES) or name_of(name).plain in STAMPS), None
    )
    if name is None or arrays[name].shape != (len(recording),) or arrays[name].dtype.kind not in "fiu":
        return recording
    source.notes.stamps = "their array"
    return replace(recording, stamps=in_seconds(arrays[name].astype(np.float64))[0])


def _beam_columns(rows: Mapping[str, NDArray]) -> list[str]:
    """The names of two arrays that are an angle and a distance, or x and y, of each beam; [] without them."""
    names = {name: name_of(name) for name in rows}
    points = [next((name for name in rows if names[name].plain.split("_")[-1] in (axis, f"{axis}s")), "")
              for axis in "xy"]  # fmt: skip
    angle = next((name for name in rows if is_angle(names[name])), "")
    distance = next((name for name in rows if is_distance(names[name])), "")
    pairs = ([angle, distance], points)
    return next((pair for pair in pairs if all(pair) and rows[pair[0]].shape == rows[pair[1]].shape), [])


def _guessed(
    source: Source, name: str, array: NDArray[np.float64], arrays: Mapping[str, NDArray], format: str
) -> Recording:
    reading = source.reading
    given = None if reading.columns is None else columns_of(reading.columns)
    beams = given is not None and "ranges" not in given
    narrow = array.ndim == 2 and 2 <= array.shape[1] <= MOST_COLUMNS < array.shape[0]
    if (narrow and not alike(array)) or beams:
        names = [Name(word) for word in given] if beams and given else None
        return beams_of(source, reading, np.atleast_2d(array), names, format=format)
    values = list(np.atleast_2d(array))
    try:
        leading, trailing = around_ranges(given) if given else (None, ())
        return scans_of(source, reading, list(range(len(values))), values, 0, leading, format, trailing)
    except ValueError as error:
        if "without angles" not in str(error):
            raise
        raise ValueError(
            _which(source, arrays, f"{name} has rows of {array.shape[-1]} ranges without angles")
        ) from None


def _which(source: Source, arrays: Mapping[str, NDArray], why: str) -> str:
    has = ", ".join(f"{name} {array.shape}" for name, array in sorted(arrays.items())[:8]) or "nothing"
    return (
        f"{source.name} has {has}; {why}. Save it so that each is named: "
        "numpy.savez('scans.npz', ranges=…, angle_min=-1.5708, angle_increment=0.00873), "
        "ranges (frames, beams) in metres and angles in radians."
    )
