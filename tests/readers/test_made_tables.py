"""Tables made from one known scan, in many forms: read right, or refused, or what is wrong is marked as a guess."""

import os

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st

from lineseg import Reading, Scan, open_recording

METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001}
HEADERS = {
    "angle": {
        "rad": ("angle", "angle_rad", "Angle [rad]", "theta (rad)"),
        "deg": ("Angle (deg)", "angle_deg", "bearing [°]", "angle"),
    },
    "distance": {
        "m": ("distance", "distance_m", "Range (m)"),
        "cm": ("distance", "Distance [cm]", "dist (cm)"),
        "mm": ("distance", "distance_mm", "Distance (mm)"),
    },
}
EXAMPLES = int(os.environ.get("LINESEG_TABLES", 3 * settings.default.max_examples // 2))


def room(view, step, start):
    """A scan of a room of 6 m × 4 m, from beside its middle, with a few beams without return."""
    bearings = np.deg2rad(start + step * np.arange(round(view / step) + (view < 360)))
    x, y = np.cos(bearings), np.sin(bearings)
    ahead = np.where(x > 0, 3.4, 2.6) / np.maximum(np.abs(x), 1e-9)
    ranges = np.minimum(ahead, np.where(y > 0, 2.3, 1.7) / np.maximum(np.abs(y), 1e-9))
    ranges = ranges + np.random.default_rng(0).normal(0, 0.003, len(ranges))
    ranges[10:13] = 0.0
    return Scan(ranges, bearings)


@st.composite
def tables(draw):
    """(text, the scan, the form) of a table."""
    view, step = draw(st.sampled_from([(180, 1.0), (180, 0.5), (270, 0.5), (240, 1.0), (360, 1.0)]))
    form = {
        "shape": draw(st.sampled_from(["columns", "rows", "points"])),
        "unit": draw(st.sampled_from(["m", "cm", "mm"])),
        "turn": draw(st.sampled_from(["rad", "deg"])),
        "clockwise": draw(st.booleans()),
        "falling": draw(st.booleans()),
        "header": draw(st.booleans()),
        "swapped": draw(st.booleans()),
        "others": draw(st.booleans()),
        "decimals": draw(st.integers(1, 4)),
        "scans": draw(st.integers(1, 3)),
        "stamps": draw(st.booleans()),
    }
    separator, sign = draw(
        st.sampled_from([(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", "."), (" ", ",")])
    )
    start = draw(st.sampled_from([0, -180, 10, 352])) if view == 360 else -view / 2
    scan = room(view, step, start)
    lines = {"columns": _columns, "rows": _rows, "points": _points}[form["shape"]](draw, scan, form)
    text = "\n".join(
        separator.join(cell.replace(".", sign) if sign == "," and _is_number(cell) else cell for cell in line)
        for line in lines
    )
    return text + "\n", scan, form | {"separator": separator, "sign": sign, "view": view, "start": start}


def _is_number(cell):
    return cell.replace(".", "").replace("-", "").isdigit()


def _length(metres, form):
    number = metres / METRES[form["unit"]]
    return f"{number:.{max(form['decimals'], 3) if form['unit'] == 'm' else form['decimals'] - 1}f}"


def _angle(radians, form):
    angle = -radians if form["clockwise"] else radians
    return f"{np.rad2deg(angle):.3f}" if form["turn"] == "deg" else f"{angle:.6f}"


def _beams(scan, form):
    order = range(len(scan))
    return reversed(order) if form["falling"] else order


def _columns(draw, scan, form):
    names = [
        draw(st.sampled_from(HEADERS["angle"][form["turn"]])),
        draw(st.sampled_from(HEADERS["distance"][form["unit"]])),
    ]
    rows = [[_angle(scan.bearings[beam], form), _length(scan.ranges[beam], form)] for beam in _beams(scan, form)]
    rows = [row for _ in range(form["scans"]) for row in rows]
    if form["others"]:
        names, rows = [*names, "quality"], [[*row, str(40 + at % 7)] for at, row in enumerate(rows)]
    if form["swapped"]:
        names, rows = names[::-1], [row[::-1] for row in rows]
    return [names, *rows] if form["header"] else rows


def _points(draw, scan, form):
    side = -1 if form["clockwise"] else 1
    scale = 1 / METRES[form["unit"]]
    xy = (scan.ranges * np.array((np.cos(scan.bearings), side * np.sin(scan.bearings)))).T * scale
    digits = 4 if form["unit"] == "m" else 2
    rows = [
        [f"{xy[beam, 0]:.{digits}f}", f"{xy[beam, 1]:.{digits}f}"]
        for beam in _beams(scan, form)
        if scan.ranges[beam] > 0
    ]
    form["clockwise"] = False if side == 1 else form["clockwise"]
    return [["x", "y"], *rows] if form["header"] else rows


def _rows(draw, scan, form):
    order = list(_beams(scan, form))
    row = [_length(scan.ranges[beam], form) for beam in order]
    rows = [[f"{1.7e9 + 0.1 * number:.3f}", *row] if form["stamps"] else row for number in range(form["scans"])]
    if not form["header"]:
        return rows
    return [[*(["time"] if form["stamps"] else []), *(f"ranges_{beam}" for beam in range(len(row)))], *rows]


def wrong(found, scan):
    """What a scan that was read differs in: "" if nothing but where beams begin, or that some have no return."""
    there, here = scan.xy[scan.valid], found.xy[found.valid]
    if len(here) != len(there):
        return f"{len(here)} instead of {len(there)} returns"
    order = [points[np.lexsort(np.round(points, 1).T)] for points in (there, here)]
    distance = (
        np.abs(there[:, None] - here[None]).max(axis=2).min(axis=1).max()
        if len(there) < 800
        else np.abs(order[0] - order[1]).max()
    )
    return f"points {distance:.2f} m away" if distance > 0.08 else ""


@given(tables())
@settings(max_examples=EXAMPLES)
def test_a_table_is_read_right_or_refused_or_its_guesses_are_marked(tmp_path_factory, made):
    text, scan, form = made
    path = tmp_path_factory.mktemp("table") / "made.csv"
    path.write_text(text, encoding="utf-8")
    try:
        recording = open_recording(path)
    except ValueError as error:
        assert "made.csv" in str(error)
        event("refused")
        return
    guesses = {guess.field for guess in recording.account.guesses}
    assert len(recording) == (1 if form["shape"] == "points" else form["scans"]) or guesses & {"columns"}, form
    fault = wrong(recording[0], scan)
    event("wrong, and marked" if fault else "right, some of it guessed" if guesses else "right")
    assert not fault or guesses, (fault, form, recording.account.line)
    if fault:
        mended = told(form, scan)
        assert not wrong(open_recording(path, mended)[0], scan), (fault, form, mended)


def told(form, scan):
    """The Reading that a person who knows the table would give."""
    given = {"unit": form["unit"], "direction": "clockwise" if form["clockwise"] else "counter-clockwise"}
    if form["shape"] == "points":
        return Reading(unit=form["unit"], columns="x,y", direction=given["direction"])
    if form["shape"] == "columns":
        words = ["angle", "distance", *(["-"] if form["others"] else [])]
        return Reading(**given, angle_unit=form["turn"], columns=",".join(words[::-1] if form["swapped"] else words))
    step = float(np.median(np.diff(scan.bearings)))
    low, step = (scan.bearings[-1], -step) if form["falling"] else (scan.bearings[0], step)
    leading = {} if form["header"] else {"columns": "stamp,ranges" if form["stamps"] else "ranges"}
    return Reading(unit=form["unit"], angle_min=float(low), angle_increment=step, **leading)


def test_the_same_scan_in_plain_form_is_read_right(tmp_path):
    scan = room(270, 0.5, -135)
    path = tmp_path / "plain.csv"
    path.write_text(
        "angle_rad,distance_m\n"
        + "".join(f"{b:.6f},{r:.4f}\n" for b, r in zip(scan.bearings, scan.ranges, strict=True))
    )
    found = open_recording(path)[0]
    assert wrong(found, scan) == ""
    assert found.bearings == pytest.approx(scan.bearings, abs=1e-5)
