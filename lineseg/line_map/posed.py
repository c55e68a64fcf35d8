"""The lines of all frames in the world, each with its covariance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..covariance import covariances_of_points
from ..noise import RangeNoise
from ..posed.returns import views_of
from ..poses import Poses, in_world
from ..scan import Recording, are_valid
from ..survey import Survey

# What a range scatters by where the scans do not tell [m].
UNKNOWN_NOISE = 0.01

Floats = NDArray[np.floating]


class PoseNoise(NamedTuple):
    """Standard deviations of a pose: `shift` in x and in y [m], `turn` of its heading [rad]."""

    shift: float
    turn: float


@dataclass(frozen=True, eq=False)
class PosedLines:
    """Lines (n,) in the world.

    middle: (n, 2) [m]; normal: (n, 2) unit vector, pointing away from the laser; half: (n,) half of their lengths [m].
    covariance: (n, 2, 2) of the height of the line at its middle, along the normal [m], and of its slope [rad], without
    the noise of the pose. reach: (n,) of the middle from the foot of the perpendicular from the laser, along the line
    [m]. weight: (n,) one over the number of scans from the same place.
    """

    middle: Floats
    normal: Floats
    half: Floats
    covariance: Floats
    reach: Floats
    weight: Floats

    def __len__(self) -> int:
        return len(self.half)

    def noisy(self, pose: PoseNoise) -> Floats:
        """(n, 2, 2) the covariance with the noise of the pose: a turn moves a line the more, the farther it is."""
        found = self.covariance.copy()
        found[:, 0, 0] += pose.shift**2 + (self.reach * pose.turn) ** 2
        found[:, 0, 1] += self.reach * pose.turn**2
        found[:, 1, 0] += self.reach * pose.turn**2
        found[:, 1, 1] += pose.turn**2
        return found


def posed_lines(recording: Recording, poses: Poses, found: Survey, noise: RangeNoise) -> PosedLines:
    """The lines of the frames that have a pose."""
    frame = np.repeat(np.arange(len(found)), np.diff(found.offsets))
    known = np.asarray(np.isfinite(poses).all(axis=1))
    chosen = known[frame] & (found.segments["length"] > 0) & (found.segments["points"] >= 2)
    rows, frame = found.segments[chosen], frame[chosen]
    ends = np.stack([np.column_stack((rows[f"x{end}"], rows[f"y{end}"])) for end in (1, 2)], axis=1)
    normal = np.column_stack((rows["a"], rows["b"]))
    middle = ends.mean(axis=1)
    reach = rows["a"] * middle[:, 1] - rows["b"] * middle[:, 0]
    upside_down = recording.pose_source.upside_down
    spots = in_world(np.stack((middle, middle + normal), axis=1), poses[frame], upside_down)
    covariance = at_middle(covariances_of_rows(recording, rows, frame, noise), reach)
    finite = np.asarray(np.isfinite(covariance).all(axis=(1, 2)))
    if upside_down:
        # Seen from above, the direction along each line is the other one.
        covariance[:, (0, 1), (1, 0)] *= -1
        reach = -reach
    weight = _shares(poses, known)[frame]
    lines = PosedLines(spots[:, 0], spots[:, 1] - spots[:, 0], rows["length"] / 2, covariance, reach, weight)
    return only(lines, finite)


def only(lines: PosedLines, chosen: NDArray) -> PosedLines:
    return PosedLines(*(getattr(lines, name)[chosen] for name in PosedLines.__dataclass_fields__))


def at_middle(covariance: Floats, reach: Floats) -> Floats:
    """(n, 2, 2) of the height at `reach` along the line and of the slope, from those of (ρ, θ).

    A line turned by δθ is ρ + δρ − reach·δθ high there, and its slope is −δθ.
    """
    jacobian = np.zeros((len(reach), 2, 2))
    jacobian[:, 0, 0], jacobian[:, 0, 1], jacobian[:, 1, 1] = 1.0, -reach, -1.0
    return jacobian @ covariance @ jacobian.transpose(0, 2, 1)


def covariances_of_rows(
    recording: Recording, rows: NDArray[np.void], frame: NDArray[np.int64], noise: RangeNoise
) -> Floats:
    """(n, 2, 2) of (ρ, θ) of each segment of a survey, from its beams; see `lineseg.covariance`.

    Where its points scatter more than the noise explains, since a wall is rough or bends, it is as much larger.
    """
    beam, bounds = _beams_of(recording, rows, frame)
    x, y, ranges = _points(recording, frame, beam, bounds)
    sigma = noise.at(ranges) if noise.known else np.full(len(ranges), UNKNOWN_NOISE)
    lines = np.column_stack([rows[name] for name in "abc"])
    found = np.empty((len(rows), 2, 2))
    covariances_of_points(x, y, sigma, np.zeros(len(x)), bounds, lines, found)
    expected = np.sqrt(np.add.reduceat(sigma**2, bounds[:-1]) / np.diff(bounds)) if len(rows) else np.empty(0)
    return found * np.maximum(rows["rms"] / np.maximum(expected, 1e-4), 1.0)[:, None, None] ** 2


def _beams_of(
    recording: Recording, rows: NDArray[np.void], frame: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The valid beams of each segment, as places in the recording's flat arrays, and where those of each begin."""
    beams = np.diff(recording.offsets)[frame]
    span = (rows["last"] - rows["first"]) % beams + 1
    segment = np.repeat(np.arange(len(rows)), span)
    step = np.arange(len(segment)) - np.repeat(np.cumsum(span) - span, span)
    beam = recording.offsets[frame][segment] + (rows["first"][segment] + step) % beams[segment]
    of = frame[segment]
    valid = are_valid(recording.ranges[beam], recording.range_min[of], recording.range_max[of])
    counts = np.bincount(segment[valid], minlength=len(rows))
    return beam[valid], np.concatenate(([0], np.cumsum(counts)))


def _points(
    recording: Recording, frame: NDArray[np.int64], beam: NDArray[np.int64], bounds: NDArray[np.int64]
) -> tuple[Floats, Floats, Floats]:
    """x, y and range of these beams, in the frame of their laser."""
    ranges = recording.ranges[beam].astype(np.float64)
    if recording.bearings is not None:
        bearings = recording.bearings[beam].astype(np.float64)
    else:
        of = np.repeat(frame, np.diff(bounds))
        bearings = recording.angle_min[of] + recording.angle_increment[of] * (beam - recording.offsets[of])
    return ranges * np.cos(bearings), ranges * np.sin(bearings), ranges


def _shares(poses: Poses, known: NDArray[np.bool_]) -> Floats:
    """(frames,) one over the number of scans from the same place, which share the error of their poses."""
    shares = np.ones(len(poses))
    views = views_of(poses[known])
    shares[known] = 1.0 / np.bincount(views)[views]
    return shares
