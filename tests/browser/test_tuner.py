"""What fits the laser, sensitivity curves, the map of two thresholds, and auto-tuning, as a person uses them."""

from __future__ import annotations

import csv
import io
import re
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.__main__ import main
from lineseg_app.server import Settings
from live import Address, serving
from waiting import SECONDS

from lineseg import open_recording, save_npz
from lineseg.tuning import Trial, Tuning

SAMPLES = Path(__file__).parents[2] / "sample_scans"
# Trials, maps and curves of one test are not those of another.
pytestmark = pytest.mark.own_tab


@pytest.fixture(scope="module")
def thinned(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Two samples with every tenth frame: their curves and maps take a tenth of the time."""
    folder = tmp_path_factory.mktemp("thinned")
    files = folder / "hallway.npz", folder / "laboratory.npz"
    for file in files:
        whole = open_recording(SAMPLES / file.name)
        save_npz(whole.only(np.arange(0, len(whole), 10)), file)
    return files


@pytest.fixture(scope="module")
def address(thinned: tuple[Path, Path], tmp_path_factory: pytest.TempPathFactory) -> Iterator[Address]:
    with serving(Settings(files=thinned[:1], data_folder=tmp_path_factory.mktemp("data"))) as address:
        yield address


def curves_of(tab, note: str = "all 30 frames") -> None:
    said = tab.page.locator(".curves-note")
    tab.eventually(lambda: said.text_content() == note, f"the curves are not those of {note}")


def tuner(tab, part: str, condition: str) -> dict:
    """The state of `map` or `auto` for scripts, once it meets a condition."""
    return tab.found(f"const s = window.lineseg.tuner.{part}; if (s && ({condition})) return s;", condition)


def test_curves_stand_under_the_sliders_follow_them_and_can_be_clicked(tab):
    curves_of(tab)
    curve = tab.page.locator("[data-knob=epsilon] .curve")
    coverage = curve.locator("path[data-line=coverage]")
    delta = tab.page.locator("[data-knob=delta] path[data-line=coverage]")
    assert tab.page.locator(".curve:visible").count() == 5
    assert curve.locator("path[data-line=true_rate]").get_attribute("d")
    before, other = coverage.get_attribute("d"), delta.get_attribute("d")

    box = curve.bounding_box()
    mark = curve.locator(".curve-mark")
    place = float(mark.get_attribute("x1")) / 1000
    thumb = tab.slider("epsilon").evaluate("(input) => input.valueAsNumber / input.max")
    assert abs(place - thumb) < 0.005

    tab.page.mouse.click(box["x"] + 0.25 * box["width"], box["y"] + box["height"] / 2)
    epsilon = tab.until("s.params.epsilon < 0.02")["params"]["epsilon"]
    assert abs(epsilon - 0.005 * 100**0.25) < 0.001
    # The curve of ε stays what it is, that of δ belongs to another ε.
    tab.eventually(lambda: delta.get_attribute("d") != other, "the curve of δ stands still")
    curves_of(tab)
    assert coverage.get_attribute("d") == before

    key = tab.page.locator(".curve-key[data-line=coverage]")
    key.click()
    assert coverage.is_hidden()
    key.click()
    tab.page.get_by_role("button", name="Sensitivity").click()
    assert tab.page.locator(".curve:visible").count() == 0
    tab.page.get_by_role("button", name="Sensitivity").click()
    assert tab.page.locator(".curve:visible").count() == 5

    tab.choose_recording("Hallway (log)")
    tab.until("s.recording.endsWith('.log')")
    tab.eventually(
        lambda: tab.page.locator(".curve-key[data-line=true_rate]").is_hidden(), "rates are offered without truth"
    )


def test_what_is_hidden_is_not_computed_until_it_is_opened(new_tab):
    tab = new_tab("#mode=inspect")
    tab.page.locator(".frames-row").first.wait_for()
    assert tuner(tab, "fit", "true")["text"] == "Measuring how much the points scatter…"
    assert tab.page.locator(".curves-note").text_content() == ""
    tab.page.get_by_role("tab", name="Thresholds").click()
    curves_of(tab)
    tuner(tab, "fit", "s.text.includes('Points scatter by 10 mm here')")


def test_a_click_on_the_map_sets_both_thresholds(tab):
    curves_of(tab)
    tab.page.get_by_role("tab", name="Map").click()
    finest = tuner(tab, "map", "s.side === 25 && !s.running")
    assert (finest["measure"], finest["x"], finest["y"]) == ("f_score", "epsilon", "delta")
    assert all(height is not None for row in finest["heights"] for height in row)
    tab.page.get_by_label("Up", exact=True).select_option("min_length")
    tuner(tab, "map", "s.y === 'min_length' && s.side === 25 && !s.running")
    box = tab.page.locator(".map-canvas").bounding_box()
    tab.page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    params = tab.until("s.params.min_length > 1.4 && s.params.min_length < 1.6")["params"]
    assert 0.046 <= params["epsilon"] <= 0.054
    # The map spans these two: it need not be computed again.
    assert not tab.page.evaluate("() => window.lineseg.tuner.map.running")
    tab.page.keyboard.press("Control+z")
    tab.until("s.params.min_length === 0.6 && s.params.epsilon === 0.03")


def test_the_table_of_a_sweep_is_a_map_and_a_click_takes_its_setting(tab, thinned, tmp_path):
    files = [str(file) for file in thinned]
    axes = ["--epsilon", "0.02,0.03,0.05", "--delta", "0.05,0.1", "--min-points", "8,16"]
    assert main(["sweep", *files, *axes, "-o", str(tmp_path / "fleet.csv")]) == 0
    content = (tmp_path / "fleet.csv").read_text()
    curves_of(tab)
    tab.drop("fleet.csv", content)
    shown = tuner(tab, "map", "s.sweep === 'fleet.csv'")
    assert (shown["x"], shown["y"], shown["measure"]) == ("epsilon", "delta", "f_score")
    rows = list(csv.DictReader(io.StringIO(content)))
    scored = [(row["file"], float(row["epsilon"]), float(row["delta"]), float(row["f_score"])) for row in rows]

    def best(file, epsilon, delta):
        return max(score for name, *at, score in scored if name == file and at == [epsilon, delta])

    tab.page.get_by_label("File", exact=True).select_option(label="laboratory.npz")
    shown = tuner(tab, "map", f"Math.abs(s.heights[0][0] - {best(files[1], 0.02, 0.05)}) < 1e-9")
    for row, d in zip(shown["heights"], (0.05, 0.1), strict=True):
        assert row == pytest.approx([best(files[1], e, d) for e in (0.02, 0.03, 0.05)])
    assert tab.page.get_by_text("fleet.csv: 12 settings of 2 files").is_visible()
    box = tab.page.locator(".map-canvas").bounding_box()
    tab.page.mouse.click(box["x"] + 0.95 * box["width"], box["y"] + 0.05 * box["height"])
    tab.until("s.params.epsilon === 0.05 && s.params.delta === 0.1 && [8, 16].includes(s.params.min_points)")

    tab.drop("worse.csv", content.replace("0.02", "wide"))
    tab.page.get_by_text("worse.csv is not the table of a sweep: epsilon of row 1 is 'wide'").wait_for()
    assert tuner(tab, "map", "true")["sweep"] == "fleet.csv"
    tab.forgive("400")
    tab.page.get_by_role("button", name="Back to the recording").click()
    tuner(tab, "map", "!s.sweep && s.side === 25 && !s.running")


class Search:
    """Searches that go no further than to `most` trials before they are let go: a test can stop them in the middle."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self._step, self._most, self._go_on = Tuning.step, 0, threading.Event()
        monkeypatch.setattr(Tuning, "step", lambda tuning: self._held(tuning))

    def hold(self, most: int) -> None:
        self._most = most
        self._go_on.clear()

    def let_go(self) -> None:
        self._go_on.set()

    def _held(self, tuning: Tuning) -> Trial:
        if len(tuning.trials()) >= self._most:
            assert self._go_on.wait(SECONDS)
        return self._step(tuning)


def test_auto_tuning_shows_its_trials_stops_goes_on_and_is_adopted(tab, monkeypatch):
    search = Search(monkeypatch)
    search.hold(12)
    tab.page.get_by_role("tab", name="Auto").click()
    panel = tab.page.locator(".auto-page")
    panel.get_by_label("Objective").select_option("label-free")
    checked = panel.locator("input:checked").evaluate_all("(boxes) => boxes.map((box) => box.value)")
    assert checked == ["epsilon", "delta", "seed_points"]
    panel.get_by_label("Objective").select_option("truth")
    panel.get_by_role("button", name="Start", exact=True).click()
    tuner(tab, "auto", "s.trials >= 12")
    assert "harmonic mean of TR and 1 − FR" in panel.inner_text()
    panel.get_by_role("button", name="Stop").click()
    search.let_go()
    stopped = tuner(tab, "auto", "!s.running")
    assert re.search(r"^(No gain|Gain \+)", stopped["verdict"])
    assert stopped["trials"] < 100
    lines = panel.locator(".auto-parallel .trial")
    # The picture is painted with the browser's next frame.
    tab.eventually(lambda: lines.count() == stopped["trials"], "the picture lacks trials")
    assert panel.locator(".auto-row").count() == 5

    search.hold(stopped["trials"] + 1)
    panel.get_by_role("button", name="Go on").click()
    tuner(tab, "auto", f"s.trials > {stopped['trials']}")
    panel.get_by_role("button", name="Stop").click()
    search.let_go()
    found = tuner(tab, "auto", "!s.running")
    tab.page.get_by_role("tab", name="Thresholds").click()
    tab.type_value("epsilon", "0.09")
    tab.until("s.params.epsilon === 0.09")
    tab.page.get_by_role("tab", name="Auto").click()
    panel.get_by_role("button", name=re.compile("Adopt the best")).click()
    adopted = tab.until("s.params.epsilon !== 0.09")["params"]
    assert adopted == found["best"]
    search.hold(1)
    panel.get_by_role("button", name="Start over").click()
    tuner(tab, "auto", "s.running && s.trials >= 1")
    panel.get_by_role("button", name="Stop").click()
    search.let_go()
    tuner(tab, "auto", "!s.running")


@pytest.fixture(scope="module")
def coarse(tmp_path_factory) -> Path:
    """The hallway, seen by a laser that scatters by 22 mm."""
    hallway = open_recording(SAMPLES / "hallway.npz").only(np.arange(0, 300, 12))
    noise = np.random.default_rng(0).normal(0, 0.02, len(hallway.ranges))
    file = tmp_path_factory.mktemp("coarse") / "coarse.npz"
    save_npz(replace(hallway, ranges=(hallway.ranges + noise).astype(np.float32)), file)
    return file


def test_what_fits_the_laser_is_offered_taken_over_and_undone(tab, coarse: Path):
    text = tab.page.locator(".fit-text")
    fit = tab.page.locator(".fit")
    assert tuner(tab, "fit", "s.better && s.text.includes('Points scatter by 10 mm here')")["fits"]["epsilon"] < 0.05
    assert tab.page.locator(".noise-picture").is_visible()
    height = fit.bounding_box()["height"]

    tab.upload(coarse)
    tab.until("s.label === 'coarse.npz'")
    fits = tuner(tab, "fit", "s.better")["fits"]
    assert set(fits) == {"epsilon", "delta", "epsilon_growth"}
    assert fits["epsilon"] > 0.05
    assert re.match(r"Points scatter by 2\d mm here. ε = \S+ fits", text.inner_text())
    assert tab.state["params"]["epsilon"] == 0.03
    assert fit.bounding_box()["height"] == height
    tick = tab.page.locator("[data-knob=epsilon] .fit-mark")
    place = tick.evaluate("(mark) => Number(mark.style.getPropertyValue('--place'))")
    assert abs(0.005 * 100**place - fits["epsilon"]) < 1e-6

    tab.page.get_by_role("button", name="Use it").click()
    tab.until(f"s.params.epsilon === {fits['epsilon']} && s.params.delta === {fits['delta']}")
    tuner(tab, "fit", "!s.better && s.text.includes('suits that')")
    assert tab.page.locator(".fit-mark:visible").count() == 0
    tab.page.keyboard.press("Control+z")
    tab.until("s.params.epsilon === 0.03 && s.params.delta === 0.1")
    tuner(tab, "fit", "s.better")

    tab.page.get_by_label("Method", exact=True).select_option("hough")
    assert set(tuner(tab, "fit", "s.fits && s.fits.rho_step")["fits"]) == {"epsilon", "rho_step"}
    tab.choose_recording("1 perfect corner")
    tuner(tab, "fit", "s.text.includes('at least 4 scans')")
    assert tab.page.locator(".noise-picture").is_hidden()
    assert tab.page.locator(".fit-mark:visible").count() == 0


def test_a_slider_reaches_the_value_that_was_typed_and_keeps_its_range_while_it_is_dragged(tab):
    slider = tab.slider("epsilon")
    tab.type_value("epsilon", "0.9")
    tab.until("s.params.epsilon === 0.9")
    place = slider.evaluate("(input) => input.valueAsNumber / input.max")
    assert abs(0.005 * 200**place - 0.9) < 0.002
    tab.drag("epsilon", by=-150)
    now = tab.until("s.params.epsilon < 0.3")["params"]["epsilon"]
    place = slider.evaluate("(input) => input.valueAsNumber / input.max")
    assert abs(0.005 * 200**place - now) < 0.002
    tab.page.mouse.up()
    tab.choose_recording("1 perfect corner")
    tab.until("s.recording.includes('perfect_corner')")
    assert slider.evaluate("(input) => input.valueAsNumber / input.max") > place
