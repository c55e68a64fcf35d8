"""Files that are no recordings of scans, or of a kind that is not read: what each is, and the way on."""

from __future__ import annotations

import re

ARRAYS = "numpy.savez('scans.npz', ranges=…, angle_min=-1.5708, angle_increment=0.00873)"
DRIVER = "record the scans that its driver publishes, or save them as text with angle and distance"
RECORD = "record the scans of the laser"
# How each begins, what it is, and what to do.
FOREIGN = (
    (rb"MATLAB [57]\.\d MAT-file", "a MATLAB file", f"load it with scipy.io.loadmat and save it with {ARRAYS}"),
    (rb"\x89HDF", "an HDF5 file, as MATLAB 7.3 also writes", f"load it with h5py and save it with {ARRAYS}"),
    (rb"PAR1", "a Parquet table", "save it as CSV, with pandas.read_parquet(…).to_csv('scans.csv')"),
    (rb"ARROW1|FEA1|\xff\xff\xff\xff\x10", "an Arrow table", "save it as CSV"),
    (rb"\x80[\x02-\x05]", "a Python pickle, which could run programs", f"load it yourself and save it with {ARRAYS}"),
    (rb"\xd0\xcf\x11\xe0|PK\x03\x04[\s\S]{26,40}(?:\[Content_Types\]|mimetype)", "a workbook or document",
     "save its table as CSV"),
    (rb"\xd4\xc3\xb2\xa1|\xa1\xb2\xc3\xd4|\x4d\x3c\xb2\xa1|\x0a\x0d\x0d\x0a",
     "captured network packets", "replay them to the driver of the laser and record the scans that it publishes"),
    (rb"LASF", "a LAS point cloud", "save a slice of it as PCD or as text with x and y"),
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
    (rb"7z\xbc\xaf|Rar!|\xfd7zXZ\0|BZh", "packed by 7-Zip, RAR, xz or bzip2", "unpack it, and open what it holds"),
    (rb"\s{0,9}(?:path|Files): {2,}[^\n]{0,300}\n(?:[^\n]{0,300}\n){0,9}[mM]essages: +\d",
     "a bag's summary, as `rosbag info` or `ros2 bag info` prints it", "open the bag itself"),
    (rb"image: *\S+\.\w+\s+(?:mode: *\w+\s+)?resolution:", "the settings of a map of ROS",
     "open the scans that the map was made of"),
    (rb"(?:[^\n]{0,300}\n){0,9}\$(?:G[PNLABQ]|BD)[A-Z]{3},|\xb5\x62[\x01-\x30]", "a log of a GNSS receiver", RECORD),
    (rb" {5}[234]\.\d\d {11}(?:OBSERVATION|NAVIGATION|N|O)", "GNSS observations (RINEX)", RECORD),
    (rb"ULog\x01\x12\x35|\xa3\x95\x80\x80", "a flight log of PX4 or ArduPilot", RECORD),
    (rb"\x54\x2c[\s\S]{45}\x54\x2c", "the raw bytes of an LDROBOT laser (LD06, LD19)", DRIVER),
    (rb"\xa5\x5a\x05\0\0\x40\x81|\xa5\x5a\x54\0\0\x40\x82", "the raw bytes of an RPLIDAR", DRIVER),
    (rb"\xaa\x55[\0\x01][\x01-\x80][\s\S]{4}", "the raw bytes of a YDLIDAR", DRIVER),
    (rb"Timestamp:Step 0,", "points that UrgBenri saved", "save the log in UrgBenri as .ubh or .csv instead"),
    (rb"\s{0,9}(?:--[^\n]{0,300}\n\s{0,9}){0,9}(?:CREATE TABLE|INSERT INTO|PRAGMA |BEGIN TRANSACTION)",
     "SQL statements", "save the table as CSV"),
    (rb"\x02?s[RS][AN] LMDscandata", "telegrams of a SICK laser, in hexadecimal numbers",
     "record the scans with sick_scan_xd, or export them as CSV from SOPAS"),
    (rb"(?:G[DS]|M[DS])\d{10,}", "the raw answers of a Hokuyo laser (SCIP)",
     "record the scans with urg_node, or save them as CSV from UrgBenri"),
)  # fmt: skip


def foreign(name: str, head: bytes) -> None:
    """Raises ValueError with what the file is and the way on, if it is one of these."""
    for begins, what, way in FOREIGN:
        if re.match(begins, head, re.IGNORECASE if begins.startswith(rb"\s{") else 0):
            raise ValueError(f"{name} is {what}; {way}.")
