"""The method again, slow, literal, and independent of the kernels. The tests compare the kernels with it.

Positions count the valid points in scan order; on a full circle they continue past the seam in both directions.
"""

from __future__ import annotations

import numpy as np

from lineseg import Params, Scan


def extract(scan: Scan, params: Params) -> list[tuple[int, int]]:
    """(first, last) beam of each segment, sorted."""
    method = RegionGrowing(scan, params)
    return sorted((method.beam(first), method.beam(last)) for first, last in method.lines())


class RegionGrowing:
    def __init__(self, scan: Scan, params: Params) -> None:
        self.beams = [k for k in range(len(scan)) if scan.valid[k]]
        self.points = [
            scan.ranges[k] * np.array([np.cos(scan.bearings[k]), np.sin(scan.bearings[k])]) for k in self.beams
        ]
        self.n, self.width, self.params = len(self.beams), max(scan.around, len(scan)), params
        # A line may have crossed these steps, whatever was lost there: positions of the points before them.
        self.passed = set()
        self.circle = scan.full_circle and self.n >= 3
        if params.max_occluder > 0 and self.n > 2:
            self.look_past()
        if self.circle:
            gaps = [np.linalg.norm(self.points[(k + 1) % self.n] - self.points[k]) for k in range(self.n)]
            self.turn(int(np.argmax(gaps)) + 1)

    def turn(self, start):
        """Full circle only: start with another point."""
        self.points = self.points[start:] + self.points[:start]
        self.beams = self.beams[start:] + [k + self.width for k in self.beams[:start]]
        self.passed = {(k - start) % self.n for k in self.passed}

    def look_past(self):
        if self.circle:
            self.turn(int(np.argmax([np.linalg.norm(point) for point in self.points])))
        points = self.points + self.points[:1] * self.circle
        kept, k = [], 0
        while k < len(points):
            kept.append(k)
            behind = max((j for j in range(k + 2, len(points)) if self.is_thing(points, k, j)), default=k + 1)
            if behind > k + 1:
                self.passed.add(len(kept) - 1)
            k = behind
        if self.circle:
            kept.pop()
        self.points, self.beams, self.n = [points[k] for k in kept], [self.beams[k] for k in kept], len(kept)

    def is_thing(self, points, k, j):
        """Whether the points between k and j are a small thing in front of these two."""
        ahead, widest = max(self.params.delta, 2 * self.params.epsilon), self.params.max_occluder
        for end, beside in ((k, k + 1), (j, j - 1)):
            if np.linalg.norm(points[end]) - np.linalg.norm(points[beside]) <= ahead:
                return False
        chord = points[j] - points[k]
        if np.linalg.norm(chord) > widest:
            return False
        inner, long = points[k + 2 : j - 1], max(widest, self.params.min_length)
        many = j - k - 1 >= self.params.min_points
        if many and any(np.linalg.norm(point - inner[0]) > long for point in inner):
            return False
        normal = np.array([-chord[1], chord[0]])
        for point in points[k + 1 : j]:
            r = np.linalg.norm(point)
            predicted = r * (normal @ points[k]) / (normal @ point)
            if not predicted - r > max(ahead, 2 * self.epsilon(point)):
                return False
        return True

    def epsilon(self, point):
        """ε at the range of a point."""
        return np.hypot(self.params.epsilon, self.params.epsilon_growth * np.linalg.norm(point))

    def at(self, k):
        return self.points[k % self.n]

    def number(self, k):
        turns, k = divmod(k, self.n)
        return self.beams[k] + turns * self.width

    def beam(self, k):
        return self.number(k) % self.width

    def fit(self, first, last):
        xy = np.array([self.at(k) for k in range(first, last + 1)])
        centre = xy.mean(axis=0)
        normal = np.linalg.svd(xy - centre)[2][1]
        return normal, -normal @ centre

    def distance(self, k, line):
        return abs(line[0] @ self.at(k) + line[1])

    def step(self, k, j):
        return np.linalg.norm(self.at(j) - self.at(k))

    def joined(self, k, j):
        lost = abs(self.number(j) - self.number(k)) - 1 > self.params.max_dropout
        if lost and min(k, j) % self.n not in self.passed:
            return False
        return self.step(k, j) <= self.params.max_gap and not self.is_void(min(k, j))

    def is_void(self, k):
        """Whether the step from point k to the next is a void."""
        width, most = self.step(k, k + 1), self.params.max_void
        if not most or width <= most or k % self.n in self.passed:
            return False
        if self.number(k + 1) - self.number(k) > 1:
            return True
        chord = self.at(k + 1) - self.at(k)
        for here, beyond in ((k, k - 1), (k + 1, k + 2)):
            if self.circle or 0 <= beyond < self.n:
                step = self.at(beyond) - self.at(here)
                aside = abs(chord[0] * step[1] - chord[1] * step[0])
                straight = aside <= np.sqrt(8 * (chord @ chord + step @ step)) * self.epsilon(self.at(here))
                if straight and width <= 4 * np.linalg.norm(step):
                    return False
        return True

    def length(self, first, last, line):
        along = np.array([-line[0][1], line[0][0]])
        return abs(along @ (self.at(last) - self.at(first)))

    def is_seed(self, i):
        j = i + self.params.seed_points - 1
        if not all(self.joined(k, k + 1) for k in range(i, j)):
            return False
        normal, c = line = self.fit(i, j)
        for k in range(i, j + 1):
            point = self.at(k)
            bearing = point / np.linalg.norm(point)
            predicted = -c / (normal @ bearing) * bearing
            if np.linalg.norm(point - predicted) > self.params.delta or self.distance(k, line) > self.epsilon(point):
                return False
        return True

    def may_take(self, here, there, first, last):
        if not self.circle and not 0 <= there < self.n:
            return False
        if last - first + 1 >= self.n or not self.joined(here, there):
            return False
        return self.distance(there, self.fit(first, last)) < self.epsilon(self.at(there))

    def grow(self, first):
        last = first + self.params.seed_points - 1
        while self.may_take(last, last + 1, first, last):
            last += 1
        while self.may_take(first, first - 1, first, last):
            first -= 1
        return first, last

    def suffices(self, first, last):
        if last - first + 1 < max(2, self.params.min_points):
            return False
        return self.length(first, last, self.fit(first, last)) >= self.params.min_length

    def lines(self):
        params, n = self.params, self.n
        if n < params.seed_points or (self.circle and n < 2 * params.seed_points):
            return []
        found, i = [], 0
        stop = n if self.circle else n - max(params.min_points, params.seed_points) + 1
        while i < stop:
            if not self.is_seed(i):
                i += 1
                continue
            first, last = self.grow(i)
            if self.suffices(first, last):
                found.append((first, last))
            i = last + 1 if last - first + 1 >= params.min_points else i + 1
        return [line for line in self.cut(self.merge(found)) if self.suffices(*line)]

    def pairs(self, lines):
        """Neighbours (i, j, turn); on a full circle also the last and the first line, one turn later."""
        yield from ((i, i + 1, 0) for i in range(len(lines) - 1))
        if self.circle and len(lines) > 1:
            yield len(lines) - 1, 0, self.n

    def are_one(self, one, two):
        """Whether two neighbours become one line; positions of the second continue past the seam of a full circle."""
        if one == two:
            return True
        last, first, strict = one[1], two[0], self.params.merge_rms > 0
        touch = first <= last
        if strict and first - last - 1 <= self.params.max_dropout:
            touch = touch or all(self.joined(k, k + 1) for k in range(last, first))
        cross = np.cross(np.append(self.fit(*one)[0], 0), np.append(self.fit(*two)[0], 0))[2]
        if not touch or np.arcsin(min(1, abs(cross))) >= self.params.merge_angle:
            return False
        squares, points = (sum(of_each) for of_each in zip(self.squares(*one), self.squares(*two), strict=True))
        common, number = self.squares(*self.both(one, two))
        least = 0.1 * self.params.epsilon
        return not strict or np.sqrt(common / number) <= self.params.merge_rms * max(np.sqrt(squares / points), least)

    def both(self, one, two):
        first = min(one[0], two[0])
        return first, min(max(one[1], two[1]), first + self.n - 1)

    def squares(self, first, last):
        """Sum of the squared distances of these points to their line, and how many they are."""
        line = self.fit(first, last)
        return sum(self.distance(k, line) ** 2 for k in range(first, last + 1)), last - first + 1

    def merge(self, lines):
        lines = list(lines)
        i = 0
        while True:
            pair = next(((a, b, turn) for a, b, turn in self.pairs(lines) if a == i), None)
            if pair is None:
                return lines
            _, j, turn = pair
            other = lines[j][0] + turn, lines[j][1] + turn
            if self.are_one(lines[i], other):
                lines[i] = self.both(lines[i], other)
                del lines[j]
                if turn:
                    return lines
            else:
                i += 1

    def cut(self, lines):
        lines, fits, i = list(lines), [self.fit(*line) for line in lines], 0
        while (pair := next((p for p in self.pairs(lines) if p[0] == i), None)) is not None:
            _, j, turn = pair
            (m1, n1), (m2, n2) = lines[i], (lines[j][0] + turn, lines[j][1] + turn)
            shared = range(max(m1, m2), min(n1, n2) + 1)
            not_nearer = (k for k in shared if self.distance(k, fits[i]) >= self.distance(k, fits[j]))
            k = next(not_nearer, min(n1, n2) + 1)
            if shared and k in (m1, n2 + 1):
                swallowed = i if k == m1 else j
                del lines[swallowed], fits[swallowed]
                i = i - 1 if turn or i > 0 else 0
                continue
            if shared:
                lines[i], lines[j] = (m1, k - 1), (k - turn, lines[j][1])
                for line in (i, j):
                    if lines[line][1] > lines[line][0]:
                        fits[line] = self.fit(*lines[line])
            i += 1
        return lines
