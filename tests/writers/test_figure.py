"""A drawing shows the result to scale."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import scans, wall_ahead

from lineseg import Params, Reading, Scan, extract, figure_svg
from lineseg.colours import segment_colours
from lineseg.writers.figure import HEIGHT, WIDTH, bar_length

SVG = "{http://www.w3.org/2000/svg}"


def drawn(scan, title=""):
    return ET.fromstring(figure_svg(scan, extract(scan), title))


def length_of(line):
    return np.hypot(*(float(line.get(f"{axis}2")) - float(line.get(f"{axis}1")) for axis in "xy"))


@given(scans())
def test_every_point_and_segment_is_in_the_picture(scan):
    root = drawn(scan)
    path = root.find(f"{SVG}path[@class='points']").get("d")
    spots = np.array(re.findall(r"M(\S+) (\S+)h0", path), float).reshape(-1, 2)
    assert len(spots) == np.count_nonzero(scan.valid)
    assert ((spots >= 0) & (spots <= (WIDTH, HEIGHT))).all()
    assert len(root.findall(f"{SVG}line")) == len(extract(scan).segments)


def test_the_bar_and_the_segments_have_one_scale():
    scan = wall_ahead()
    (line,) = drawn(scan).findall(f"{SVG}line")
    bar = drawn(scan).find(f"{SVG}path[@class='bar']").get("d")
    pixels = float(re.search(r"h(\S+)v", bar)[1])
    metres = float(next(text.text for text in drawn(scan).iter(f"{SVG}text")).removesuffix(" m"))
    assert length_of(line) / extract(scan).segments[0].length == pytest.approx(pixels / metres, rel=0.01)


def test_y_points_upward():
    (line,) = drawn(wall_ahead()).findall(f"{SVG}line")
    start, end = extract(wall_ahead()).segments[0].start, extract(wall_ahead()).segments[0].end
    assert (start[1] < end[1]) == (float(line.get("y1")) > float(line.get("y2")))


def test_the_legend_counts_and_the_title_is_text():
    texts = [each.text for each in drawn(wall_ahead(), "a < b & c").iter(f"{SVG}text")]
    assert texts[1:] == ["180 points, 180 in segments", "1 segment", "laser", "a < b & c"]


def test_a_scan_without_points_gives_a_picture():
    assert drawn(Scan(np.full(3, np.nan), np.zeros(3))).find(f"{SVG}line") is None


@given(st.floats(1e-3, 1e4))
def test_the_bar_is_a_round_length_that_fits(most):
    length = bar_length(most)
    assert most / 2.6 < length <= most * (1 + 1e-6)
    assert round(length / 10 ** np.floor(np.log10(length * (1 + 1e-9))), 6) in (1, 2, 5)


def test_the_drawing_carries_the_thresholds_and_the_colours_of_its_legend():
    scan = wall_ahead()
    drawing = figure_svg(scan, extract(scan), "wall.csv", Params(epsilon=0.042))
    assert "ε\u00a0=\u00a00.042\u00a0m" in drawing
    assert "read with" not in drawing
    given = figure_svg(scan, extract(scan), "wall.csv", reading=Reading(unit="mm", angle_min=-1.5))
    assert "read with --unit mm --angle-min=-1.5" in given
    red, green, blue = segment_colours(extract(scan).segments)[0]
    # Of the segment, and of the legend.
    assert drawing.count(f"rgb({red} {green} {blue})") == 2
