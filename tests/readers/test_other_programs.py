"""One room as many programs write it: each file opens as that room, or says what it is and the way on."""

from __future__ import annotations

import bz2
import gzip
import io
import json
import lzma
import tarfile

import numpy as np
import pytest

from lineseg import open_recording

DEGREES = np.arange(360.0)
BEAMS, LOW, STEP = 541, np.deg2rad(-135), np.deg2rad(0.5)
SIDES = (-2.1, 3.4, -1.6, 2.3)  # of the room, around the laser


def room(bearings):
    """Ranges in a room without furniture."""
    x, y = np.cos(bearings), np.sin(bearings)
    left, right, low, high = SIDES
    with np.errstate(divide="ignore"):
        return np.minimum(np.abs(np.where(x > 0, right, left) / x), np.abs(np.where(y > 0, high, low) / y))


TURN = room(np.deg2rad(DEGREES))
VIEW = LOW + STEP * np.arange(BEAMS)
WIDE = room(VIEW)
POINTS = np.column_stack((TURN * np.cos(np.deg2rad(DEGREES)), TURN * np.sin(np.deg2rad(DEGREES)), 0 * TURN))


def rows(form, *columns):
    return "".join(form.format(*row) + "\n" for row in zip(*columns, strict=True))


def pcd(kind):
    size = len(POINTS)
    head = "# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS x y z intensity\nSIZE 4 4 4 1\nTYPE F F F U\n"
    head += f"COUNT 1 1 1 1\nWIDTH {size}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {size}\nDATA {kind}\n"
    if kind == "ascii":
        return (head + rows("{:.5f} {:.5f} {:.5f} 9", *POINTS.T)).encode()
    table = np.zeros(size, [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("i", "u1")])
    table["x"], table["y"] = POINTS[:, 0], POINTS[:, 1]
    return head.encode() + table.tobytes()


def ply(kind):
    head = f"ply\nformat {kind} 1.0\nelement vertex {len(POINTS)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz") + "element face 0\nend_header\n"
    return head.encode() + (rows("{} {} {}", *POINTS.T).encode() if kind == "ascii" else POINTS.astype(">f4").tobytes())


def tarred(files):
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w:") as archive:
        for name, data in files.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(data)
            archive.addfile(entry, io.BytesIO(data))
    return packed.getvalue()


def arrays(**given):
    packed = io.BytesIO()
    np.savez(packed, **given)
    return packed.getvalue()


def gazebo(number):
    head = f"header {{\n  stamp {{\n    sec: {number}\n    nsec: 5\n  }}\n}}\n"
    head += f'frame: "laser"\nangle_min: {LOW}\nangle_max: {-LOW}\nangle_step: {STEP}\nrange_min: 0.1\nrange_max: 30\n'
    return head + rows("ranges: {}", WIDE) + rows("intensities: {}", WIDE)


TABLE = ("angle_deg,distance_mm\n" + rows("{:.0f},{:.0f}", DEGREES, 1000 * TURN)).encode()
LISTED = ", ".join(f"{value:.4f}" for value in WIDE)
LONG = "scan,beam,range_mm\n" + "".join(rows(f"{scan},{{}},{{:.0f}}", range(BEAMS), 1000 * WIDE) for scan in range(3))
ARDUINO = rows("angle={:.0f} dist={:.1f}cm", DEGREES, 100 * TURN)
NEATO = "GetLDSScan\r\nAngleInDegrees,DistInMM,Intensity,ErrorCodeHEX\r\n"
NEATO += rows("{:.0f},{:.0f},47,0", DEGREES, 1000 * TURN) + "ROTATION_SPEED,5.10\r\n"
NAMED = "TimeStamp;" + ";".join(f"{angle:.2f}°" for angle in np.rad2deg(VIEW)) + "\n"
NAMED += "".join(f"12:34:5{at}.100;" + ";".join(f"{1000 * r:.0f}" for r in WIDE) + "\n" for at in range(3))
OF_DAY = "".join(f"12:34:5{at}.250," + ",".join(f"{r:.4f}" for r in WIDE) + "\n" for at in range(3))
DATED = OF_DAY.replace(",", " ").replace("12:34", "2024-05-06 12:34")
KEYED = [{"time_s": at / 10, "angles_deg": np.rad2deg(VIEW).tolist(), "dist_m": WIDE.tolist()} for at in range(3)]

ROW = " ".join(f"{r:.3f}" for r in WIDE)
WORDS = ROW.split()
WRAPPED = "\n".join(" ".join(WORDS[at : at + 10]) for at in range(0, BEAMS, 10)) + "\n"
FORTRAN = rows("{} {}", *((f"{each:.5E}".replace("E", "D") for each in column) for column in (DEGREES, TURN)))
LATEX = "\\begin{tabular}{rr}\n$\\theta$ [$^\\circ$] & $r$ [m] \\\\ \\hline\n"
LATEX += rows("${:.1f}$ & ${:.3f}$ \\\\", DEGREES, TURN) + "\\hline\n\\end{tabular}\n"
SICK = "FFF92230 1388 21D " + " ".join(f"{round(1000 * r):X}" for r in WIDE)
SICK = f"1 1 89A27F 0 0 1 1 {{:X}} 6 0 0 7 0 0 1388 168 0 1 DIST1 3F800000 00000000 {SICK} 0 0 0 0 0"
SICK = f"\x02sSN LMDscandata {SICK}\x03\n"
SERIAL = "LDS ready\n" + rows("angle:{:.1f} distance(mm):{:.0f} q:9", DEGREES, 1000 * TURN)
UNITY = [{"x": -y, "y": 0.3, "z": x} for x, y in POINTS[:, :2].tolist()]
PAIRS = " ".join(f"{angle:.1f} {1000 * r:.0f}" for angle, r in zip(DEGREES, TURN, strict=True)) + "\n"
OPEN_ENDED = "[stamp],[logtime],[laser]\n" + "".join(
    f"{at}.5,2019:03:01:12:00,{ROW}\n".replace(" ", ",") for at in range(3)
)


def cloud():
    """Points of many planes, as KITTI has them."""
    return np.column_stack((POINTS[:, :2], np.linspace(-1, 2, 360), np.full(360, 0.3))).astype("<f4")


FILES = {
    "fortran.dat": (FORTRAN.encode(), 1, 360),
    "table.tex": (LATEX.encode(), 1, 360),
    "ten_a_line.txt": (WRAPPED.encode() * 3, 3, BEAMS),
    "headings.txt": ("".join(f"scan {at}\n{WRAPPED}" for at in range(3)).encode(), 3, BEAMS),
    "dashes.txt": (("".join(f"- {each}\n" for each in WORDS) + "\n").encode() * 3, 3, BEAMS),
    "array.h": (
        f"static const float ranges[{BEAMS}] = {{\n{', '.join(each + 'f' for each in WORDS)}}};\n".encode(),
        1,
        BEAMS,
    ),
    "telegrams.txt": ("".join(SICK.format(100_000 * at) for at in range(1, 4)).encode(), 3, BEAMS),
    "serial.log": (SERIAL.encode(), 1, 360),
    "monitor.log": (rows("12:00:00.100 -> {:.2f},{:.0f}", DEGREES, 1000 * TURN).encode(), 1, 360),
    "unity.json": (json.dumps({"points": UNITY}).encode(), 1, 360),
    "pairs.txt": (PAIRS.encode() * 3, 3, 360),
    "in_turn.txt": ((" ".join(f"{angle:.5f}" for angle in VIEW) + f"\n{ROW}\n").encode() * 3, 3, BEAMS),
    "labelled.txt": (f"ranges: {ROW}\n".encode() * 3, 3, BEAMS),
    "open_ended.csv": (OPEN_ENDED.encode(), 3, BEAMS),
    "remarks.csv": (rows("{:.0f}, {:.3f}  # of beam", DEGREES, TURN).encode(), 1, 360),
    "quoted.csv": (f'"{",".join(WORDS)}"\n'.encode() * 3, 3, BEAMS),
    "as_text.json": (json.dumps({"angle_min": LOW, "angle_increment": STEP, "ranges": ROW}).encode(), 1, BEAMS),
    "named.csv": (
        (",".join(f"range_at_{a:.1f}deg" for a in np.rad2deg(VIEW)) + "\n" + ",".join(WORDS) + "\n").encode(),
        1,
        BEAMS,
    ),
    "scan.csv.xz": (lzma.compress(TABLE), 1, 360),
    "run.tar.bz2": (bz2.compress(tarred({"run/scan.csv": TABLE})), 1, 360),
    "usarsim.log": (f"SEN {{Time 3.5}} {{Type RangeScanner}} {{Range {','.join(WORDS)}}}\n".encode() * 3, 3, BEAMS),
    "classic.txt": ("".join("time {\n  sec: 1\n}\nscan {\n" + gazebo(5) + "}\n" for _ in range(2)).encode(), 2, BEAMS),
    "cloud.pcd": (pcd("ascii"), 1, 360),
    "binary.pcd": (pcd("binary"), 1, 360),
    "cloud.ply": (ply("ascii"), 1, 360),
    "binary.ply": (ply("binary_big_endian"), 1, 360),
    "one.tar": (tarred({"run/README.md": b"by me", "run/scan.csv": TABLE}), 1, 360),
    "one.tgz": (gzip.compress(tarred({"run/scan.csv": TABLE})), 1, 360),
    "long.csv": (LONG.encode(), 3, BEAMS),
    "keyed.json": (json.dumps({"scans": KEYED}).encode(), 3, BEAMS),
    "arduino.log": (ARDUINO.encode(), 1, 360),
    "neato.txt": (NEATO.encode(), 1, 360),
    "angles_as_names.csv": (NAMED.encode(), 3, BEAMS),
    "time_of_day.csv": (OF_DAY.encode(), 3, BEAMS),
    "dated.txt": (DATED.encode(), 3, BEAMS),
    "gazebo.txt": ("\n".join(map(gazebo, range(3))).encode(), 3, BEAMS),
    "one.yaml": (f"angle_min: {LOW}\nangle_increment: {STEP}\nranges: [{LISTED}]\n".encode(), 1, BEAMS),
    "one.toml": (f"[scan]\nangle_min = {LOW}\nangle_increment = {STEP}\nranges = [{LISTED}]\n".encode(), 1, BEAMS),
    "inches.csv": (("angle_deg,distance_in\n" + rows("{},{}", DEGREES, TURN / 0.0254)).encode(), 1, 360),
    "odd.npz": (arrays(lidar=np.array([WIDE] * 3), theta=VIEW, t=np.arange(3) / 10), 3, BEAMS),
    "cut.npz": (arrays(angle_min=LOW, angle_increment=STEP, ranges=np.array([WIDE] * 5))[: -BEAMS * 8], 4, BEAMS),
}
TIMED = ("keyed.json", "angles_as_names.csv", "time_of_day.csv", "dated.txt", "gazebo.txt", "odd.npz", "telegrams.txt",
         "open_ended.csv", "classic.txt")  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_the_room_is_read_from_the_files_of_other_programs(tmp_path, name):
    data, scans, beams = FILES[name]
    (tmp_path / name).write_bytes(data)
    recording = open_recording(tmp_path / name)
    assert (len(recording), recording.beams) == (scans, (beams, beams))
    points = recording[0].xy
    assert [*points.min(axis=0), *points.max(axis=0)] == pytest.approx(
        [SIDES[0], SIDES[2], SIDES[1], SIDES[3]], abs=0.03
    )
    assert recording.stamps.any() == (name in TIMED)
    if "cut" in name:
        assert recording.account is not None
        assert "only 4 are there" in recording.account.notices[0].text


@pytest.mark.parametrize(
    ("name", "data", "sentence"),
    [
        (
            "a.mat",
            b"MATLAB 7.3 MAT-file, Platform: GLNXA64" + b"\0" * 90,
            r"is a MATLAB file of version 7.3; save it in MATLAB with save\('scans.mat', '-v7'\)",
        ),
        (
            "a.xlsx",
            b"PK\x03\x04" + b"\0" * 26 + b"[Content_Types].xml",
            "is a workbook or document; save its table as CSV",
        ),
        ("a.pkl", b"\x80\x04\x95", "is a Python pickle"),
        ("a.csv", b"<!doctype HTML><p>404", "is a web page, not the file behind it; download the file itself"),
        ("a.log", b"\x02\x02\x02\x02\0\0\4\x5csSN LMDscandata", "binary telegrams of a SICK laser; record the scans"),
        ("a.txt", b"FA A0 30 4A CE 07 0A 00 " * 9, "bytes in hexadecimal, as a laser sends them; record the scans"),
        ("a.e57", b"ASTM-E57" + bytes(99), "is a 3D point cloud .*cut a slice of one height out of it"),
        ("a.bin", cloud().tobytes(), "looks like a 3D point cloud in plain numbers, as that of KITTI; cut a slice"),
        (
            "a.bin",
            (1000 + np.arange(900)).astype("<u2").tobytes(),
            r"load them with numpy\.fromfile\('a\.bin', '<u2'\)",
        ),
        ("a.zip", b"PK\5\6" + bytes(18), "is an empty zip file"),
        (
            "a.yaml",
            b"angle_min: -1.5\nranges: '<array type: float32[541]>'\n---\n",
            "a.yaml:2: the ranges were not printed",
        ),
        (
            "a.csv",
            b"x,y,z\n" + b"".join(b"%f,%f,%f\n" % tuple(each[:3]) for each in cloud()),
            "but a scan lies in one plane",
        ),
        ("a.tar", tarred({"a.csv": TABLE, "b.csv": TABLE}), r"a\.tar has several files.*a\.csv, b\.csv; unpack it"),
        ("a.pcd", pcd("binary").replace(b"DATA binary", b"DATA binary_compressed"), "pcl_convert_pcd_ascii_binary"),
    ],
)
def test_a_file_of_another_kind_is_called_by_its_name_with_the_way_on(tmp_path, name, data, sentence):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(ValueError, match=sentence):
        open_recording(tmp_path / name)


def test_a_cloud_of_many_planes_is_no_scan(tmp_path):
    path = tmp_path / "room.pcd"
    path.write_bytes(pcd("ascii").replace(b" 0.00000 9", b" 1.50000 9", 180))
    with pytest.raises(ValueError, match=r"from 0 to 1\.5 m in height, but a scan lies in one plane; cut a slice"):
        open_recording(path)


def test_a_list_over_many_lines_takes_time_in_proportion_to_its_length(tmp_path):
    path = tmp_path / "open.txt"
    path.write_text("header {\n" + "value 1.5 of a list that is never closed\n" * 40_000)
    with pytest.raises(ValueError, match="no list of numbers"):
        open_recording(path)


def test_lines_that_are_no_beams_are_counted_as_lines(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("angle_deg,distance_m\n" + rows("{:.0f},{:.3f}", DEGREES, TURN) + "end of log,\n")
    account = open_recording(path).account
    assert account is not None
    assert account.skipped_text == "1 line was skipped, the first at log.csv:362: 'end of log' is not a number."


@pytest.mark.parametrize("head", ["", "stamp,mode,ranges\n", "laser 1, mode 2\nsecond line\n"])
def test_the_advice_for_rows_without_angles_can_be_followed(tmp_path, head):
    path = tmp_path / "odd.csv"
    path.write_text(head + "".join(f"{at}.5,7,{','.join(WORDS[:97])}\n" for at in range(8)))
    with pytest.raises(ValueError, match=r"without angles; give angle_increment, and angle_min .* give skip_columns"):
        open_recording(path)
    recording = open_recording(path, angle_min=LOW, angle_increment=STEP, skip_columns=2)
    assert (len(recording), recording.beams) == (8, (97, 97))
    assert recording[0].ranges == pytest.approx(WIDE[:97], abs=1e-3)
