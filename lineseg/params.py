"""The thresholds of seeded region growing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .knobs import Knob, Thresholds

# Some of these thresholds are shared with other methods.
Epsilon = Annotated[
    float,
    Knob(
        "ε", 0.005, 0.50, "m", 0.001, log=True, least=1e-6, most=100.0, ros="least_thresh", scatter=1.0,
        label="distance to the line", equation="Eq. 3", lesson="07_epsilon",
        why="a distance of 0 would refuse every measured point",
        help="Largest distance of a point from its line. Higher accepts noisier points. Set it near the laser's range "
        "noise.",
        refuses="beam {beam} lies {value:m} from the line, ε = {limit:m} (over by {over:m})",
        counted="Distances from the tested points to the line",
    ),
]  # fmt: skip
Delta = Annotated[
    float,
    Knob(
        "δ", 0.01, 1.0, "m", 0.005, log=True, least=1e-6, most=1000.0, ros="predict_distance", scatter=1.0,
        label="distance to the predicted point", equation="Eqs. 4–6", lesson="02_delta",
        why="a distance of 0 would refuse every measured point",
        help="Largest distance, in a seed, from a point to where its beam meets the line. Lower keeps range jumps out "
        "of seeds.",
        refuses="beam {beam} lies {value:m} from its predicted point, δ = {limit:m} (over by {over:m})",
        counted="Distances to the predicted point, in seeds",
    ),
]  # fmt: skip
SeedPoints = Annotated[
    int,
    Knob(
        "S_num", 3, 20, "", 1, least=3, most=1000, ros="seed_line_points",
        label="points in a seed", equation="Algorithm 1", lesson="01_seed",
        why="a seed needs 3 or more points, because any 2 points fit a line exactly",
        help="Consecutive points in a seed. Higher gives fewer and more reliable seeds.",
    ),
]  # fmt: skip
MinPoints = Annotated[
    int,
    Knob(
        "P_min", 3, 100, "", 1, least=2, most=100_000, ros="min_line_points",
        label="points in a line", equation="Algorithm 2", lesson="08_how_much",
        why="a line needs at least 2 points",
        help="Fewest points in a line. Higher drops more small lines.",
        refuses="{value:g} points < P_min = {limit:g} (short by {short:g})",
        counted="Points in each line that grew",
        floor=True,
    ),
]  # fmt: skip
MinLength = Annotated[
    float,
    Knob(
        "L_min", 0.0, 3.0, "m", 0.01, least=0.0, most=1000.0, ros="min_line_length",
        label="length of a line", equation="Algorithm 2", lesson="08_how_much",
        why="a length is never negative",
        help="Shortest length of a line, from endpoint to endpoint. Higher drops more short lines.",
        refuses="{value:m} < L_min = {limit:m} (short by {short:m})",
        counted="Length of each line that grew",
        floor=True,
    ),
]  # fmt: skip


@dataclass(frozen=True)
class Params(Thresholds):
    """Thresholds of seeded region growing. Defaults are the paper's (Table 2); extensions are marked as such."""

    epsilon: Epsilon = 0.03
    delta: Delta = 0.10
    seed_points: SeedPoints = 6
    min_points: MinPoints = 10
    min_length: MinLength = 0.60
    max_dropout: Annotated[
        int,
        Knob(
            "D_max", 0, 40, "beams", 1, least=0, most=100_000,
            label="dropout crossed", lesson="11_doorway",
            why="a number of beams is never negative",
            help="Largest number of consecutive beams without a return that a seed or line may cross. 0 allows none, "
            "like the authors' program.",
            refuses="{value:g} beams without a return lie before beam {beam}, D_max = {limit:g} (over by {over:g})",
            extension=True,
        ),
    ] = 3  # fmt: skip
    max_gap: Annotated[
        float,
        Knob(
            "G_max", 0.1, 30.0, "m", 0.05, log=True, least=1e-6, most=1000.0,
            label="gap bridged",
            why="a gap of 0 would separate every point from the next",
            help="Widest gap between neighbouring points that a seed or growing line may bridge. Higher bridges "
            "wider openings.",
            refuses="a gap of {value:m} lies before beam {beam}, G_max = {limit:m} (over by {over:m})",
            extension=True,
        ),
    ] = 30.0  # fmt: skip
    merge_angle: Annotated[
        float,
        Knob(
            "α_merge", 0.0, 0.5, "rad", 0.005, least=0.0, most=math.pi / 2,
            label="merge angle", lesson="04_collinear",
            why="two lines are never more than a right angle apart",
            help="Overlapping neighbours that differ by less than this angle are merged. Higher merges more; 0 merges "
            "none.",
            refuses="{value:deg} apart, not less than {limit:deg}",
            extension=True,
        ),
    ] = 0.10  # fmt: skip
    merge_rms: Annotated[
        float,
        Knob(
            "γ_merge", 0.0, 3.0, "", 0.05, least=0.0, most=1e6,
            label="rms growth in a merge", lesson="09_shallow",
            why="a factor is never negative",
            help="Largest factor by which a merge may raise the rms distance. Above 0, lines separated by up to D_max "
            "stray points can merge too. 0 turns both off, as in the paper.",
            refuses="merged, their rms would be {value:m}, more than {limit:m}",
            extension=True,
        ),
    ] = 1.2  # fmt: skip
    max_occluder: Annotated[
        float,
        Knob(
            "W_max", 0.0, 1.0, "m", 0.01, least=0.0, most=100.0,
            label="object ignored",
            why="a width is never negative",
            help="Widest piece of a wall that a small object in front of it, such as a chair leg, may hide. Lines pass "
            "behind such objects. Higher ignores wider ones; 0 ignores none, as in the paper.",
            extension=True,
        ),
    ] = 0.3  # fmt: skip
    max_void: Annotated[
        float,
        Knob(
            "V_max", 0.0, 2.0, "m", 0.05, least=0.0, most=1000.0,
            label="void bridged",
            why="a width is never negative",
            help="Widest void that a line may cross: a gap whose beams ended elsewhere or did not return, or one much "
            "wider than the gaps next to it. Higher crosses wider ones; 0 crosses any, as in the paper.",
            refuses="a void of {value:m} lies before beam {beam}, V_max = {limit:m} (over by {over:m})",
            extension=True,
        ),
    ] = 0.3  # fmt: skip
    epsilon_growth: Annotated[
        float,
        Knob(
            "κ", 0.0, 0.05, "m/m", 0.0005, least=0.0, most=1.0, growth=0.75,
            label="growth of ε with range",
            why="noise does not shrink with the range",
            help="At the range ρ, a point may lie √(ε² + (κρ)²) from its line. Higher accepts noisier points far from "
            "the laser; 0 is the same ε at every range, as in the paper.",
            extension=True,
        ),
    ] = 0.002  # fmt: skip

    def epsilon_at(self, ranges: ArrayLike) -> NDArray[np.float64]:
        """Largest distance from its line of a point at these ranges [m]: √(ε² + (κρ)²)."""
        return np.sqrt(self.epsilon**2 + (self.epsilon_growth * np.asarray(ranges, np.float64)) ** 2)
