"""What the lessons say is so: each sentence with a number or a comparison is filled from the trace, or claimed here."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from lineseg_app.shelf.lesson import NamedLesson
from lineseg_app.shelf.lesson_goals import solves
from lineseg_app.shelf.lesson_numbers import PLACEHOLDER, trace_by
from lineseg_app.shelf.lessons import lesson_files, scan_of
from taught import taught

from lineseg import Params, Scan, Trace, extract
from lineseg.simulate.drawing import Drawing
from lineseg.tracing.decisions import Decision

LESSONS = {lesson.id: lesson for lesson in taught().lessons}
CLAIMS: list[tuple[str, tuple[str, ...], Callable[[], object]]] = []
COUNTED = re.compile(
    r"\d|\b(two|three|four|five|six|seven|eight|nine|ten|half|twice|none|all|nearly|hardly|most|every|"
    r"\w+er than|less than|more|fewer|below|enough|nearer|earlier|later|longer|shorter|farther|"
    r"smaller|larger|last|no (?:line|point))\b",
    re.IGNORECASE,
)
# Where the paper has something.
REFERENCE = re.compile(r" \((?:Eq|Fig|Table)s?\.?[^)]*\)")
# Rules of the method, advice, and what is asked of the reader: nothing that a scan could contradict.
RULES = (
    "One line is fitted through all points of both",
    "Which threshold decides whether two lines are",
    "Find out why a point of the wall is in no line",
    "Grey points are in no line",
    "It never looks at all points at once",
    "Find a window that was refused by δ",
    "the distance to the nearest obstacle",
    "Two seeds give two pieces of wall",
    "If only the distance to the line (ε) were checked",
    "So the smaller the angle, the stricter the check",
    "at an ever smaller angle",
    "with points on both surfaces becomes a seed",
    "Both lie on the same beam",
    "with each point the line gets longer and has more points",
    "Later points are not tried, even if they would fit",
    "the overlap is resolved later",
    "Use “by line” to move",
    "so they are the same wall",
    "Two walls meet at a",
    "The shared points are compared with both lines, one after another",
    "The points before the cut go to the first line",
    "If all shared points are nearer",
    "Like all points they are noisy",
    "An endpoint cannot be better than the last accepted point",
    "Endpoints are the last decisions",
    "S_num = {seed_points}. A seed must now be",
    "A distant wall has few points",
    "So whether a wall has P_min points",
    "more than you want in a map",
    "Change one threshold so that",
    "Or limit how much",
    "But this has a cost",
    "It does the same with both halves",
    "takes all points of a stretch",
    "Finally it merges",
    "splitting looks at all points of a stretch again",
    "Make it go wrong: join the two pieces",
    "too far, along its beam, from the place where this beam meets the line",
    "This is a later window",
    "Noise turns the lines of one straight wall by far less",
    "because glass and black surfaces often give none",
    "Every point has such an answer",
    "If it is too large",
    "different things become one line",
    "Over {seed_points} points a gentle curve",
    "The paper does not say",
    "The formula gives the foot",
    "The lower left chart",
    "Every line begins with a few neighbouring points",
    "or at its button",
    "Overlapping lines with nearly the same direction are merged into one",
    "Where two walls meet, the points near the corner fit both",
    "the first points of a line limit which later points can join",
    "the one of most textbooks",
    "and both lines follow",
    "“Turn the wall by 30°” again",
    "the steeper the wall, the farther it turns away",
    "A laser sees walls of every direction",
    "Compare both distances in the sentence below",
    "By definition, no other line has a smaller rms distance across itself",
    "when all points are turned, it turns with them",
    "How far would beam 512 be",
    "it must be larger than the noise",
    "The picture below shows the noise",
    "stands back by less than ε is taken for the wall",
    "[Lesson 7](lesson:07_epsilon)",
    "The sentence below the picture says how many",
    "You say which lines there are, in ten frames",
    "if they share more than half of all their points",
    "found in two pieces is one match and one false line",
    "The paper did that in ten frames of each recording",
    "click each line that is no wall, or only a second piece of one",
    "if no line lies on it and it is long and straight, a wall was missed",
    "people disagree about short pieces, and so do the numbers",
    "the other begins with *all* points",
    "draws a line through the two ends of a stretch",
    "because only the two ends define it",
    "then fits each stretch to all of its points",
    "[lesson 12](lesson:12_split_and_merge) looks at it",
    "with a line fitted to all points so far",
    "Splitting decides from the two ends",
    "on two recordings: 0.445 ms against 6.762 ms for a frame, and 0.329 ms against 5.193 ms",
    "instead of being computed anew from all points",
    "both methods may be fast enough",
    "About three times σ is a good beginning",
    "about three times its noise is a good beginning",
    "It tests each next point against the line so far",
    "Splitting looks at all points of a stretch again",
    "A line goes through any two points, so two say nothing",
    "there is only one next point to compare, instead of all others",
    "In the paper δ is larger than ε",
    "Why is δ larger than ε",
    "but lets seeds cross larger steps ([lesson 2](lesson:02_delta))",
    "[Lesson 7](lesson:07_epsilon) shows what that means",
    "Growth does not stop at the seam",
    "its first beam has a higher number than its last",
    "into two pieces, at a place that depends on how the laser is mounted",
    "The second text shows that it does not",
    "each point votes for all lines through it, and the line with the most votes",
)


def claim(lesson: str, *quoted: str) -> Callable[[Callable[[], object]], Callable[[], object]]:
    """Registers a check of sentences of a lesson; quoted: a part of each, as it is written in the file."""

    def register(check: Callable[[], object]) -> Callable[[], object]:
        CLAIMS.append((lesson, quoted, check))
        return check

    return register


@cache
def written(lesson: str) -> str:
    (file,) = (file for file in lesson_files() if file.stem == lesson)
    told = json.loads(file.read_text("utf-8"))
    texts = [told["about"], *(step["text"] for step in told["steps"])]
    answers = [option[part] for option in told["task"].get("choice", ()) for part in ("text", "why") if part in option]
    return "\n".join([*texts, *(told["task"][part] for part in ("text", "hint", "done")), *answers])


@cache
def at(lesson: str) -> Scan:
    return scan_of(LESSONS[lesson])


def params_of(lesson: str, **changed: float) -> Params:
    return Params().but(**LESSONS[lesson].params).but(**changed)


@cache
def traced(lesson: str, **changed: float) -> Trace:
    return trace_by(at(lesson), "region-growing", params_of(lesson, **changed))


def decisions(lesson: str, kind: str, check: str | None = None, **changed: float) -> list[Decision]:
    return [d for d in traced(lesson, **changed) if d.kind == kind and check in (None, d.check)]


def aside(scan: Scan, line: tuple[float, float, float], beams: range | list[int]) -> np.ndarray:
    return np.abs(scan.xy[beams] @ np.array(line[:2]) + line[2])


def window(decision: Decision) -> range:
    return range(decision.first, decision.last + 1)


def lines(lesson: str, **changed: float) -> list[tuple[int, int]]:
    return [(line.first, line.last) for line in traced(lesson, **changed).extraction.segments]


def right(lesson: str, **changed: float) -> bool:
    return solves(LESSONS[lesson].task.goal, extract(at(lesson), params_of(lesson, **changed)))


@claim("01_seed", "all {seed_points} lie almost exactly on it")
def _():
    first = decisions("01_seed", "seed found")[0]
    assert first.first == np.flatnonzero(at("01_seed").valid)[0]
    assert aside(at("01_seed"), first.line, window(first)).max() < 0.5 * params_of("01_seed").epsilon


@claim("01_seed", "farther than ε = {limit}")
def _():
    refused = decisions("01_seed", "seed rejected", "epsilon")[0]
    assert refused.value > refused.limit == params_of("01_seed").epsilon


@claim("01_seed", "There are {delta.count} of them, all between the two seeds")
def _():
    first, second = decisions("01_seed", "seed found")
    assert all(first.index < d.index < second.index for d in decisions("01_seed", "seed rejected", "delta"))


@claim(
    "01_seed",
    "It is also farther from the line than ε",
    "One point lies farther along its beam",
)
def _():
    scan = at("01_seed")
    for refused in decisions("01_seed", "seed rejected", "delta"):
        assert refused.value > params_of("01_seed").delta
        assert aside(scan, refused.line, [refused.beam])[0] > params_of("01_seed").epsilon


@claim("01_seed", "in the rough patch no window does")
def _():
    found = decisions("01_seed", "seed found")
    assert [d.first for d in found] == [4, 63]
    wall = at("01_seed").wall
    assert (wall[51:63] < 0).all()
    assert {d.first for d in decisions("01_seed", "seed rejected")} >= set(range(51, 63))


@claim("02_delta", "|ρ − ρ′| is never smaller than d")
def _():
    for refused in decisions("02_delta", "seed rejected", "delta"):
        assert refused.value > aside(at("02_delta"), refused.line, [refused.beam])[0]


@claim("02_delta", "Between 8.6 m and 12 m a door leaf stands 45 mm back")
def _():
    leaf = at("02_delta").xy[at("02_delta").wall == 2]
    assert leaf[:, 0].min() > 8.6
    assert leaf[:, 0].max() < 12
    assert np.median(leaf[:, 1]) - 1.0 == pytest.approx(0.045, abs=0.003)


@claim("02_delta", "No point is farther than ε = {epsilon}")
def _():
    shown = decisions("02_delta", "seed rejected", "delta")[2]
    assert aside(at("02_delta"), shown.line, window(shown)).max() < params_of("02_delta").epsilon
    assert set(at("02_delta").wall[window(shown)].tolist()) == {1, 2}


@claim(
    "02_delta",
    "a point can be close to a line",
    "more than δ = {limit}",
)
def _():
    shown = decisions("02_delta", "seed rejected", "delta")[2]
    assert shown.value > shown.limit > params_of("02_delta").epsilon


@claim(
    "02_delta",
    "fewer than P_min = {min_points}, so both were dropped",
    "no line joins the door leaf with the wall",
    "so is the wall at the end",
)
def _():
    wall = at("02_delta").wall
    assert [set(wall[first : last + 1].tolist()) for first, last in lines("02_delta")] == [{0}, {3}]
    dropped = {(d.first, d.last) for d in decisions("02_delta", "line dropped")}
    assert [set(wall[first : last + 1].tolist()) for first, last in sorted(dropped)] == [{1}, {2}]


@claim(
    "02_delta",
    "Twice its value is enough",
    "the whole door leaf (beams {leaf.first} to {leaf.last})",
)
def _():
    assert right("02_delta", delta=2 * params_of("02_delta").delta)
    for delta in (0.2, 0.3, 1.0):
        wall = at("02_delta").wall
        assert right("02_delta", delta=delta)
        crossing = [set(wall[window(d)].tolist()) for d in decisions("02_delta", "seed found", delta=delta)]
        assert any(len(walls) > 1 for walls in crossing)
    assert np.flatnonzero(at("02_delta").wall == 2).tolist() == list(range(20, 27))


@claim("03_growth", "the middle part stands 0.5 m farther back")
def _():
    xy, wall = at("03_growth").xy, at("03_growth").wall
    assert np.median(xy[wall == 2][:, 1]) - np.median(xy[wall == 0][:, 1]) == pytest.approx(0.5, abs=0.02)


@claim(
    "03_growth",
    "is less than ε = {limit}, so it joins",
    "beam {beam} is the first point that is not near the line",
)
def _():
    added = next(d for d in traced("03_growth") if d.kind == "point added" and d.direction == 1)
    stopped = next(d for d in traced("03_growth") if d.kind == "growth stopped" and d.direction == 1)
    assert added.value < added.limit <= stopped.value
    assert at("03_growth").wall[stopped.beam - 1 : stopped.beam + 1].tolist() == [0, 1]


@claim(
    "03_growth",
    "Noise easily turns a line through few points; each point that joins makes its direction surer",
)
def _():
    kept = decisions("03_growth", "line kept")[0]
    at_seed = decisions("03_growth", "seed found")[0]
    later = [d for d in decisions("03_growth", "point added") if d.candidate == kept.candidate][1:]
    first, *others = (abs(d.line[0] * kept.line[1] - d.line[1] * kept.line[0]) for d in (at_seed, *later))
    assert first > max(others)
    assert first > 2 * np.mean(others)


@claim(
    "03_growth", "each of its points is nearer to the line of the first wall than ε", "points between them do not fit"
)
def _():
    wall, kept = at("03_growth").wall, decisions("03_growth", "line kept")[0]
    beyond, between = (aside(at("03_growth"), kept.line, np.flatnonzero(wall == each).tolist()) for each in (4, 2))
    assert beyond.max() < params_of("03_growth").epsilon < between.min()
    assert not set(wall[kept.first : kept.last + 1].tolist()) & {2, 4}


@claim(
    "03_growth",
    "It needs at least P_min = {min_points} points",
    "This line has {points} points",
)
def _():
    kept = decisions("03_growth", "line kept")[0]
    assert kept.points >= params_of("03_growth").min_points
    assert kept.value >= params_of("03_growth").min_length


@claim(
    "03_growth",
    "the second kept line (the back of the niche)",
    "still closer than ε",
)
def _():
    kept = decisions("03_growth", "line kept")[1]
    assert (at("03_growth").wall[kept.first : kept.last + 1] == 2).mean() > 0.9
    wall = at("03_growth").wall
    assert wall[99:103].tolist() == [2, 2, 3, 3]
    assert aside(at("03_growth"), kept.line, [101])[0] < params_of("03_growth").epsilon


@claim("04_collinear", "just over ε = {limit}")
def _():
    stopped = decisions("04_collinear", "growth stopped", "epsilon")[0]
    assert stopped.limit <= stopped.value < 1.1 * stopped.limit
    assert stopped.points < 0.4 * at("04_collinear").valid.sum()


@claim(
    "04_collinear",
    "so both lines now share points",
    "smaller than α_merge = {merge_angle}",
)
def _():
    one, two = decisions("04_collinear", "line kept")
    assert two.first < one.last < two.last
    (merged,) = decisions("04_collinear", "lines merged")
    assert merged.value < merged.limit


@claim(
    "04_collinear",
    "the two lines would not have met",
    "Without merging, the wall would have been cut in two",
    "It should give one line",
    "One wall, one line",
)
def _():
    (one, *_), second = decisions("04_collinear", "line kept"), decisions("04_collinear", "seed found")[1]
    assert second.first > one.last
    assert len(lines("04_collinear", merge_angle=0.0)) == 2
    assert len(lines("04_collinear")) == len(set(at("04_collinear").wall[at("04_collinear").valid].tolist())) == 1


@claim(
    "04_collinear",
    "A slightly smaller ε works, too",
    "the wall stays in two pieces",
    "Two lines for one wall",
)
def _():
    assert right("04_collinear", epsilon=0.025)
    assert right("04_collinear", merge_angle=0.0)


@claim(
    "05_corner",
    "their directions differ by 15°",
    "more than α_merge = {limit}, so they stay two lines",
)
def _():
    (apart,) = decisions("05_corner", "lines kept apart")
    assert np.degrees(apart.value) == pytest.approx(15, abs=0.5)
    assert apart.value > apart.limit


@claim(
    "05_corner",
    "less than ε = {limit} away from the first line",
    "the points from beam {two.first} to beam {one.last} belong to both lines",
)
def _():
    one, two = decisions("05_corner", "line kept")
    assert set(at("05_corner").wall[[one.last, two.first]].tolist()) == {0, 1}
    assert at("05_corner").wall[one.last] == 1
    assert at("05_corner").wall[two.first] == 0
    assert one.last - two.first >= 4


@claim("05_corner", "each point was measured on one wall only", "turn each line a little away from its own wall")
def _():
    grown = [kept.line for kept in decisions("05_corner", "line kept")]
    refitted = [d.line for d in decisions("05_corner", "endpoints")]
    off = 0.0
    for wall, (before, after) in enumerate(zip(grown, refitted, strict=True)):
        own = line_through(at("05_corner").xy[at("05_corner").wall == wall])
        before_off, after_off = (abs(line[0] * own[1] - line[1] * own[0]) for line in (before, after))
        assert after_off < 1e-9
        off = max(off, before_off)
    assert np.degrees(off) > 0.1


@claim(
    "05_corner",
    "at the first point that is not nearer to the first line",
    "All shared points before beam {cut.beam} are nearer to the first line",
    "Select the first point of the second line (the left one) after the cut",
)
def _():
    (cut,) = decisions("05_corner", "overlap cut")
    one, two = decisions("05_corner", "line kept")
    shared = range(two.first, one.last + 1)
    first, second = (aside(at("05_corner"), kept.line, shared) for kept in (one, two))
    assert (first < second).tolist() == [beam < cut.beam for beam in shared]
    assert LESSONS["05_corner"].task.goal.selected == (cut.beam,)
    assert lines("05_corner")[1][0] == cut.beam


@claim(
    "06_endpoints",
    "lies {aside:mm} beside it",
    "the first point of this wall",
    "A segment has two ends",
)
def _():
    placed = decisions("06_endpoints", "endpoints")[1]
    assert placed.ends is not None
    foot = np.hypot(*(at("06_endpoints").xy[placed.first] - np.array(placed.ends[:2])))
    assert foot == pytest.approx(aside(at("06_endpoints"), placed.line, [placed.first])[0])
    assert foot > 0.02


@claim(
    "06_endpoints",
    "One decision is left: the endpoints of the other wall",
    "the wall on the right, before the rough patch",
)
def _():
    right_wall, left_wall = decisions("06_endpoints", "endpoints")
    assert left_wall.index == len(traced("06_endpoints")) - 1 == right_wall.index + 1
    assert at("06_endpoints").xy[right_wall.first, 0] > at("06_endpoints").xy[left_wall.last, 0]


@claim(
    "07_epsilon",
    "about one centimetre of noise",
    "ε = {epsilon} is smaller than the noise",
)
def _():
    fitted = traced("07_epsilon").extraction.segments
    scan = at("07_epsilon")
    rms = [np.sqrt(np.nanmean(aside(scan, line.line, range(line.first, line.last + 1)) ** 2)) for line in fitted]
    assert 0.006 < np.median(rms) < 0.015


@claim(
    "07_epsilon",
    "so {dropped.count} of them give lines that are too small",
    "Nearly everything is lost",
)
def _():
    assert (traced("07_epsilon", epsilon=0.006).extraction.labels >= 0).mean() < 0.05
    assert {d.check for d in decisions("07_epsilon", "line dropped", epsilon=0.006)} <= {"min_points", "min_length"}


@claim(
    "07_epsilon",
    "More points are covered, but the result is worse",
    "a door is set back by 12 cm",
    "the line runs between door and wall",
    "Now it is joined with the walls beside it",
    "Three surfaces have become one",
    "coverage alone",
    "joined with the wall before it (beam 200)",
)
def _():
    usual, wide = traced("07_epsilon").extraction, traced("07_epsilon", epsilon=0.15).extraction
    assert (wide.labels >= 0).sum() > (usual.labels >= 0).sum()
    assert wide.labels[200] == wide.labels[330] == wide.labels[430]
    wall, door = (np.nanmedian(at("07_epsilon").xy[beams, 1]) for beams in (range(100, 270), range(290, 380)))
    assert wall - door == pytest.approx(0.12, abs=0.01)
    heights = np.array([wide.segments[0].start[1], wide.segments[0].end[1]])
    assert ((door - 0.03 < heights) & (heights < wall + 0.03)).all()
    least, _ = LESSONS["07_epsilon"].accepted["epsilon"]
    labels = extract(at("07_epsilon"), params_of("07_epsilon", epsilon=least)).labels
    assert (labels >= 0).sum() > (usual.labels >= 0).sum()


@claim(
    "07_epsilon",
    "Half of the 12 cm is not enough",
    "If ε is too small, walls fall into pieces",
)
def _():
    assert not right("07_epsilon", epsilon=0.06)
    assert right("07_epsilon", epsilon=0.15)


@claim(
    "07_epsilon",
    "only {lines} lines are left",
    "Two walls far down the hallway are lost",
    "a point that is nearer to its line than ε can be farther from P′ than δ",
    "as small as ε",
    "A larger δ keeps such walls",
)
def _():
    epsilon, scan = params_of("07_epsilon").epsilon, at("07_epsilon")
    assert epsilon == 0.03
    labels = traced("07_epsilon", delta=epsilon).extraction.labels
    lost = [line for line in traced("07_epsilon").extraction.segments if (labels[line.first : line.last + 1] < 0).all()]
    assert [(line.first <= 580 <= line.last, line.first <= 593 <= line.last) for line in lost] == [
        (True, False),
        (False, True),
    ]
    assert len(lines("07_epsilon", delta=epsilon)) == len(lines("07_epsilon")) - 2
    for line in lost:
        assert np.nanmin(scan.ranges[line.first : line.last + 1]) > 5
        refused = [
            d
            for d in decisions("07_epsilon", "seed rejected", "delta", delta=epsilon)
            if line.first <= d.first and d.last <= line.last
        ]
        assert any(aside(scan, d.line, [d.beam])[0] < epsilon < d.value for d in refused)


@claim(
    "08_how_much",
    "All have P_min = {min_points} points or more",
    "there a few points span more than L_min",
    "Far away it is the other way round",
)
def _():
    usual = params_of("08_how_much")
    small = [line for line in traced("08_how_much", min_length=0.1).extraction.segments if line.length < 0.3]
    assert small
    assert all(line.points >= usual.min_points for line in small)
    few = [line for line in traced("07_epsilon", min_points=3).extraction.segments if line.points < usual.min_points]
    assert few
    assert all(line.length > usual.min_length for line in few)
    near, far = (
        np.median([np.nanmedian(at(of).ranges[line.first : line.last + 1]) for line in each])
        for of, each in (("08_how_much", small), ("07_epsilon", few))
    )
    assert near < far


@claim(
    "08_how_much",
    "{lines} lines are left, as before",
    "almost anything passes as a seed",
    "A small S_num mostly costs time",
    "Three thresholds decide",
)
def _():
    assert len(lines("08_how_much", seed_points=3)) == len(lines("08_how_much"))
    assert len(traced("08_how_much", seed_points=3)) > 1.5 * len(traced("08_how_much"))
    assert {d.check for d in decisions("08_how_much", "line dropped", seed_points=3)} <= {"min_points", "min_length"}
    seeds, refused = (decisions("08_how_much", kind, seed_points=3) for kind in ("seed found", "seed rejected"))
    assert len(seeds) > len(refused)


@claim("08_how_much", "Walls with fewer points, short or distant ones, are lost")
def _():
    left = lines("08_how_much", seed_points=20)
    usual = traced("08_how_much").extraction.segments
    lost = [line for line in usual if not any(a <= line.last and line.first <= b for a, b in left)]
    assert len(lost) == len(usual) - len(left) > 0
    assert all(line.points < 20 for line in lost)


@claim("08_how_much", "however long it is, so it is dropped")
def _():
    left = {line.first for line in traced("08_how_much", min_points=40).extraction.segments}
    usual = traced("08_how_much").extraction.segments
    lost = [line for line in usual if line.points < 40 and line.first not in left]
    assert max(line.length for line in lost) > 1.3
    assert min(line.length for line in usual if line.points >= 40) < 1.0


@claim(
    "08_how_much",
    "the shortest {shortest:cm} long",
    "No line that was found in this room is so long, so none is left",
    "there are more than 20 lines",
)
def _():
    assert len(lines("08_how_much", min_length=0.1)) > 20
    assert lines("08_how_much", min_length=2.0) == []
    assert set(LESSONS["08_how_much"].accepted) == {"min_length"}


@claim(
    "09_shallow",
    "their directions differ by only 4°",
    "less than the merge angle, become one line",
    "is less than α_merge = {merge_angle}",
    "The result is one line through both",
    "the two lines share points",
)
def _():
    xy, wall = at("09_shallow").xy, at("09_shallow").wall
    slopes = [np.polyfit(*xy[wall == each].T, 1)[0] for each in (0, 1)]
    assert np.degrees(np.ptp(np.arctan(slopes))) == pytest.approx(4, abs=0.3)
    assert np.radians(4) < params_of("09_shallow").merge_angle
    (merged,) = decisions("09_shallow", "lines merged")
    assert merged.value < merged.limit
    assert len(lines("09_shallow")) == 1


@claim("09_shallow", "it lies about 5 cm beside the walls")
def _():
    (line,) = traced("09_shallow").extraction.segments
    assert aside(at("09_shallow"), line.line, [line.first, line.last]) == pytest.approx(0.05, abs=0.005)


@claim(
    "09_shallow",
    "α_merge must be below it",
    "set γ_merge to its default, 1.2",
    "as in lesson 4",
    "two walls become two lines",
    "can tell these two cases apart",
)
def _():
    (merged,) = decisions("09_shallow", "lines merged")
    assert Params().merge_rms == 1.2
    assert right("09_shallow", merge_rms=1.2)
    assert right("09_shallow", merge_angle=0.95 * merged.value)
    assert not right("09_shallow", merge_angle=1.05 * merged.value)
    assert list(LESSONS)[3] == "04_collinear"
    assert len(lines("04_collinear", merge_rms=1.2)) == 1


@claim(
    "10_curve",
    "The straight wall is found",
    "one chord after another: {lines} lines in all",
    "Each chord passes every check",
    "There is a straight wall on the right, then a round one",
)
def _():
    wall = at("10_curve").wall
    walls = [set(wall[first : last + 1].tolist()) for first, last in lines("10_curve")]
    assert 0 in walls[0]
    assert walls[1:] == [{-1}] * (len(walls) - 1)
    assert at("10_curve").xy[wall == 0, 0].min() > 2


@claim("10_curve", "until the curve is ε = {limit} away from it")
def _():
    assert all(d.value >= d.limit for d in decisions("10_curve", "growth stopped", "epsilon"))


@claim(
    "10_curve",
    "every chord is gone and the straight wall is kept",
    "a real wall that is as short",
)
def _():
    assert right("10_curve", min_length=2.0)
    assert right("10_curve", min_points=30)
    assert right("10_curve", min_length=0.9)


@claim(
    "11_doorway",
    "The two pieces lie on the same line but share no point",
    "The doorway is {value} beams wide",
    "{stop.value} beams in a row have no return",
    "join the two pieces to one line across the open doorway",
    "Now it is one line",
)
def _():
    stopped = decisions("11_doorway", "growth stopped", "max_dropout")[0]
    assert stopped.value > stopped.limit == params_of("11_doorway").max_dropout
    first, second = traced("11_doorway").extraction.segments
    assert first.last < second.first
    assert np.abs(np.dot(first.line[:2], second.line[:2])) > 0.9999
    assert right("11_doorway", max_dropout=int(stopped.value))
    assert not right("11_doorway", max_dropout=int(stopped.value) - 1)


@claim(
    "12_split_and_merge",
    "well before the corner",
    "less than L_min = {left.limit}, and was dropped",
    "was the point farthest from the line between the two ends",
    "loses a point at each split: the one before the split, and later the last one of a second part",
)
def _():
    split = trace_by(at("12_split_and_merge"), "split-and-merge", Params())
    back = np.flatnonzero(at("12_split_and_merge").wall == 2)
    middle = split.extraction.segments[1]
    xy = at("12_split_and_merge").xy
    assert np.hypot(*(xy[back[-1]] - xy[middle.last])) > 0.5
    assert lines("12_split_and_merge")[1][1] >= back[-1]
    assert split[0].kind == "farthest point"
    assert (split[0].first, split[0].last) == (10, 130)
    (left,) = (d for d in split if d.kind == "line dropped" and d.first == split[0].beam)
    assert left.value < left.limit
    assert set(at("12_split_and_merge").wall[left.first : left.last + 1].tolist()) == {2}
    parts = [(d.first, d.last) for d in split if d.kind == "farthest point"]
    at_ninety, at_forty_one = parts[:2]
    # The point before the split, then the last one of the second part.
    assert (at_forty_one[1], middle.last) == (split[0].beam - 2, at_forty_one[1] - 1)
    assert at_ninety[0] == at_forty_one[0]


@claim(
    "12_split_and_merge",
    "It does not split a wall in the middle at a noisy point",
    "It tests each point in turn, up to the very last",
)
def _():
    assert len(lines("12_split_and_merge")) == 3


@claim("12_split_and_merge", "beams 34 to 38 and 102 to 106")
def _():
    outside = at("12_split_and_merge").valid & (traced("12_split_and_merge").extraction.labels < 0)
    assert tuple(np.flatnonzero(outside).tolist()) == LESSONS["12_split_and_merge"].task.goal.selected
    assert np.flatnonzero(outside).tolist() == [*range(34, 39), *range(102, 107)]


@claim(
    "12_split_and_merge",
    "gets votes from the wall beyond the niche as well",
    "Here this gives the same {lines} lines as region growing",
    "each point votes for 180 directions",
)
def _():
    made = trace_by(at("12_split_and_merge"), "hough", Params())
    of_method = [(line.first, line.last) for line in made.extraction.segments]
    assert of_method == lines("12_split_and_merge")
    assert 180 / made.params.numbers()["theta_step_deg"] == 180
    wall = at("12_split_and_merge").wall
    votes = [d.value for d in made if d.kind == "peak found" and d.first == of_method[0][0]]
    assert votes == [np.isin(wall, (0, 4)).sum()]


@claim(
    "13_least_squares",
    "has an upright wall and a level one, and both are found",
)
def _():
    upright, level = (line.line for line in traced("13_least_squares").extraction.segments)
    assert max(abs(upright[1]), abs(level[0])) < 1e-3


@claim(
    "14_without_it",
    "more than ε = {limit}, so growth stops",
    "only {joined} from the line: less than ε",
    "ε = {epsilon} lies between",
    "The farther away the candidate is, the more it turns a short line",
)
def _():
    scan, epsilon = at("14_without_it"), params_of("14_without_it").epsilon
    stops = {d.beam: d for d in decisions("14_without_it", "growth stopped", "epsilon") if d.direction == 1}
    near, far = stops[512], stops[642]
    for stop in (near, far):
        with_it = line_through(scan.xy[[*window(stop), stop.beam]])
        assert aside(scan, with_it, [stop.beam])[0] < epsilon < stop.value
        assert aside(scan, stop.line, [stop.beam])[0] == pytest.approx(stop.value)
    turns = [turned_by(scan, stop) for stop in (near, far)]
    assert turns[0] < turns[1]


def line_through(xy: np.ndarray) -> tuple[float, float, float]:
    normal = np.linalg.svd(xy - xy.mean(axis=0))[2][1]
    return float(normal[0]), float(normal[1]), -float(normal @ xy.mean(axis=0))


def turned_by(scan: Scan, stop: Decision) -> float:
    with_it = line_through(scan.xy[[*window(stop), stop.beam]])
    return abs(stop.line[0] * with_it[1] - stop.line[1] * with_it[0])


@claim(
    "15_laser", "Three walls and a pillar", "Set ε so that each of the three walls is one line", "about three times σ"
)
def _():
    sigma, (low, _) = 0.02, LESSONS["15_laser"].accepted["epsilon"]
    assert 2 * sigma < low < 3.5 * sigma
    assert right("15_laser", epsilon=3.2 * sigma)


@claim(
    "15_laser",
    "about one in three lies farther from its wall than σ, one in twenty farther than 2 σ",
)
def _():
    beyond = [math.erfc(times / math.sqrt(2)) for times in (1, 2, 3)]
    assert [round(1 / share) for share in beyond] == [3, 22, 370]


@claim("16_correctness", "with six true lines in each, a single line changes TR by 1.7 %")
def _():
    assert pytest.approx(1.7, abs=0.05) == 100 / (10 * 6)


@claim("17_splitting", "Both drop short lines")
def _():
    for method in ("iterative-end-point-fit", "split-and-merge"):
        made = trace_by(at("17_splitting"), method, Params())
        assert any(d.kind == "line dropped" for d in made)


@claim("17_splitting", "Step through both until the end. Why does region growing not lose the end of the niche?")
def _():
    wall = at("17_splitting").wall
    back = np.flatnonzero(wall == 2)
    assert lines("17_splitting")[1][1] >= back[-1]


@claim("18_time", "A second has 1000 ms", "40 scans a second")
def _():
    assert LESSONS["18_time"].task.number.answer == f"{1000 / 40:g} ms"


@claim(
    "19_seam",
    "the last one is next to beam 0",
    "The place between the two is the seam",
    "After the last beam comes beam {beam}",
    "turned by 40°",
    "The wall at the seam is cut in two",
    "less than ε = {limit}, so it joins",
    "and nothing else",
    "the same four walls are found",
    "The room has as many walls as before",
    "More walls are found",
    "no line ends where the numbers begin",
)
def _():
    scan = at("19_seam")
    assert scan.full_circle
    here = traced("19_seam").extraction.segments
    assert len(here) == 4
    turned = Drawing.parse(LESSONS["19_seam"].recording.removeprefix("drawn:").replace("l0,0,0", "l0,0,40"))
    there = extract(turned.recording()[0], params_of("19_seam")).segments
    n = len(scan)
    assert {((line.first - 40) % n, (line.last - 40) % n) for line in here} == {(s.first, s.last) for s in there}
    assert any(line.first > line.last for line in here)


@pytest.mark.parametrize(("lesson", "quoted", "check"), CLAIMS, ids=[f"{of}: {quoted[0]}" for of, quoted, _ in CLAIMS])
def test_what_a_lesson_claims_is_true(lesson: str, quoted: tuple[str, ...], check: Callable[[], object]):
    for each in quoted:
        assert each in written(lesson), "the sentence has changed: so must its check"
    check()


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_sentence_with_a_number_or_a_comparison_is_filled_or_claimed(lesson: str):
    quotes = [each for of, quoted, _ in CLAIMS if of == lesson for each in quoted] + list(RULES)
    unfounded = [
        sentence
        for sentence in re.split(r"(?<=[.!?])\s+", REFERENCE.sub("", written(lesson)))
        if COUNTED.search(re.sub(r"\w+_\w+", "", PLACEHOLDER.sub("", sentence)))
        and not any(quoted in sentence for quoted in quotes)
    ]
    assert unfounded == []


def test_every_rule_is_still_in_a_lesson():
    assert [rule for rule in RULES if not any(rule in REFERENCE.sub("", written(lesson)) for lesson in LESSONS)] == []


def test_a_name_that_is_the_number_of_a_beam_is_at_that_beam():
    named = [
        each for lesson in LESSONS.values() for part in (*lesson.steps, lesson.task) for each in part.names.items()
    ]
    numbered = [(int(found[1]), beam) for words, beam in named if (found := re.fullmatch(r"beam (\d+)", words))]
    assert len(numbered) > 5
    assert [pair for pair in numbered if pair[0] != pair[1]] == []


def test_the_named_beams_of_lesson_12_are_those_of_its_text():
    texts = {words for words in LESSONS["12_split_and_merge"].steps[1].names if words.startswith("beam")}
    told = LESSONS["12_split_and_merge"].steps[1].text
    assert all(words in told for words in texts)


@pytest.mark.parametrize("lesson", LESSONS.values(), ids=lambda lesson: lesson.id)
def test_what_a_step_frames_holds_the_point_it_speaks_of(lesson: NamedLesson):
    for step in lesson.steps:
        if step.near and step.find:
            shown = [d for d in traced(lesson.id, **step.params) if d.kind == step.find.kind]
            assert any(d.beam in step.near or d.first in step.near or d.last in step.near for d in shown)
            assert at(lesson.id).valid[list(step.near)].any()
