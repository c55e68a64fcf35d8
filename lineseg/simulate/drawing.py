"""A small world drawn by hand, as text that fits into a link: `l0,0,0;b-135,135,0.5,30,0.01;s0;w-3,2,3,2;c1,0,0.3`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import hypot, isfinite, radians

import numpy as np

from ..scan import Recording
from .laser import Laser, record
from .world import IDEAL, World

Numbers = tuple[float, ...]

MOST_WALLS = 80
MOST_CIRCLES = 40
MOST_BEAMS = 4000
FARTHEST = 100.0
SHORTEST = 0.01


@dataclass(frozen=True)
class Drawing:
    """Walls (x1, y1, x2, y2) and circles (x, y, radius) [m], and the laser that sees them.

    pose: x, y [m] and heading_deg. beams: first_deg, last_deg and step_deg of the bearings, range_max [m] and sigma,
    the standard deviation of a range [m]. seed: for the noise.
    """

    walls: tuple[Numbers, ...] = ()
    circles: tuple[Numbers, ...] = ()
    pose: Numbers = (0.0, 0.0, 0.0)
    beams: Numbers = (-135.0, 135.0, 0.5, 30.0, 0.01)
    seed: int = 0

    @classmethod
    def parse(cls, text: str) -> Drawing:
        """Parse parts separated by semicolons: l laser, b beams, s seed, any number of w walls and c circles.

        Raises ValueError that quotes an invalid part.
        """
        walls: list[Numbers] = []
        circles: list[Numbers] = []
        fields: dict[str, Numbers] = {}
        for part in filter(None, text.split(";")):
            kind, numbers = part[0], _numbers(part)
            if kind == "w":
                walls.append(_checked(part, numbers, 4, lambda x1, y1, x2, y2: hypot(x2 - x1, y2 - y1) >= SHORTEST))
            elif kind == "c":
                circles.append(_checked(part, numbers, 3, lambda x, y, radius: radius >= SHORTEST))
            elif kind == "l":
                fields["pose"] = _checked(part, numbers, 3, lambda x, y, heading: True, angles=True)
            elif kind == "b":
                fields["beams"] = _checked(part, numbers, 5, _are_beams, angles=True)
            elif kind == "s":
                fields["seed"] = _checked(part, numbers, 1, lambda seed: seed >= 0 and seed == int(seed), angles=True)
            else:
                raise ValueError(f"the drawing has a part {part[:40]!r}; parts begin with l, b, s, w or c")
        if len(walls) > MOST_WALLS or len(circles) > MOST_CIRCLES:
            raise ValueError(
                f"the drawing has {len(walls)} walls and {len(circles)} circles; "
                f"at most {MOST_WALLS} and {MOST_CIRCLES} are allowed"
            )
        seed = int(fields.pop("seed", (0,))[0])
        return cls(tuple(walls), tuple(circles), seed=seed, **fields)

    def recording(self) -> Recording:
        """One scan of the drawing, with its truth."""
        first, last, step, range_max, sigma = self.beams
        count = int((last - first) / step + 1e-9) + 1
        # On a full circle the last beam is one step before the first.
        count -= last - first >= 360 and abs(first + (count - 1) * step - last) < 1e-6
        laser = Laser(
            "drawn", radians(first), radians(step), count, 0.05, range_max, sigma=sigma, sigma_far=sigma, resolution=0.0
        )
        world = World.of(self.walls, self.circles, IDEAL)
        x, y, heading = self.pose
        pose = np.array([(x, y, radians(heading))])
        return record(lambda stamp: world, pose, np.zeros(1), laser, np.random.default_rng(self.seed), "drawing")


def _are_beams(first: float, last: float, step: float, range_max: float, sigma: float) -> bool:
    return (
        -360 <= first < last <= 360
        and last - first <= 360
        and step > 0
        and 3 <= (last - first) / step + 1 <= MOST_BEAMS + 1
        and range_max >= 0.1
        and 0 <= sigma <= 1
    )


def _numbers(part: str) -> Numbers:
    try:
        return tuple(float(number) for number in part[1:].split(","))
    except ValueError:
        raise ValueError(f"the drawing has a part {part[:40]!r}; write numbers after the letter") from None


def _checked(part: str, numbers: Numbers, count: int, allowed: Callable[..., bool], angles: bool = False) -> Numbers:
    farthest = 1e6 if angles else FARTHEST
    possible = len(numbers) == count and all(isfinite(number) and abs(number) <= farthest for number in numbers)
    if not possible or not allowed(*numbers):
        raise ValueError(f"the drawing has a part {part[:60]!r} that is not valid: {_EXPECTED[part[0]]}")
    return numbers


_EXPECTED = {
    "w": f"a wall needs x1,y1,x2,y2 within ±{FARTHEST:g} m, and a length above 0",
    "c": f"a circle needs x,y,radius within ±{FARTHEST:g} m, and a radius above 0",
    "l": "the laser needs x,y [m] and its heading [°]",
    "b": f"beams need first,last,step [°] (3 to {MOST_BEAMS} beams, at most one turn), range [m] and noise (0 to 1 m)",
    "s": "the seed is a whole number, 0 or more",
}
