"""Gives a recording its poses: from a trajectory beside it, from its bag when they are first asked for, or as read."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from ...poses import Found, PoseSource, Track
from ...scan import Recording
from ..account import Notes
from ..bags import ros1, ros2
from ..containers.wrapping import unwrapped
from ..reading import Reading
from ..source import Source
from .bag_poses import Wanted, found_in, has_poses
from .trajectory import trajectory_of

MESSAGES = {
    ros1.Ros1Bag.format: ros1.messages_of, ros2.Ros2Bag.format: ros2.messages_of, ros2.Mcap.format: ros2.messages_of,
}  # fmt: skip


def with_poses(recording: Recording, reading: Reading, file: Path) -> Recording:
    """The recording with its track. Raises ValueError or OSError if the trajectory that is asked for cannot be read."""
    if recording.partial and (reading.poses is not None or recording.format in MESSAGES):
        return replace(recording, track=Track(partial(_not_yet, len(recording))))
    if reading.poses is not None:
        track = Track(partial(trajectory_of, _beside(file, reading.poses), recording.stamps))
        # What is wrong with a file that a person names is told at once.
        _ = track.found
        return replace(recording, track=track)
    if recording.format not in MESSAGES:
        return recording
    recorded, mirrored = reading.stamps == "recorded", reading.direction == "clockwise"
    frame_ids = frozenset(recording.frame_ids)
    wanted = Wanted(recording.stamps, frame_ids, reading.pose_topic, recorded, mirrored)
    return replace(recording, track=Track(partial(_of_bag, file.absolute(), recording.format, wanted)))


def _not_yet(frames: int) -> Found:
    return Found(np.full((frames, 3), np.nan), PoseSource(missing="they are found once the whole file is read"))


def _beside(file: Path, name: str) -> Path:
    """The file of a trajectory: beside the recording, or where its path says."""
    beside = file.absolute().parent / name
    path = beside if beside.is_file() else Path(name)
    if not path.is_file():
        raise FileNotFoundError(f"{name}: there is no such file of poses, neither here nor beside {file.name}.")
    return path.absolute()


def _of_bag(file: Path, format: str, wanted: Wanted) -> Found:
    with ExitStack() as stack, np.errstate(all="ignore"):
        try:
            notes = Notes()
            path = file if file.is_dir() else unwrapped(file, stack, notes, lambda done, total: None)
            return found_in(MESSAGES[format](Source(path, notes=notes, named=file), has_poses), wanted)
        except (OSError, ValueError) as error:
            return Found(np.full((len(wanted.stamps), 3), np.nan), PoseSource(missing=str(error).rstrip(".")))
