"""The line map of a recording."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_recording
from ..knobs import Thresholds
from ..noise import noise
from ..posed.nearest import nearest_walls
from ..posed.returns import Returns
from ..posed.walls import Walls
from ..poses import Poses
from ..scan import Recording
from ..survey import Survey, survey
from .doubt import doubt
from .fusing import Fused, design_at, fused, over, pieces_of
from .joining import joined_lines
from .posed import Floats, PosedLines, PoseNoise, at_middle, posed_lines

# Before the recording has told how much its poses scatter [m, rad]; and bounds of what it tells.
FIRST = PoseNoise(0.05, np.radians(0.7))
LEAST, MOST = PoseNoise(0.005, np.radians(0.05)), PoseNoise(0.10, np.radians(2.0))
# Lines of frames that tell of a heading are longer [m], and lie on a map line with so many others or more.
LONG, SEVERAL = 1.5, 5
# Map lines are merged until no more of them fit, at most so often.
MERGES = 6
# A return lies on a map line within so many standard deviations; bounds of this distance [m].
DEVIATIONS, NEAREST, FARTHEST = 3.0, 0.05, 0.15
# Parts of the work, for its progress.
PARTS = 100

Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False)
class LineMap:
    """Lines (n,) in the world, longest first.

    ends: (n, 4) of x1, y1, x2, y2 [m]; the free side is on the left. covariance: (n, 2, 2) of (ρ, θ) [m, rad] of
    x·cos θ + y·sin θ = ρ, whose normal points away from where the line was seen; sigma: (n,) its standard deviation
    across, at its middle [m]. seen: (n,) lines of frames on it. frames: number of scans with a pose, band: distance [m]
    within which the share `coverage` of their returns lies on a map line. pose_noise: how much the poses scatter.
    doubt: why not to trust the map, or "".
    """

    ends: Floats
    covariance: Floats
    sigma: Floats
    seen: NDArray[np.int64]
    frames: int
    band: float
    coverage: float
    pose_noise: PoseNoise
    doubt: str = ""

    def __len__(self) -> int:
        return len(self.ends)

    @property
    def lengths(self) -> Floats:
        """(n,) [m]."""
        return np.hypot(self.ends[:, 2] - self.ends[:, 0], self.ends[:, 3] - self.ends[:, 1])

    @property
    def normals(self) -> Floats:
        """(n, 2) unit vectors, pointing away from where the lines were seen."""
        along = (self.ends[:, 2:] - self.ends[:, :2]) / self.lengths[:, None]
        return np.column_stack((along[:, 1], 0.0 - along[:, 0]))

    @property
    def text(self) -> str:
        """All of it in sentences."""
        shift, turn = self.pose_noise
        known = f", known to {1e3 * float(np.median(self.sigma)):.0f} mm (median)" if len(self) else ""
        said = (
            f"{len(self)} lines, {self.lengths.sum():.0f} m{known}. {self.coverage:.0%} of the returns of "
            f"{self.frames} scans lie within {1e3 * self.band:.0f} mm of a line. "
            f"The poses scatter by {1e3 * shift:.0f} mm and {np.degrees(turn):.1f}°."
        )
        return f"{said} {self.doubt}".strip()


def line_map(
    recording: Recording,
    params: Thresholds | None = None,
    found: Survey | None = None,
    least: int = 3,
    progress: Progress | None = None,
) -> LineMap:
    """The lines of all frames with a pose, merged into map lines with their covariance.

    params: thresholds of the extraction; their type selects the method. found: the survey of the recording, if there is
    one already. least: parts of lines that fewer scans saw are left out. progress: is told how much of the work is
    done; it may raise to stop it.
    Lines are one if they overlap, or nearly, and if their Mahalanobis distance is within the noise of beams and poses;
    how much the poses scatter is estimated from the lines themselves. Lines from one place count as one.
    Raises ValueError without poses.
    """
    need_recording(recording)
    poses = recording.poses
    if poses is None:
        raise ValueError(
            f"{recording.name} has no poses ({recording.pose_source.missing}), so its lines cannot be put together; "
            "--poses FILE reads a trajectory."
        )
    say = _parts(progress)
    if found is None:
        found = survey(recording, params, scores=False, progress=lambda done, total: say(0.4 * done / max(total, 1)))
    lines = posed_lines(recording, poses, found, noise(recording))
    say(0.45)
    owner, first = _grouped(lines, FIRST, lambda share: say(0.45 + 0.15 * share))
    pose = _pose_noise(lines, owner, first)
    owner, made = _grouped(lines, pose, lambda share: say(0.6 + 0.2 * share))
    say(0.85)
    return _result(recording, poses, lines, owner, made, pose, least)


def _parts(progress: Progress | None) -> Callable[[float], None]:
    def say(share: float) -> None:
        if progress is not None:
            progress(round(PARTS * share), PARTS)

    return say


def _grouped(lines: PosedLines, pose: PoseNoise, wanted: Callable[[float], None]) -> tuple[NDArray[np.int64], Fused]:
    """The map line of each line, and the map lines."""
    covariance = lines.noisy(pose)
    owner = joined_lines(lines.middle, lines.normal, lines.half, covariance, wanted)
    for _ in range(MERGES):
        made = fused(lines, owner, covariance)
        again = joined_lines(*_as_lines(lines, owner, made, pose), wanted)
        if len(again) == again.max(initial=-1) + 1:
            return owner, made
        owner = again[owner]
    return owner, fused(lines, owner, covariance)


def _as_lines(
    lines: PosedLines, owner: NDArray[np.int64], made: Fused, pose: PoseNoise
) -> tuple[Floats, Floats, Floats, Floats]:
    """Middle, normal, half length and covariance of map lines, to be joined like lines of frames.

    Scans that were taken one after the other share the error of their poses, so it does not shrink with their number.
    """
    along = over(lines, owner, made.origin, made.normal).along
    low, high = np.full(len(made.origin), np.inf), np.full(len(made.origin), -np.inf)
    np.minimum.at(low, owner, along - lines.half)
    np.maximum.at(high, owner, along + lines.half)
    normal, middle, covariance = placed(made, np.arange(len(low)), (low + high) / 2)
    covariance = covariance + np.diag((pose.shift**2, pose.turn**2))
    return middle, normal, (high - low) / 2, covariance


def placed(made: Fused, line: NDArray[np.int64], at: Floats) -> tuple[Floats, Floats, Floats]:
    """Normals, the points `at` [m] along the reference lines, and the covariance of height and slope there."""
    height, slope = made.line[line].T
    along = np.column_stack((-made.normal[line, 1], made.normal[line, 0]))
    cos = 1 / np.hypot(1.0, slope)
    normal = (made.normal[line] - slope[:, None] * along) * cos[:, None]
    middle = made.origin[line] + at[:, None] * along + (height + slope * at)[:, None] * made.normal[line]
    design = design_at(at)
    return normal, middle, design @ made.covariance[line] @ design.transpose(0, 2, 1)


def _pose_noise(lines: PosedLines, owner: NDArray[np.int64], made: Fused) -> PoseNoise:
    """How much poses scatter, by how far lines of frames lie from their map lines beyond the noise of their beams."""
    several = np.bincount(owner, minlength=len(made.origin))[owner] >= SEVERAL
    along, height, slope = over(lines, owner, made.origin, made.normal)
    away = height - made.line[owner, 0] - made.line[owner, 1] * along
    turned = slope - made.line[owner, 1]
    of = np.stack((lines.covariance[:, 0, 0], lines.covariance[:, 1, 1]))
    shift = _beyond(away[several], of[0, several], LEAST.shift, MOST.shift)
    long = several & (2 * lines.half > LONG)
    return PoseNoise(shift, _beyond(turned[long], of[1, long], LEAST.turn, MOST.turn))


def _beyond(apart: Floats, variance: Floats, least: float, most: float) -> float:
    """The standard deviation of values beyond that of their own noise, in spite of outliers."""
    if not len(apart):
        return least
    beyond = (1.4826 * float(np.median(np.abs(apart)))) ** 2 - float(np.median(variance))
    return float(np.clip(np.sqrt(max(beyond, 0.0)), least, most))


def _result(
    recording: Recording, poses: Poses, lines: PosedLines, owner: NDArray[np.int64], made: Fused, pose: PoseNoise,
    least: int,
) -> LineMap:  # fmt: skip
    pieces = pieces_of(lines, owner, made, least)
    normal, middle, covariance = placed(made, pieces.line, (pieces.low + pieces.high) / 2)
    half = (pieces.high - pieces.low) / 2
    along = np.column_stack((-normal[:, 1], normal[:, 0]))
    ends = np.column_stack((middle - half[:, None] * along, middle + half[:, None] * along))
    order = np.argsort(-half, kind="stable")
    reach = (along * middle).sum(axis=1)
    sigma = np.sqrt(covariance[:, 0, 0])
    frames = int(np.isfinite(poses).all(axis=1).sum())
    band = float(np.clip(DEVIATIONS * pose.shift, NEAREST, FARTHEST))
    found = LineMap(
        ends[order], at_middle(covariance, reach)[order], sigma[order], pieces.seen[order], frames, band, 0.0, pose
    )
    coverage = coverage_of(recording, poses, found)
    return replace(found, coverage=coverage, doubt=doubt(recording, poses, coverage))


def coverage_of(recording: Recording, poses: Poses, found: LineMap) -> float:
    """The share of the returns that lie within the band of a map line that faces the laser; NaN without returns."""
    returns = Returns.of(recording, poses)
    if not len(returns):
        return float("nan")
    known = np.ascontiguousarray(poses[returns.frames], dtype=np.float64)
    facing, lengths = (-found.normals).astype(np.float64), found.lengths
    # `Walls` face the laser, and so run the other way.
    along = np.column_stack((-facing[:, 1], facing[:, 0]))
    start = (found.ends[:, 2:] * along).sum(axis=1)
    offset = (found.ends[:, :2] * facing).sum(axis=1)
    walls = Walls(facing, offset, start, start + lengths, np.zeros(len(found)))
    wall, _ = nearest_walls(returns.in_world(known), returns.scan, known, walls, found.band)
    return float(np.mean(wall >= 0))
