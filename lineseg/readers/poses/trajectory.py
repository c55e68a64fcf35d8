"""Trajectories beside a recording: TUM (`stamp x y z qx qy qz qw`) and tables with named columns."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from ...poses import Found, PoseSource
from .moving import Array, Motion, Rigid

MOST_LINES = 20_000_000
# Names of columns as letters alone: p_RS_R_x of EuRoC is prsrx; field.pose.pose.position.x of ROS 1 ends in positionx.
NAMES = {
    "stamp": ("stamp", "timestamp", "time", "t", "times", "sec", "secs", "seconds", "ns", "timestampns", "rostime"),
    "x": ("x", "tx", "px", "posx", "positionx", "prsrx", "translationx"),
    "y": ("y", "ty", "py", "posy", "positiony", "prsry", "translationy"),
    "z": ("z", "tz", "pz", "posz", "positionz", "prsrz", "translationz"),
    "heading": ("theta", "yaw", "heading", "yawrad", "thetarad", "headingrad"),
    "heading_deg": ("yawdeg", "thetadeg", "headingdeg"),
    "qx": ("qx", "orientationx", "quatx", "qrsx", "rotationx"),
    "qy": ("qy", "orientationy", "quaty", "qrsy", "rotationy"),
    "qz": ("qz", "orientationz", "quatz", "qrsz", "rotationz"),
    "qw": ("qw", "orientationw", "quatw", "qrsw", "rotationw"),
}
# Columns of tables without names, by their number.
BY_NUMBER = {
    8: ("stamp", "x", "y", "z", "qx", "qy", "qz", "qw"),
    4: ("stamp", "x", "y", "heading"),
    3: ("x", "y", "heading"),
}
FORMS = "TUM rows (stamp x y z qx qy qz qw), rows of stamp x y heading, or a table that names such columns"


def trajectory_of(path: Path, stamps: Array) -> Found:
    """The poses of a trajectory at the stamps of the scans, taken for those of the laser.

    Without stamps it needs one row for each scan. Raises ValueError if the file is no trajectory.
    """
    columns = _columns(path)
    count = len(columns["x"])
    rigid = _rigid(path, columns)
    if "stamp" not in columns:
        if count != len(stamps):
            raise ValueError(
                f"{path.name} has no stamps and {count} poses, but the recording has {len(stamps)} scans; "
                "give each pose its stamp."
            )
        return Found(rigid.flat()[0], PoseSource(path.name, mounted=False))
    times = _seconds(columns["stamp"])
    motion = Motion.of(times, rigid)
    if motion is None:
        raise ValueError(f"{path.name} has no pose that is finite; expected: {FORMS}.")
    poses = motion.at(stamps).flat()[0]
    known = np.isfinite(poses).all(axis=1)
    missing = "" if known.all() else f"{path.name} has gaps, or begins later or ends earlier"
    low, high = float(np.min(stamps)), float(np.max(stamps))
    if times.min() > high or times.max() < low:
        missing = (
            f"the stamps of {path.name} go from {times.min():.3f} to {times.max():.3f} s, those of the scans from "
            f"{low:.3f} to {high:.3f} s: another clock"
        )
    apart = float(np.median(motion.apart(stamps[known]))) if known.any() else 0.0
    return Found(
        poses,
        PoseSource(path.name if known.any() else "", (), apart, False, missing, mounted=False),
        lambda at: motion.at(at).flat()[0],
    )


def _columns(path: Path) -> dict[str, Array]:
    """The numbers by the meaning of their column. Raises ValueError, naming the line, for what is none."""
    names: tuple[str, ...] = ()
    rows: list[list[float]] = []
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        for number, line in enumerate(file, 1):
            text = line.strip()
            if text.startswith(("#", "%", "//")) or (text and not rows and _is_heading(text)):
                names = _meanings(text.lstrip("#%/ ")) or names
                continue
            if not text:
                continue
            if number > MOST_LINES:
                raise ValueError(f"{path.name} has more than {MOST_LINES} lines; expected: {FORMS}.")
            rows.append(_numbers(path, number, text, len(rows[0]) if rows else None, bool(names)))
    if not rows:
        raise ValueError(f"{path.name} has no row of numbers; expected: {FORMS}.")
    names = names if len(names) == len(rows[0]) else BY_NUMBER.get(len(rows[0]), ())
    if not {"x", "y"} <= set(names) or not ({"heading", "heading_deg", "qw"} & set(names)):
        raise ValueError(f"{path.name} has {len(rows[0])} columns that are not known to be poses; expected: {FORMS}.")
    table = np.array(rows)
    return {name: table[:, number] for number, name in enumerate(names) if name}


def _cells(text: str) -> list[str]:
    for separator in (",", ";", "\t"):
        if separator in text:
            return [cell.strip() for cell in next(csv.reader([text], delimiter=separator))]
    return text.split()


def _is_heading(text: str) -> bool:
    return not any(re.fullmatch(r"[-+]?[\d.].*", cell) for cell in _cells(text))


def _meanings(text: str) -> tuple[str, ...]:
    """What each column means, "" if it is not needed; () if the names are no poses."""
    found = []
    for cell in _cells(text):
        word = re.sub(r"[^a-z]", "", re.sub(r"\[[^\[\]]*\]|\([^()]*\)", "", cell.lower()))
        exact = [name for name, words in NAMES.items() if word in words]
        ending = [name for name, words in NAMES.items() if any(len(each) > 5 and word.endswith(each) for each in words)]
        found.append(next((name for name in (*exact, *ending) if name not in found), ""))
    return tuple(found) if {"x", "y"} <= set(found) else ()


def _numbers(path: Path, number: int, text: str, wanted: int | None, named: bool) -> list[float]:
    cells = _cells(text)
    if wanted is not None and len(cells) != wanted:
        raise ValueError(f"{path.name}:{number} has {len(cells)} columns, but the rows before have {wanted}.")
    values = []
    for cell in cells:
        try:
            values.append(float(cell))
        except ValueError:
            if not named:
                raise ValueError(f"{path.name}:{number} has text among its numbers; expected: {FORMS}.") from None
            values.append(np.nan)
    return values


def _rigid(path: Path, columns: dict[str, Array]) -> Rigid:
    x, y = columns["x"], columns["y"]
    z = columns.get("z", np.zeros(len(x)))
    if {"qx", "qy", "qz", "qw"} <= columns.keys():
        return Rigid.of(np.column_stack([x, y, z, *(columns[name] for name in ("qx", "qy", "qz", "qw"))]))
    if "qw" in columns and "qz" in columns:
        nothing = np.zeros(len(x))
        return Rigid.of(np.column_stack([x, y, z, nothing, nothing, columns["qz"], columns["qw"]]))
    if not {"heading", "heading_deg"} & columns.keys():
        raise ValueError(f"{path.name} has no heading; expected: {FORMS}.")
    heading = columns["heading"] if "heading" in columns else np.deg2rad(columns["heading_deg"])
    return Rigid.on_plane(np.column_stack((x, y, heading)))


def _seconds(stamps: Array) -> Array:
    """Stamps may count nanoseconds, microseconds or milliseconds since 1970; none of them is a time in seconds."""
    largest = float(np.nanmax(np.abs(stamps), initial=0.0))
    return stamps * next((scale for limit, scale in ((1e17, 1e-9), (1e14, 1e-6), (1e11, 1e-3)) if largest > limit), 1.0)
