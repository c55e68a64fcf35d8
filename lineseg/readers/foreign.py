"""Files that are no recordings of scans, or of a kind that is not read: what each is, and the way on."""

from __future__ import annotations

import re
from functools import cache
from pathlib import PurePath

import numpy as np
from numpy.typing import NDArray

ARRAYS = "numpy.savez('scans.npz', ranges=…, angle_min=-1.5708, angle_increment=0.00873)"
SAVE_AGAIN = "save it in MATLAB with save('scans.mat', '-v7'), or its matrix with writematrix(ranges, 'scans.csv')"
TO_JSON = "to_json('scans.jsonl', orient='records', lines=True)"
DRIVER = "record the scans that its driver publishes, or save them as text with angle and distance"
SLICE = "cut a slice of one height out of it, and save that as PCD or as text with x and y"
RECORD = "record the scans of the laser"
LEAST_NUMBERS = 100
# What files are by their suffix, if their first bytes say nothing.
BY_SUFFIX = {
    ".mat": ("a MATLAB file of another version", SAVE_AGAIN),
    ".rawlog": ("a rawlog of MRPT", "export its scans with rawlog-edit --export-2d-scans-txt, and open that text"),
    ".pkl": ("a Python pickle, which could run programs", f"load it yourself and save it with {ARRAYS}"),
    ".pickle": ("a Python pickle, which could run programs", f"load it yourself and save it with {ARRAYS}"),
    ".posegraph": ("a map of slam_toolbox", "open the bag that it was made of"),
}
# How each begins, what it is, and what to do.
FOREIGN = (
    (rb"MATLAB 7\.\d MAT-file", "a MATLAB file of version 7.3", SAVE_AGAIN),
    (rb"\x89HDF", "an HDF5 file", f"load it with h5py and save it with {ARRAYS}"),
    (rb"7\x7f\x06[\x82\x83]", "the log of an SQLite database that is being written",
     "open the .db3 of the same name, with this file beside it"),
    (rb"PAR1", "a Parquet table", f"save it as JSON, with pandas.read_parquet(…).{TO_JSON}"),
    (rb"ARROW1|FEA1|\xff\xff\xff\xff\x10", "an Arrow table", f"save it as JSON, with pandas.read_feather(…).{TO_JSON}"),
    (rb"\x80[\x02-\x05]|(?:\([dlt]p\d|ccopy_reg\n|c(?:numpy|__main__|builtins|collections)[\w.]*\n|[}\]]q\0|\}\x94)",
     "a Python pickle, which could run programs", f"load it yourself and save it with {ARRAYS}"),
    (rb"\xdb\x01\xf5\x5b\x7b\x1f\x1d\x7b", "a map of Cartographer (pbstream), and no recording",
     "open the bag that it was made of"),
    (rb"# Octomap OcTree", "a map of OctoMap", "open the scans that it was made of"),
    (rb"2D-Map\r?\n", "a map of ARIA or MobileEyes", "open the log of the scans that it was made of"),
    (rb"(?:#[^\n]*\n)*(?:VERTEX|EDGE)[\w:]*[ \t](?![\s\S]*(?:FLASER|ROBOTLASER|RAWLASER))",
     "a pose graph (g2o or TORO)", "open the log of the scans that it was made of"),
    (rb"(?:[^\n]{0,80}\n){0,3}\s*Columns 1 (?:through|to|and) \d+",
     "what MATLAB shows in its window, with a few columns at a time",
     "save the matrix with writematrix(ranges, 'scans.csv')"),
    (rb"\xd0\xcf\x11\xe0|PK\x03\x04[\s\S]{26,40}(?:\[Content_Types\]|mimetype)", "a workbook or document",
     "save its table as CSV"),
    (rb"\xd4\xc3\xb2\xa1|\xa1\xb2\xc3\xd4|\x4d\x3c\xb2\xa1|\x0a\x0d\x0d\x0a",
     "captured network packets", "replay them to the driver of the laser and record the scans that it publishes"),
    (rb"LASF|ASTM-E57", "a 3D point cloud (LAS or E57)", SLICE),
    (rb"RRF\d", "a rerun recording", "open it in rerun; scans cannot be read from it"),
    (rb"\x89PNG|\xff\xd8\xff|GIF8|BM....\0\0\0\0|II\*\0|MM\0\*|P[1-6]\s+(?:#|\d+\s+\d)", "a picture",
     "open the recording behind it"),
    (rb"RIFF....(?:AVI |WAVE)|....ftyp|\x1a\x45\xdf\xa3|OggS|ID3", "a video or sound",
     "open the recording of the laser"),
    (rb"solid [^\n]{0,99}\n\s*facet normal|(?:#[^\n]*\n)*(?:mtllib|o|g) [^\n]+\n(?:v |g |o |usemtl )|glTF",
     "a 3D model", "open the scans that it was made of"),
    (rb"%PDF", "a PDF document", "open the recording behind it"),
    (rb"\s{0,99}<(?:!DOCTYPE html|html|table)", "a web page, not the file behind it", "download the file itself"),
    (rb"version https://git-lfs", "a pointer of Git LFS, not the file itself", "fetch it with `git lfs pull`"),
    (rb"7z\xbc\xaf|Rar!", "packed by 7-Zip or RAR", "unpack it, and open what it holds"),
    (rb"\s{0,9}(?:path|Files): {2,}[^\n]{0,300}\n(?:[^\n]{0,300}\n){0,9}[mM]essages: +\d",
     "a bag's summary, as `rosbag info` or `ros2 bag info` prints it", "open the bag itself"),
    (rb"image: *\S+\.\w+\s+(?:mode: *\w+\s+)?resolution:", "the settings of a map of ROS",
     "open the scans that the map was made of"),
    (rb"(?:[^\n]{0,300}\n){0,9}\$(?:G[PNLABQ]|BD)[A-Z]{3},|\xb5\x62[\x01-\x30]", "a log of a GNSS receiver", RECORD),
    (rb" {5}[234]\.\d\d {11}(?:OBSERVATION|NAVIGATION|N|O)", "GNSS observations (RINEX)", RECORD),
    (rb"ULog\x01\x12\x35|\xa3\x95\x80\x80", "a flight log of PX4 or ArduPilot", RECORD),
    (rb"\s*0\s*\r?\n\s*SECTION\s", "a drawing (DXF)", "open the scans that it was made of"),
    (rb"PK\x05\x06", "an empty zip file", "open the recording itself"),
    (rb"\x54\x2c[\s\S]{45}\x54\x2c", "the raw bytes of an LDROBOT laser (LD06, LD19)", DRIVER),
    (rb"\xa5\x5a\x05\0\0\x40\x81|\xa5\x5a\x54\0\0\x40\x82", "the raw bytes of an RPLIDAR", DRIVER),
    (rb"\xaa\x55[\0\x01][\x01-\x80][\s\S]{4}", "the raw bytes of a YDLIDAR", DRIVER),
    (rb"\xfa[\xa0-\xf9][\s\S]{20}(?:[\s\S]{20})?\xfa[\xa0-\xf9]", "the raw bytes of an LDS-01 or Neato laser", DRIVER),
    (rb"\x02\x02\x02\x02\0\0", "the binary telegrams of a SICK laser", "record the scans with sick_scan_xd"),
    (rb"(?i)\s{0,9}(?=(?:[0-9a-fx]{2,4}[\s,]{1,2}){0,40}(?:0x)?(?:[a-f]\d|\d[a-f]|[a-f]{2})\s)"
     rb"(?:(?:0x)?[0-9a-f]{2}[\s,]{1,2}){16}",
     "bytes in hexadecimal, as a laser sends them", DRIVER),
    (rb"Timestamp:Step 0,", "points that UrgBenri saved", "save the log in UrgBenri as .ubh or .csv instead"),
    (rb"\s{0,9}(?:--[^\n]{0,300}\n\s{0,9}){0,9}(?:CREATE TABLE|INSERT INTO|PRAGMA |BEGIN TRANSACTION)",
     "SQL statements", "save the table as CSV"),
    (rb"(?:G[DS]|M[DS])\d{10,}", "the raw answers of a Hokuyo laser (SCIP)",
     "record the scans with urg_node, or save them as CSV from UrgBenri"),
)  # fmt: skip


def foreign(name: str, head: bytes) -> None:
    """Raises ValueError with what the file is and the way on, if it is one of these."""
    for at, begins in enumerate(_beginnings()):
        if begins.match(head):
            _, what, way = FOREIGN[at]
            raise ValueError(f"{name} is {what}; {way}.")


@cache
def _beginnings() -> list[re.Pattern[bytes]]:
    return [re.compile(begins, re.IGNORECASE if begins.startswith(rb"\s{") else 0) for begins, _, _ in FOREIGN]


def unknown(name: str, head: bytes, expected: str, formats: str) -> ValueError:
    """The error for a file that no reader recognises: what its first bytes look like, and the way on.

    expected: what a file of its suffix has, "" without one; formats: the names of all.
    """
    if (known := BY_SUFFIX.get(PurePath(name).suffix.lower())) is not None:
        return ValueError(f"{name} is {known[0]}; {known[1]}.")
    if expected:
        return ValueError(f"{name} begins with {head[:8]!r}, which is not a known format{expected}.")
    for kind, size in (("<f4", 4), ("<u2", 2)):
        numbers = np.frombuffer(head[: len(head) // 16 * 16], kind)
        if len(numbers) >= LEAST_NUMBERS and _are_points(numbers):
            return ValueError(f"{name} looks like a 3D point cloud in plain numbers, as that of KITTI; {SLICE}.")
        if len(numbers) >= LEAST_NUMBERS and _are_ranges(numbers):
            return ValueError(
                f"{name} looks like plain numbers of {size} bytes; load them with numpy.fromfile({name!r}, {kind!r}), "
                f"and save them with {ARRAYS}."
            )
    return ValueError(
        f"{name} begins with {head[:8]!r}, which is not a known format; save its scans as CSV, or with {ARRAYS}. "
        f"Known formats: {formats}."
    )


def _are_points(numbers: NDArray) -> bool:
    """Whether numbers are x, y, z [m] and the strength of points, or these and the ring."""
    if numbers.dtype.kind != "f":
        return False
    for columns in (4, 5):
        points = numbers[: len(numbers) // columns * columns].reshape(-1, columns).astype(np.float64)
        x, y, z, strength, *_ = points.T
        ahead = np.hypot(x, y)
        if (
            np.isfinite(points).all()
            and (np.abs(z) < 50).all()
            and ((strength >= 0) & (strength <= 255)).all()
            and (points[:, :2] < 0).any()
            and (ahead < 400).all()
        ):
            return bool(np.median(ahead) > 0.5)
    return False


def _are_ranges(numbers: NDArray) -> bool:
    """Whether numbers may be ranges: metres as floats, or millimetres as whole numbers, each near the next."""
    values = numbers.astype(np.float64)
    values = values[np.isfinite(values) & (values > 0)]
    if len(values) < 0.8 * len(numbers) or not (numbers[np.isfinite(numbers)] >= 0).all():
        return False
    middle = float(np.median(values))
    likely = 0.05 < middle < 200 if numbers.dtype.kind == "f" else 50 < middle < 60_000
    return likely and float(np.median(np.abs(np.diff(values)))) < 0.1 * middle
