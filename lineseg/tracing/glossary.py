"""The terms and symbols of region growing, each explained once: on the page, in lessons and in its list of terms."""

from __future__ import annotations

from typing import NamedTuple

from ..params import Params


class Term(NamedTuple):
    """A term, or a symbol of the paper.

    name: as it is listed. text: its explanation. forms: how texts write it, as whole words. equation: where the paper
    has it, "" if nowhere. lesson: id of the lesson that explains it, or "".
    """

    name: str
    text: str
    forms: tuple[str, ...]
    equation: str = ""
    lesson: str = ""


def _thresholds() -> tuple[Term, ...]:
    """The thresholds, explained by their declarations."""
    terms = []
    for _, _, knob in Params.knobs():
        origin = " Not in the paper." if knob.extension else ""
        label = f"{knob.label[0].upper()}{knob.label[1:]}."
        terms.append(Term(knob.symbol, f"{label} {knob.help}{origin}", (knob.symbol,), knob.equation, knob.lesson))
    return tuple(terms)


TERMS = (
    Term(
        "beam",
        "One measurement of the laser in one direction. Beams are numbered from 0 in the order of the scan; a beam "
        "that hits something gives a point.",
        ("beam", "beams"),
        lesson="01_seed",
    ),
    Term(
        "return",
        "A beam has a return if its light came back, so that its range is known. A beam without one has no point.",
        ("return", "returns"),
        lesson="11_doorway",
    ),
    Term("range", "The distance that a beam measured, ρ.", ("range", "ranges", "ρ"), "Eq. 4", "02_delta"),
    Term(
        "ρ′",
        "The range that a beam would have if its point lay on the line: from the laser to P′.",
        ("ρ′",),
        "Eqs. 4–6",
        "02_delta",
    ),
    Term("bearing", "The direction of a beam, θ, as an angle from the laser's x axis.", ("bearing", "θ"), "Eq. 4"),
    Term("P", "The point under test: where its beam hit something.", ("P",), "Eq. 3", "02_delta"),
    Term(
        "P′",
        "The predicted point of a beam: where the beam meets the line. P and P′ lie on one beam, so they are |ρ − ρ′| "
        "apart.",
        ("P′", "predicted point"),
        "Eqs. 4–6",
        "02_delta",
    ),
    Term("i, j", "Positions of the first and the last point of a window.", ("i", "j"), "Algorithm 1", "01_seed"),
    Term(
        "k",
        "Position of the point under test in a window, or of the first point after a cut.",
        ("k",),
        "Algorithms 1, 3",
        "01_seed",
    ),
    Term("n", "Position of the point that would join a growing line next.", ("n",), "Algorithm 2", "03_growth"),
    Term(
        "P_b, P_f",
        "First (backmost) and last (foremost) point of a growing line.",
        ("P_b", "P_f"),
        "Algorithm 2",
        "03_growth",
    ),
    Term("P_l", "Number of points in a line; at least P_min are needed.", ("P_l",), "Algorithm 2", "03_growth"),
    Term(
        "L_l", "Length of a line between its endpoints; at least L_min is needed.", ("L_l",), "Algorithm 2", "03_growth"
    ),
    Term(
        "line",
        "The straight line through some points that has the smallest sum of squared distances: a·x + b·y + c = 0.",
        ("line", "lines", "fitted line"),
        "Eqs. 1, 2",
        "03_growth",
    ),
    Term(
        "(a, b, c)",
        "The numbers of a line: (a, b) is its normal, of length 1, and |c| its distance from the laser.",
        ("(a, b, c)", "normal"),
        "Eq. 1",
        "06_endpoints",
    ),
    Term(
        "fit",
        "To find the line with the smallest sum of squared distances. Distances are measured across the line "
        "(total least squares), so walls of every direction are treated alike.",
        ("fit", "fitted", "refit", "refitted"),
        "Eq. 2",
        "03_growth",
    ),
    Term("d", "Distance from a point to a line, measured across the line.", ("d", "d_1", "d_2"), "Eq. 3", "05_corner"),
    Term("window", "S_num points in a row that are tried as a seed.", ("window", "windows"), "Algorithm 1", "01_seed"),
    Term(
        "seed",
        "A window whose points all lie near the line fitted to them. A line grows from it, since a line through two "
        "points alone would say nothing about a wall.",
        ("seed", "seeds"),
        "Algorithm 1",
        "01_seed",
    ),
    Term(
        "growth",
        "A line takes in its next neighbouring point, first forward, then backward, as long as the point lies nearer "
        "than ε.",
        ("growth", "grow", "grows", "grown", "grew"),
        "Algorithm 2",
        "03_growth",
    ),
    Term("forward", "In the order of the scan, towards higher beam numbers; backward is the other way.",
         ("forward", "backward"), "Algorithm 2", "03_growth"),
    Term(
        "shared points",
        "Points that two neighbouring lines both contain: their overlap. The lines are merged, or cut at one point.",
        ("shared points", "overlap", "share points", "shared point"),
        "Algorithm 3",
        "05_corner",
    ),
    Term("merge", "To make one line of two neighbours with nearly the same direction.",
         ("merge", "merged", "merging"), "Algorithm 3", "04_collinear"),
    Term("cut", "To divide the points that two lines share, at the first one that is not nearer to the first line.",
         ("cut",), "Algorithm 3", "05_corner"),
    Term("neighbours", "Points that follow one another in the order of the scan. Only the next neighbour may join a "
         "line, since points of one wall are neighbours.", ("neighbours", "neighbour", "neighbouring"), "Algorithm 2",
         "03_growth"),
    Term("seam", "Where the numbers of the beams begin again on a full circle. Lines cross it like any other place.",
         ("seam",), lesson="19_seam"),
    Term("candidate", "A line that has grown, before it is kept or dropped.", ("candidate", "candidates"),
         lesson="08_how_much"),
    Term("dropped", "Refused as a whole: a line with fewer points than P_min or shorter than L_min.",
         ("dropped", "drop", "drops"), "Algorithm 2", "08_how_much"),
    Term("endpoint",
         "An end of a segment: its outermost point, moved across the line onto it: P_0 = (x_0, y_0) becomes "
         "P_s = (x_s, y_s).",
         ("endpoint", "endpoints", "x_0", "y_0", "x_s", "y_s", "P_0", "P_s"), "Eqs. 7, 8", "06_endpoints"),
    Term("segment", "A line that was kept, between its two endpoints.", ("segment", "segments"), lesson="06_endpoints"),
    Term("noise", "How much ranges scatter when the same wall is measured again, σ.", ("noise", "σ"),
         lesson="07_epsilon"),
    Term("grazing angle", "A beam that runs nearly along a wall meets it at a grazing angle.", ("grazing angle",),
         lesson="02_delta"),
    Term("threshold", "A number that a method compares with; its slider changes it.", ("threshold", "thresholds"),
         lesson="08_how_much"),
    Term("extension", "A threshold that the paper does not have. With all of them off, the method is the paper's.",
         ("extension", "extensions")),
    Term("decision", "One step of the method, with the measured value and the limit it was compared with.",
         ("decision", "decisions")),
    Term("rms", "Root mean square distance of the points of a line from it: how far they typically are.", ("rms",),
         lesson="09_shallow"),
    Term("least squares", "The line whose sum of squared distances to its points is the smallest. Orthogonal least "
         "squares takes distances across the line, vertical least squares those along y.",
         ("least squares", "Orthogonal", "orthogonal", "Orthogonally", "orthogonally"), "Eq. 2", "13_least_squares"),
    Term("φ", "The direction of the normal of a fitted line; it follows from the moments of the points.", ("φ",),
         "Eq. 2", "13_least_squares"),
    Term("x̄, ȳ, S_xx, S_xy, S_yy", "The mean of the points, and the sums of squares and products of their "
         "distances from it: the moments from which a line is fitted.", ("moments", "S_xx", "S_xy", "S_yy"),
         "Eq. 2", "13_least_squares"),
    Term("true line", "The part of a wall that the laser sees, as a person or the simulation knows it.",
         ("true line", "true lines", "TrueLines"), "Eq. 9", "16_correctness"),
    Term("match", "A line that was found and a true line which share more than half of all their points.",
         ("match", "matches", "matched", "NumMatch"), "Eqs. 9, 10", "16_correctness"),
    Term("TR", "True rate: the share of the true lines that were found, NumMatch / TrueLines.", ("TR",), "Eq. 9",
         "16_correctness"),
    Term("FR", "False rate: the share of the lines found that are false, (NumExtLine − NumMatch) / NumExtLine.",
         ("FR", "NumExtLine"), "Eq. 10", "16_correctness"),
    Term("completeness", "How much of the matched true lines is covered, on average; lost ends lower it.",
         ("completeness", "Completeness"), lesson="16_correctness"),
    Term("label", "A true line marked by a person.", ("label", "labels", "labelled", "Label"),
         lesson="16_correctness"),
    Term("Iterative end-point fit", "A method that draws a line between the two ends of a stretch and splits it at the "
         "farthest point, again and again.", ("Iterative end-point fit", "iterative end-point fit"), "Fig. 1",
         "17_splitting"),
    Term("Split-and-Merge", "A method that splits as iterative end-point fit does, then fits lines to all points of "
         "each stretch and merges similar neighbours.", ("Split-and-Merge",), "Fig. 2", "12_split_and_merge"),
    Term("Hough transform", "A method in which each point votes for all lines through it. The line with the most "
         "votes is taken first.",
         ("Hough transform",), lesson="12_split_and_merge"),
    Term("region growing", "The method of the paper: it starts with a seed and takes in neighbouring points.",
         ("region growing", "Region growing"), lesson="03_growth"),
    Term("stretch", "Points in a row that a method which splits treats together.", ("stretch", "stretches"),
         lesson="17_splitting"),
    Term("coverage", "The share of the returns that lie on a line.", ("coverage",), lesson="07_epsilon"),
    Term("dropout", "One beam or several in a row without a return.", ("dropout", "dropouts"),
         lesson="11_doorway"),
    *_thresholds(),
)  # fmt: skip
