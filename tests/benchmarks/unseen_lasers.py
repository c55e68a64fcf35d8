"""How good proposals are for lasers and rooms made at random: python tests/benchmarks/unseen_lasers.py [FIRST:STOP]

For each seed a laser (σ from 3 to 80 mm, constant, in steps or growing with the range; ¼ to 1°; coarse ranges, mixed
pixels, beams missing at the seam) looks at a room of its own (walls that bend, doors, openings, windows, furniture).
The score with the proposed thresholds is divided by the best that any ε reaches, with δ = ε or δ as usual.
"""

from __future__ import annotations

import sys
from math import inf, pi, radians

import numpy as np

from lineseg import Params, Recording
from lineseg.proposal import propose
from lineseg.simulate import (
    CLOTH,
    DARK,
    METAL,
    PAINT,
    Feature,
    Laser,
    Material,
    World,
    box,
    chair,
    circle,
    desk,
    fire_cabinet,
    opening,
    record,
    room,
    swivel_chair,
    window,
)  # fmt: skip
from lineseg.sweep import Batch, Totals
from lineseg.tuning import Objective

FRAMES = 24
EPSILONS = np.geomspace(0.01, 0.5, 29).tolist()


def laser_of(rng: np.random.Generator) -> Laser:
    step, field = rng.choice([0.25, 1 / 3, 0.5, 0.72, 1.0]), rng.choice([180, 240, 270, 360])
    beams = round(field / step) - (int(rng.integers(0, 4)) if field == 360 else -1)
    sigma, kind = float(np.exp(rng.uniform(np.log(0.003), np.log(0.08)))), rng.integers(0, 3)
    growing = kind == 1
    near = min(sigma, 0.02) if growing else sigma
    return Laser(
        f"σ = {1e3 * near:.0f} mm", radians(-field / 2), radians(step), beams, 0.1, float(rng.choice([8, 12, 30])),
        sigma=near, sigma_far=near * float(rng.uniform(1.2, 2.5)) if kind == 2 else near,
        far=float(rng.uniform(4, 10)) if kind == 2 else inf, growth=float(rng.uniform(0.002, 0.015)) * growing,
        resolution=float(rng.choice([0.0, 0.00025, 0.001, 0.01, 0.02])), beam_width=radians(step * rng.uniform(0.3, 1)),
        mixed=float(rng.uniform(0.3, 0.8)), grazing=float(rng.choice([0.0, 0.0, 0.1])),
    )  # fmt: skip


def features_of(rng: np.random.Generator, length: float) -> list[Feature]:
    kinds = (
        lambda at: Feature(at, 0.95, float(rng.uniform(0.02, 0.2))),
        lambda at: opening(at, float(rng.uniform(0.9, 1.6))),
        window,
        fire_cabinet,
    )
    places = np.cumsum(rng.uniform(2.0, 5.0, 10)) - 0.8
    return [kinds[rng.integers(0, 4)](at) for at in places[places < length - 1.2].tolist()]


def recording_of(seed: int) -> Recording:
    rng = np.random.default_rng(seed)
    laser, (width, depth) = laser_of(rng), rng.uniform((4, 3), (20, 12)).tolist()
    corners = [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)]
    if rng.random() < 0.5:
        x, y = (rng.uniform(0.4, 0.6, 2) * (width, depth)).tolist()
        corners[2:3] = [(width, y), (x, y), (x, depth)]
    bent = Material(0.9985, radians(89), 0.0, float(rng.uniform(0.004, 0.03)), float(rng.uniform(0.3, 2.0)))
    lengths = [np.hypot(*np.subtract(a, b)) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    features = {wall: features_of(rng, length) for wall, length in enumerate(lengths)}
    world = room(corners, features, bent if rng.random() < 0.6 else PAINT)
    free = [place for place in rng.uniform((0.8, 0.8), (width - 0.8, depth - 0.8), (900, 2)) if in_room(place, corners)]
    for place in [(x, y) for x, y in free[: rng.integers(0, 9)]]:
        turn = float(rng.uniform(0, 2 * pi))
        things = (chair(place, turn), desk(place, heading=turn), swivel_chair(place, turn), circle(place, 0.15, METAL))
        block = box(place, *rng.uniform(0.3, 1.6, 2), turn, (PAINT, CLOTH, DARK)[rng.integers(0, 3)])
        world += (*things, block)[rng.integers(0, 5)]
    poses = [(*place, rng.uniform(-pi, pi)) for place in free[9:] if is_clear(world, place)][:FRAMES]
    return record(lambda _: world, np.array(poses), np.arange(len(poses)) / 2, laser, rng, f"{seed}: {laser.name}")


def in_room(place: np.ndarray, corners: list[tuple[float, float]]) -> bool:
    """Whether a place is 0.5 m or more away from the corner that is left out."""
    return len(corners) == 4 or not (place > np.array(corners[3]) - 0.5).all()


def is_clear(world: World, place: np.ndarray) -> bool:
    """Whether the robot fits: nothing is nearer than 0.35 m."""
    start, along = world.walls[:, :2], world.walls[:, 2:] - world.walls[:, :2]
    share = np.clip(((place - start) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    walls = np.hypot(*(start + share[:, None] * along - place).T)
    circles = np.hypot(*(world.circles[:, :2] - place).T) - world.circles[:, 2]
    return min(walls.min(), circles.min(initial=inf)) > 0.35


def main(first: int, stop: int) -> None:
    shares = []
    for seed in range(first, stop):
        recording = recording_of(seed)
        settings = [propose(recording).params]
        for epsilon in EPSILONS:
            settings += [Params(epsilon=epsilon), Params(epsilon=epsilon, delta=epsilon)]
        found, *others = (
            Objective().score(Totals(sums)) for sums in Batch(recording, scored=False).measure(settings).sums
        )
        shares.append(found / max(others))
        print(f"{recording.name:20} {found:.3f} of {max(others):.3f}: {shares[-1]:.3f}")
    low = sum(share < 0.97 for share in shares)
    print(f"mean {np.mean(shares):.3f}, lowest {min(shares):.3f}, {low} of {len(shares)} below 0.97")


if __name__ == "__main__":
    bounds = (sys.argv[1] if len(sys.argv) > 1 else "0:24").split(":")
    main(int(bounds[0]), int(bounds[1]))
