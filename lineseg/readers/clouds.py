"""Point clouds of one scan: PCD, as the Point Cloud Library writes it, and PLY.

Formats: https://pointclouds.org/documentation/tutorials/pcd_file_format.html, https://paulbourke.net/dataformats/ply/.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scan import Recording
from .source import Reader, Source
from .tables.beam_rows import beams_of, check_flat
from .tables.headers import Name
from .tables.turns import turns

MOST_HEADER = 1 << 14
PCD_KINDS = {"F": "f", "I": "i", "U": "u"}
PLY_KINDS = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}  # fmt: skip
# A scan in order of its beams has few turns; points in another order seem to have many.
FEWEST_IN_TURN = 20


class Layout(NamedTuple):
    """kind: of a point, with its named fields; size: number of points; plain: whether they are text; start: of them."""

    kind: np.dtype
    size: int
    plain: bool
    start: int


class PointCloud(Reader):
    """Points with x and y, in metres, in the frame of the laser."""

    format = "point cloud"
    suffixes = (".pcd", ".ply")
    expects = "a header that names x and y, and the points of one scan"

    @staticmethod
    def recognises(head: bytes) -> bool:
        pcd = re.search(rb"^(?:#[^\n]*\n)?\s*VERSION [\d.]+\s+(?:FIELDS|COLUMNS) ", head[:400])
        return pcd is not None or re.match(rb"ply\r?\n\s*format ", head) is not None

    @staticmethod
    def read(source: Source) -> Recording:
        data = source.path.read_bytes()
        source.notes.kind = "PLY" if data.startswith(b"ply") else "PCD"
        layout = _ply(source, data) if source.notes.kind == "PLY" else _pcd(source, data)
        points = _points(source, data, layout)
        if not {"x", "y"} <= set(points):
            raise ValueError(f"{source.name} has points with {', '.join(points)}; a scan has x and y.")
        table = np.column_stack((points["x"], points["y"]))
        whole = np.isfinite(table).all(axis=1) & table.any(axis=1)
        if "z" in points:
            check_flat(source.name, points["z"][whole], unit=" m")
        table = table[whole]
        if not len(table):
            raise ValueError(f"{source.name} has no point with finite x and y.")
        bearings = np.arctan2(table[:, 1], table[:, 0])
        if len(turns(bearings)) - 1 > max(1, len(table) // FEWEST_IN_TURN):
            source.notes.notice("order", "The points were not in the order of beams and were sorted by their bearing.")
            table = table[np.argsort(bearings, kind="stable")]
        source.notes.found["unit"] = "m"
        return beams_of(source, source.reading, table, [Name("x"), Name("y")], format=PointCloud.format)


def _pcd(source: Source, data: bytes) -> Layout:
    header = re.match(rb"(?s)(.*?^\s*DATA (\w+)[ \t]*\r?\n)", data[:MOST_HEADER], re.MULTILINE)
    if header is None:
        raise ValueError(f"{source.name}: a PCD file without its line DATA; is it complete?")
    lines = [line.split() for line in header[1].decode("ascii", "replace").splitlines()]
    said = {words[0].upper(): words[1:] for words in lines if words}
    form = header[2].decode().lower()
    if form not in ("ascii", "binary"):
        raise ValueError(
            f"{source.name}: its points are {form}; `pcl_convert_pcd_ascii_binary {source.name} plain.pcd 0` makes "
            "them text."
        )
    names = said.get("FIELDS") or said.get("COLUMNS", [])
    sizes, kinds = said.get("SIZE", ["4"] * len(names)), said.get("TYPE", ["F"] * len(names))
    counts = said.get("COUNT", ["1"] * len(names))
    if not len(names) == len(sizes) == len(kinds) == len(counts):
        raise ValueError(f"{source.name}: FIELDS, SIZE, TYPE and COUNT of a PCD file name different numbers of fields.")
    fields = [
        (f"{name}{at}" if name == "_" else name, f"<{PCD_KINDS[kind]}{size}", (int(count),))
        for at, (name, size, kind, count) in enumerate(zip(names, sizes, kinds, counts, strict=True))
    ]
    width, height = (int(said.get(name, ["1"])[0]) for name in ("WIDTH", "HEIGHT"))
    points = int(said.get("POINTS", [str(width * height)])[0])
    return Layout(np.dtype(fields), points, form == "ascii", header.end())


def _ply(source: Source, data: bytes) -> Layout:
    end = re.search(rb"end_header\r?\n", data[:MOST_HEADER])
    form = re.search(rb"format (ascii|binary_little_endian|binary_big_endian) ", data[:MOST_HEADER])
    vertex = re.search(rb"element vertex (\d+)((?:\s+(?:comment[^\n]*|property \w+ \w+))*)", data[:MOST_HEADER])
    if end is None or form is None or vertex is None:
        raise ValueError(f"{source.name}: a PLY file without end_header, format or element vertex; is it complete?")
    order = ">" if form[1] == b"binary_big_endian" else "<"
    found = re.findall(rb"property (\w+) (\w+)", vertex[2])
    fields = [(name.decode(), order + PLY_KINDS[kind.decode()], (1,)) for kind, name in found]
    return Layout(np.dtype(fields), int(vertex[1]), form[1] == b"ascii", end.end())


def _points(source: Source, data: bytes, layout: Layout) -> dict[str, NDArray]:
    """(points,) each field of one value; fewer points than announced if the file breaks off."""
    names = layout.kind.names or ()
    widths = [int(np.prod(layout.kind[name].shape)) for name in names]
    if layout.plain:
        rows = [line.split() for line in data[layout.start :].splitlines()[: layout.size]]
        rows = [row for row in rows if len(row) == sum(widths)]
        table = np.array(rows, dtype=np.float64).reshape(-1, sum(widths))
        starts = np.cumsum([0, *widths[:-1]])
        found = {name: table[:, start] for name, start, width in zip(names, starts, widths, strict=True) if width == 1}
    else:
        count = min(layout.size, (len(data) - layout.start) // max(layout.kind.itemsize, 1))
        table = np.frombuffer(data, layout.kind, count, layout.start)
        found = {
            name: table[name][:, 0].astype(np.float64) for name, width in zip(names, widths, strict=True) if width == 1
        }
    if len(table) < layout.size:
        text = f"The file announces {layout.size} points, but only {len(table)} are there."
        source.notes.notice("breaks off", text)
    return found
