"""Opens the other lasers of a recording in a thread of its own, while their layer is shown."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from lineseg import Reading, Recording, open_recording
from lineseg.readers import Progress

from ..live.ring import LiveRecording
from ..scene.beside import OtherLaser, why_apart
from ..scene.world import World
from ..view import View
from .aside import Aside

# Of a robot with more lasers, the first ones are drawn.
MOST_LASERS = 3
# What is said of the file as a whole, and so of its other topics too.
OF_THE_FILE = ("stamps", "poses", "pose_topic")


class Robot(NamedTuple):
    """A recording of one laser, and where the file is that has the others; reading: how the recording was read."""

    recording: Recording
    file: Callable[[], Path]
    reading: Reading

    @property
    def others(self) -> list[str]:
        return others_in(self.recording)


def others_in(recording: Recording) -> list[str]:
    """The topics of the other lasers."""
    return [topic.name for topic in recording.topics if topic.scans and topic.name != recording.topic][:MOST_LASERS]


def lasers_work(name: str, tell: Callable[[], None]) -> Aside[Robot, tuple[OtherLaser, ...]]:
    """Opens the other lasers of a robot."""
    return Aside(name, _lasers_of, tell, "the other lasers could not be read")


def shows_lasers(view: View, recording: Recording) -> bool:
    """Whether the scene shows the other lasers of a recording."""
    shown = view.space == "world" and view.layers.other_lasers and view.mode != "learn"
    still = not isinstance(recording, LiveRecording) and not recording.partial
    return shown and still and bool(others_in(recording))


def _lasers_of(robot: Robot, progress: Progress) -> tuple[OtherLaser, ...]:
    lasers, topics = list[OtherLaser](), robot.others
    for number, topic in enumerate(topics):

        def part(done: int, total: int, before: int = number) -> None:
            share = before + done / max(total, 1)
            progress(round(1000 * share), 1000 * len(topics))

        lasers.append(_laser(robot, topic, part))
    return tuple(lasers)


def _laser(robot: Robot, topic: str, progress: Progress) -> OtherLaser:
    given = {name: getattr(robot.reading, name) for name in OF_THE_FILE}
    try:
        other = open_recording(robot.file(), Reading(topic=topic).but(**given), progress=progress)
    except (ValueError, OSError) as error:
        return OtherLaser(topic, why=str(error))
    why = why_apart(robot.recording, other)
    return OtherLaser(topic, why=why) if why else OtherLaser(topic, World.of(other))
