"""Files of the kinds that people have, in other forms than the cases: read right, refused with the way on, or told.

One known scan of a room is written in each form, and what is read is compared with it point by point.
"""

import json
import struct

import numpy as np
import pytest
from bags import SCAN, STORES, encoded, message
from rosbags.rosbag1 import Writer as Writer1

from lineseg import Reading, open_recording

STEP = np.deg2rad(0.5)
BEARINGS = np.deg2rad(-135) + STEP * np.arange(541)
DEGREES = np.rad2deg(BEARINGS)
STAMPS = [1.7e9 + 0.1 * number for number in range(3)]


def room():
    """Ranges in a room of 6 m × 4 m, from beside its middle, with a pillar and three beams without return."""
    x, y = np.cos(BEARINGS), np.sin(BEARINGS)
    across = np.where(x > 0, 3.4, 2.6) / np.maximum(np.abs(x), 1e-9)
    ranges = np.minimum(across, np.where(y > 0, 2.3, 1.7) / np.maximum(np.abs(y), 1e-9))
    ranges[np.abs(BEARINGS - 0.7) < 0.08] = 1.2
    ranges[10:13] = np.nan
    return ranges


ROOM = room()


def row(missing="nan", digits=3, scale=1.0, between=","):
    return between.join(missing if np.isnan(each) else f"{each * scale:.{digits}f}" for each in ROOM)


def scan(**changes):
    """A LaserScan as an object; ... takes a field away."""
    ranges = [None if np.isnan(each) else round(float(each), 4) for each in ROOM]
    whole = {"angle_min": BEARINGS[0], "angle_max": BEARINGS[-1], "angle_increment": STEP, "ranges": ranges}
    return {name: value for name, value in (whole | changes).items() if value is not ...}


POINTS = [[float(x), float(y)] for x, y in np.column_stack((np.nan_to_num(ROOM * np.cos(BEARINGS)),
          np.nan_to_num(ROOM * np.sin(BEARINGS))))]  # fmt: skip
OBJECTS = {
    "numbers as texts": [
        {"angle": f"{angle:.1f}", "distance": f"{each:.3f}"} for angle, each in zip(DEGREES, ROOM, strict=True)
    ],
    "ranges as texts": {"angle_min": str(BEARINGS[0]), "angle_increment": str(STEP), "ranges": row().split(",")},
    "points of GeoJSON": {"features": [{"geometry": {"type": "Point", "coordinates": each}} for each in POINTS]},
}


@pytest.mark.parametrize("name", OBJECTS)
def test_json_with_texts_or_geometry_has_the_scan(tmp_path, name):
    path = tmp_path / "made.json"
    path.write_text(json.dumps(OBJECTS[name]))
    right(open_recording(path), 1)


def test_an_array_of_bytes_is_no_recording(tmp_path):
    np.save(tmp_path / "grid.npy", np.tile(np.arange(541) % 251, (200, 1)).astype(np.uint8))
    with pytest.raises(ValueError, match="one byte a value, as pictures and maps have"):
        open_recording(tmp_path / "grid.npy")


def test_quantities_with_other_rows_are_refused(tmp_path):
    path = tmp_path / "long.csv"
    path.write_text("time,field,value\n" + "".join(f"{at},angle,{at}\n{at}.5,range,2\n" for at in range(20)))
    with pytest.raises(ValueError, match="not with the same rows for each"):
        open_recording(path)


def test_columns_after_the_ranges_can_be_named(tmp_path):
    path = tmp_path / "made.txt"
    path.write_text("".join(f"7,{row()},{at}.5,{stamp}\n" for at, stamp in enumerate(STAMPS)))
    right(open_recording(path, columns="-,ranges,-,stamp"), 3, STAMPS)


def beams(line):
    return "".join(line(angle, 0.0 if np.isnan(each) else each) for angle, each in zip(DEGREES, ROOM, strict=True))


def right(recording, scans=3, stamps=None):
    """Whether it has so many scans of the room, and no point elsewhere."""
    assert len(recording) == scans, recording.account.line
    there = np.column_stack((ROOM * np.cos(BEARINGS), ROOM * np.sin(BEARINGS)))[np.isfinite(ROOM)]
    for each in recording:
        here = each.xy[each.valid]
        assert len(here) == len(there), recording.account.line
        assert np.abs(here[np.lexsort(here.round(2).T)] - there[np.lexsort(there.round(2).T)]).max() < 3.0
        near = np.abs(here[:, None] - there[None]).max(axis=2)
        assert max(near.min(axis=0).max(), near.min(axis=1).max()) < 0.02, recording.account.line
    if stamps is not None:
        assert recording.stamps.tolist() == pytest.approx(stamps, abs=1e-3)
    return True


COLUMNS = "angle_min;angle_max;angle_increment;range_min;range_max;ranges"
FIELDS = f"{BEARINGS[0]};{BEARINGS[-1]};{STEP};0.1;12"

# name, text, scans, stamps, what must be marked as a guess
FORMS = {
    "names and then angles": ("t;" + ";".join(f"{each:.2f}" for each in DEGREES) + "\n"
        + "".join(f"{stamp};{row(between=';')}\n" for stamp in STAMPS), 3, STAMPS, {"direction"}),
    "a date before the ranges": ("".join(f"2023-11-14 22:13:2{n}.500,{row()}\n" for n in range(3)),
        3, [1.7e9 + n + 0.5 for n in range(3)], {"angle_min", "stamps"}),
    "a number and a time before the ranges": (
        "".join(f"{n} {stamp} {row(between=' ')}\n" for n, stamp in enumerate(STAMPS)),
        3, STAMPS, {"skip_columns", "stamps"}),
    "one greatest value far beyond": (f"{row('99999', 0, 1000)}\n" * 3, 3, None, {"no_return", "unit"}),
    "curly brackets": (("{" + row("-1") + "}\n") * 3, 3, None, {"angle_min"}),
    "rows of MATLAB": ("scans = [" + ";\n".join([row("NaN", between=" ")] * 3) + "];\n", 3, None, {"angle_min"}),
    "a variable of Python": ("scans = [\n" + ("[" + row("float('inf')", between=", ") + "],\n") * 3 + "]\n",
        3, None, {"angle_min"}),
    "a time before a list": ("".join(f"{stamp} [{row('inf', between=', ')}]\n" for stamp in STAMPS),
        3, STAMPS, {"angle_min", "stamps"}),
    "tuples of the package rplidar": (
        beams(lambda angle, each: f"(False, 15, {-angle % 360:.4f}, {each * 1000:.2f})\n"),
        1, None, {"columns", "unit", "direction"}),
    "echoes beside each other": (
        "angle,range_1,range_2,range_3\n"
        + beams(lambda angle, each: f"{angle:.1f},{each:.3f},{each * 1.2:.3f},0\n"), 1, None, {"angle_unit"}),
    "quantities one below the other": (
        "beam,variable,value\n" + beams(lambda angle, each: f"{angle:.1f},angle,{angle:.1f}\n")
        + beams(lambda angle, each: f"{angle:.1f},distance,{each:.3f}\n"), 1, None, {"angle_unit"}),
    "beams from InfluxDB": (
        "#datatype,string,long,double,long\n,result,table,_value,beam\n"
        + "".join(f",,0,{0 if np.isnan(each) else each},{at}\n" for at, each in enumerate(ROOM)),
        1, None, {"angle_min"}),
    "units behind numbers": (
        "angle,range\n" + beams(lambda angle, each: f"{angle:.1f}°,{each:.3f} m\n"), 1, None, {"direction"}),
    "colours of a terminal": (
        beams(lambda angle, each: f"angle: \x1b[36m{angle:.1f}\x1b[0m dist: {each * 1000:.0f}\n"),
        1, None, {"angle_unit", "unit"}),
    "a word before the numbers": (f"scan7 {row(between=' ')}\n", 1, None, {"angle_min"}),
    "labels of two lasers": (f"front: {row()}\nrear: {row(scale=2)}\n" * 3, 3, None, {"angle_min"}),
    "a pose and a stamp after the ranges": (
        "".join(f"{row()},{at}.5,2.25,0.1,{stamp}\n" for at, stamp in enumerate(STAMPS)), 3, None, {"angle_min"}),
    "commas in quotes": ("angle,distance\n"
        + beams(lambda angle, each: f'"{angle:.3f}","{each:.4f}"\n'.replace(".", ",")),
        1, None, {"unit"}),
    "the first line of Excel": ("sep=;\nWinkel;Abstand\n"
        + beams(lambda angle, each: f"{angle:.3f};{each * 100:.2f}\n"),
        1, None, {"unit", "angle_unit"}),
    "secs and nsecs": ("rosbagTimestamp;stamp;secs;nsecs;" + COLUMNS + "\n"
        + "".join(f"{n};;1700000000;{n * 10**8};{FIELDS};[{row('inf')}]\n" for n in range(3)), 3, STAMPS, set()),
    "a stamp in seconds": ("/scan/header/stamp;" + COLUMNS + "\n"
        + "".join(f"{stamp};{FIELDS};\"array('f', [{row('inf')}])\"\n" for stamp in STAMPS), 3, STAMPS, set()),
    "messages as strings": ("".join(json.dumps({"msg": json.dumps(scan(stamp=stamp))}) + "\n" for stamp in STAMPS),
        3, STAMPS, set()),
    "objects one after the other": ("\n".join(json.dumps(scan(), indent=1) for _ in range(3)), 3, None, set()),
    "names in one word": ("".join(json.dumps(scan(angle_min=..., angleMin=BEARINGS[0], t=1000 * stamp)) + "\n"
        for stamp in STAMPS), 3, STAMPS, set()),
    "units in the names": (json.dumps([{"start_angle_deg": -135, "angle_step_deg": 0.5, "distances_mm":
        [0 if np.isnan(each) else each * 1000 for each in ROOM]}] * 3), 3, None, set()),
    "no angles": (json.dumps(scan(angle_min=..., angle_max=..., angle_increment=...)), 1, None, {"angle_min"}),
    "hundredths of a degree": ("angle,dist\n" + beams(lambda angle, each: f"{angle * 100:.0f},{each:.3f}\n"),
        1, None, {"angle_unit", "unit"}),
    "gon and micrometres": ("Winkel [gon];Abstand [µm]\n"
        + beams(lambda angle, each: f"{angle / 0.9:.4f};{each * 1e6:.0f}\n".replace(".", ",")), 1, None, {"direction"}),
    "parts of units": ("angle (1/64 deg)\tdist_mm_q2\n"
        + beams(lambda angle, each: f"{angle * 64:.0f}\t{each * 4000:.0f}\n"), 1, None, {"direction"}),
    "units in a second row": ("angle,range,signal\ndeg,cm,-\n"
        + beams(lambda angle, each: f"{angle:.2f},{each * 100:.1f},9\n"), 1, None, {"direction"}),
    "points between thousands": ("Winkel (°);Abstand (mm)\n"
        + beams(lambda angle, each: f"{angle:.1f};{each * 1000:,.1f}\n".translate(str.maketrans(",.", ".,"))),
        1, None, {"direction"}),
    "commas between thousands": ("angle_deg,dist_mm\n"
        + beams(lambda angle, each: f'{angle:.1f},"{each * 1000:,.0f}"\n'), 1, None, {"direction"}),
    "a scan in each column": ("angle_deg,scan_1,scan_2,scan_3\n"
        + beams(lambda angle, each: f"{angle:.1f}" + 3 * f",{each:.3f}" + "\n"), 3, None, {"unit"}),
    "columns of scans without names": (beams(lambda angle, each: 3 * f"{each:.3f} " + "\n"), 3, None, {"angle_min"}),
    "columns without names beside angles": (beams(lambda angle, each: f"{angle:.1f}" + 3 * f"\t{each:.3f}" + "\n"),
        3, None, {"angle_unit"}),
    "rows that the header does not count": ("  angle  range\n"
        + "".join(f"{at}  {angle:.5f}  {'NaN' if np.isnan(each) else round(each, 4)}\n"
                  for at, (angle, each) in enumerate(zip(BEARINGS, ROOM, strict=True))), 1, None, {"unit"}),
    "angles from north beside points": ("azimuth,distance_m,x,y\n"
        + beams(lambda angle, each: f"{100 * (90 - angle):.0f},{each:.3f},{each * np.cos(np.deg2rad(angle)):.4f},"
                                    f"{each * np.sin(np.deg2rad(angle)):.4f}\n"), 1, None, set()),
    "days since 1900": ("time," + ",".join(f"range_{beam}" for beam in range(541)) + "\n"
        + "".join(f"{stamp / 86_400 + 25_569:.10f},{row()}\n" for stamp in STAMPS), 3, STAMPS, {"angle_min"}),
    "an array as an object": (json.dumps(scan(ranges={str(at): each for at, each in enumerate(scan()["ranges"])})),
        1, None, set()),
    "names beside rows": (json.dumps({"columns": ["angle", "range"], "data": list(zip(BEARINGS, scan()["ranges"],
        strict=True))}), 1, None, {"unit"}),
    "the stamp beside the scan": ("".join(json.dumps({"t": stamp, "data": scan()}) + "\n" for stamp in STAMPS),
        3, STAMPS, set()),
    "a line of words above lists": ("INFO: started\n" + f"[{row('inf')}]\n" * 3, 3, None, {"angle_min"}),
    "variables of MATLAB": ("% room\nangles = (-135:0.5:135)*pi/180;\nranges = [" + ";\n".join(
        [row("NaN", between=" ").replace(" ", " ...\n", 1)] * 3) + "];\n", 3, None, {"unit"}),
    "a start and a step in MATLAB": ("angle_min = -3*pi/4;\nangle_increment = deg2rad(0.5);\nrange_max = 12;\n"
        + f"scan.ranges_mm = [{row('0', scale=1000)}]';\n", 1, None, set()),
    "variables of Octave": ("# Created by Octave 8.4.0\n# name: theta\n# type: matrix\n# rows: 541\n"
        + "".join(f" {angle:.6f}\n" for angle in BEARINGS) + "\n# name: rho\n# type: matrix\n# rows: 541\n"
        + row("NA", between="\n") + "\n", 1, None, {"angle_unit", "unit"}),
    "XML": ("<?xml version='1.0'?>\n<data>" + beams(lambda angle, each:
        f"<row><angle_deg>{angle:.1f}</angle_deg><distance_mm>{each * 1000:.0f}</distance_mm></row>\n") + "</data>",
        1, None, {"direction"}),
    "attributes of XML": ("<scan>"
        + beams(lambda angle, each: f'<p angle="{angle:.1f}" range="{each:.3f}"/>') + "</scan>",
        1, None, {"direction", "unit"}),
    "messages printed by Python": ("".join(
        f"[INFO] [9.1]: sensor_msgs.msg.LaserScan(header=std_msgs.msg.Header(stamp=builtin_interfaces.msg.Time("
        f"sec={int(stamp)}, nanosec={round(stamp % 1 * 1e9)}), frame_id='laser'), angle_min={BEARINGS[0]}, "
        f"angle_increment={STEP}, range_min=0.1, ranges=array('f', [{row('inf', between=', ')}]), intensities=[])\n"
        for stamp in STAMPS), 3, STAMPS, set()),
    "UrgBenri": ("[appName]\nUrgBenri\n[startStep]\n0\n[frontStep]\n270\n[totalSteps]\n720\n[minDistance]\n23\n"
        + "".join(f"[timestamp]\n{100 * n}\n[logtime]\n2024-05-20 10:13:20.250\n[scan]\n"
                  + ";".join("1|0" if np.isnan(each) else f"{each * 1000:.0f}|812&9000|5" for each in ROOM) + "\n"
                  for n in range(3)), 3, [0, 0.1, 0.2], set()),
    "points": (json.dumps({"points": [[float(r * np.cos(a)), float(r * np.sin(a))]
        for a, r in zip(BEARINGS, ROOM, strict=True) if r > 0]}), 1, None, {"columns"}),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_other_forms_of_a_table_are_read_right_and_guesses_are_marked(tmp_path, form):
    text, scans, stamps, guessed = FORMS[form]
    for encoding in ("utf-8", "utf-16-le"):  # the second without a mark
        path = tmp_path / f"{encoding}.txt"
        path.write_text(text, encoding=encoding)
        recording = open_recording(path)
        assert right(recording, scans, stamps)
        assert guessed <= {guess.field for guess in recording.account.guesses}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (f"100,0,laser,{FIELDS.replace(';', ',')},{row('inf')[:900]},'...'\n", "left out"),
        ("a;ranges\n" + f"1;[{row()[:50]} ... {row()[-50:]}]\n" * 2, "left out"),
        (f"{','.join(row().split(',')[:97])}\n" * 3, "rows of 97 numbers without angles; give angle_increment"),
        ("[" + json.dumps(scan())[:-40], "not JSON; is it complete"),
        ("  angle  range\n0  -2.3  2.4\n1  -2.2  2.4\n..  ...  ...\n", "left out"),
        ("$GPGGA,101320.00,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\n", "a log of a GNSS receiver"),
        ("path:        a.bag\nversion:     2.0\nmessages:    830\n", "a bag's summary.*open the bag itself"),
        ("<?xml version='1.0'?>\n<robot name='r'><link name='base'/></robot>\n", "XML of <robot> without scans"),
        ("<?xml version='1.0'?>\n<data><row><angle>0.1", "damaged XML"),
        ("[appName]\nUrgBenri\n[timestamp]\n1\n[scan]\n1;2;3\n", "does not say .*totalSteps.*; give angle_min"),
        ("t,x,y,qx,qy,qz,qw\n" + "".join(f"{n},{n},0,0,0,0,1\n" for n in range(9)), "has poses, not scans"),
        ("".join(f"{n} {n} 0 0 0 0 0 1\n" for n in range(20)), "has poses, not scans.*as its trajectory"),
        ("1716200000.250\n181, 0", "2 rows of one number; is the file complete"),
        ("CREATE TABLE scan (angle real, dist real);\n", "SQL statements; save the table as CSV"),
    ],
)
def test_what_cannot_be_read_is_refused_with_the_way_on(tmp_path, text, sentence):
    path = tmp_path / "made.txt"
    path.write_text(text)
    with pytest.raises(ValueError, match=sentence) as raised:
        open_recording(path)
    assert "made.txt" in str(raised.value)


def test_what_a_power_failure_leaves_at_the_end_is_passed_over(tmp_path):
    path = tmp_path / "cut.csv"
    path.write_bytes(f"{row()}\n".encode() * 3 + b"\0" * 4096)
    assert right(open_recording(path))


def test_numbers_below_two_centimetres_are_told_as_codes(tmp_path):
    path = tmp_path / "urg.csv"
    path.write_text(f"{row('7', 0, 1000)}\n" * 3)
    recording = open_recording(path)
    (notice,) = recording.account.notices
    assert (notice.change, len(recording[0].xy[recording[0].valid])) == ({"range_min": 0.02}, 541)
    assert right(open_recording(path, Reading(**notice.change)))


def test_an_acceleration_beside_an_angle_and_a_distance_is_no_point(tmp_path):
    path = tmp_path / "imu.csv"
    path.write_text(
        "angle_deg,distance_m,ax_x,ax_y\n" + beams(lambda angle, each: f"{angle:.1f},{each:.3f},0.01,0.02\n")
    )
    assert right(open_recording(path), scans=1)


def test_a_list_of_scans_that_breaks_off_is_read_up_to_there(tmp_path):
    path = tmp_path / "cut.json"
    path.write_text(json.dumps([scan()] * 4)[:-100])
    recording = open_recording(path)
    assert right(recording)
    assert [notice.kind for notice in recording.account.notices] == ["breaks off"]


def test_an_echo_that_breaks_off_in_its_ranges_gives_no_scan_of_half_a_room(tmp_path):
    told = (
        f"header:\n  stamp:\n    sec: 1\nangle_min: {BEARINGS[0]}\nangle_max: {BEARINGS[-1]}\nangle_increment: {STEP}\n"
    )
    whole = told + "ranges:\n" + "".join(f"- {each:.4f}\n" for each in ROOM)
    path = tmp_path / "scan.yaml"
    path.write_text("---\n".join([whole] * 4)[:-1500])
    recording = open_recording(path)
    assert right(recording)
    assert recording.account.skips == 1


# What a LaserScan may get wrong, and the change that mends it.
WRONG = {
    "centimetres": ({"ranges": 100 * ROOM, "limits": (10, 3000)}, {"unit": "cm"}),
    "millimetres between limits in metres": ({"ranges": 1000 * ROOM}, {"unit": "mm"}),
    "only the step in degrees": ({"increment": 0.5}, {"angle_increment": round(STEP, 8)}),
    "limits the wrong way round": ({"limits": (30.0, 0.1)}, {"range_min": 0.1, "range_max": 30.0}),
}


@pytest.mark.parametrize("fault", WRONG)
def test_what_contradicts_itself_in_a_message_is_told_once_and_the_advice_mends_it(tmp_path, fault):
    fields, change = WRONG[fault]
    usual = {"ranges": ROOM, "angle_min": BEARINGS[0], "angle_max": BEARINGS[-1], "increment": STEP}
    with Writer1(tmp_path / "run.bag") as bag:
        topic = bag.add_connection("/scan", SCAN, typestore=STORES[1])
        for number in range(3):
            bag.write(topic, 10**9 * number, encoded(1, message(1, stamp=float(1 + number), **usual | fields)))
    (notice,) = open_recording(tmp_path / "run.bag").account.notices
    assert notice.change == change
    assert right(open_recording(tmp_path / "run.bag", Reading(**change)))


def test_two_publishers_that_alternate_on_a_topic_are_two_lasers(tmp_path):
    path = tmp_path / "both.bag"
    with Writer1(path) as bag:
        senders = [bag.add_connection("/scan", SCAN, typestore=STORES[1], callerid=f"/{name}") for name in "ab"]
        for number in range(8):
            ranges = np.full(100, 2.0 + number % 2)
            bag.write(senders[number % 2], 10**9 * number, encoded(1, message(1, ranges, stamp=1.0 + number)))
    recording = open_recording(path)
    (notice,) = (each for each in recording.account.notices if each.kind == "several lasers")
    assert (len(recording), set(recording.ranges.tolist()), notice.change) == (4, {2.0}, {"geometry": 1})
    assert set(open_recording(path, geometry=1).ranges.tolist()) == {3.0}


def test_types_are_known_by_the_names_of_dds_and_a_schema_that_has_ranges(tmp_path):
    def text(value):
        return struct.pack("<I", len(value)) + value

    def record(code, body):
        return struct.pack("<BQ", code, len(body)) + body

    cdr = encoded(2, message(2, ROOM, angle_min=BEARINGS[0], increment=STEP))
    for encoding, type, schema, data in (
        (b"cdr", b"sensor_msgs::msg::dds_::LaserScan_", b"", cdr),
        (b"json", b"Sweep", b'{"properties": {"ranges": {}}}', json.dumps(scan()).encode()),
    ):  # fmt: skip
        path = tmp_path / f"{encoding.decode()}.mcap"
        path.write_bytes(
            b"\x89MCAP0\r\n" + record(1, text(b"") + text(b""))
            + record(3, struct.pack("<H", 1) + text(type) + text(b"") + text(schema))
            + record(4, struct.pack("<HH", 1, 1) + text(b"rt/scan") + text(encoding) + struct.pack("<I", 0))
            + record(5, struct.pack("<HIQQ", 1, 0, 1, 1) + data)
        )  # fmt: skip
        assert right(open_recording(path), scans=1)
