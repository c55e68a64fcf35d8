"""The timeline's strip: a score of every frame, with the current thresholds."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bags import bag1
from browser.conftest import Tab
from lineseg_app.server import Settings
from lineseg_app.shelf import library
from live import Address, serving
from long import long_hallway
from waiting import SECONDS

from lineseg import Params, Recording, Survey, open_recording
from lineseg.doubt import SCORES
from lineseg.readers import Progress, Reading, parts, save_npz
from lineseg.survey import survey
from lineseg.survey.committee import with_disputes
from lineseg.survey.stability import with_stability

Show = Callable[[Recording], None]
FRAMES = 3_000


@pytest.fixture(scope="module")
def long(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file of 3,000 frames. A third of the beams is enough: what is tested are the frames."""
    file = tmp_path_factory.mktemp("long") / "long.npz"
    save_npz(long_hallway(FRAMES, every=3), file)
    return file


@pytest.fixture(scope="module")
def address(long: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Address]:
    data = tmp_path_factory.mktemp("data")
    stamps = [100 + 0.025 * k for k in range(400)]
    bags = [bag1(data / name, ("/scan", [2.0] * 90), stamps=stamps) for name in ("stopped.bag", "torn.bag")]
    with serving(Settings(files=(long, *bags), data_folder=data)) as address:
        yield address


@pytest.fixture
def long_tab(tab: Tab) -> Tab:
    """The tab with the long recording."""
    tab.choose_recording("long.npz")
    tab.until(f"s.frames === {FRAMES}")
    return tab


def strip_of(tab, condition: str = "true") -> dict[str, Any]:
    """The strip `t` once it is complete, belongs to the thresholds of the picture, and `condition` holds."""
    look = f"""
        const s = window.lineseg.state, t = window.lineseg.strip;
        const same = t?.complete && Object.entries(t.params).every(([name, value]) => s.params[name] === value);
        const whole = same && t.values.length === s.frames;
        if (whole && window.lineseg.settled && ({condition})) return {{ ...t, values: [...t.values] }};
    """
    return tab.found(look, f"the strip, where {condition}")


def colours(tab) -> list[list[int]]:
    """Red, green and blue of every pixel of the strip, as painted."""
    script = """() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
        const strip = document.querySelector(".strip");
        const data = strip.getContext("2d").getImageData(0, 0, strip.width, 1).data;
        done(Array.from({ length: strip.width }, (_, x) => [...data.slice(4 * x, 4 * x + 3)]));
    })))"""
    return tab.page.evaluate(script)


def test_after_a_drag_the_strip_and_the_frame_agree(long_tab, long: Path):
    recording, tab = open_recording(long), long_tab
    tab.page.evaluate("() => { location.hash += '&frame=2321' }")
    tab.until("s.frame === 2321")
    before = strip_of(tab)
    tab.drag("epsilon", by=-60)
    tab.page.mouse.up()
    tab.until("s.params.epsilon < 0.025")
    strip, state = strip_of(tab), tab.state
    params = Params().but(**state["params"])
    assert state["frame"] == 2321
    assert strip["params"] == state["params"] != before["params"]
    assert strip["values"][2321] == pytest.approx(state["covered"] / state["valid"], abs=1e-6)
    expected = with_stability(recording, with_disputes(recording, survey(recording, params)))
    np.testing.assert_array_equal(np.float32(strip["values"]), expected.score("coverage"))
    for name in SCORES:
        tab.page.get_by_label("Score of the frames").select_option(name)
        shown = strip_of(tab, f"t.score === '{name}' && s.score === '{name}'")
        np.testing.assert_array_equal(np.float32(shown["values"]), expected.score(name), err_msg=name)


def test_the_strip_moves_while_the_slider_is_dragged(long_tab):
    tab = long_tab
    strip_of(tab)
    tab.drag("epsilon", by=-60)
    tab.eventually(
        lambda: tab.page.evaluate("() => window.lineseg.strip.params.epsilon < 0.03"), "the strip stood still"
    )
    tab.page.mouse.up()
    strip_of(tab)


def test_a_click_on_the_strip_goes_to_the_worst_frame_under_the_pixel(long_tab):
    tab = long_tab
    values = np.array(strip_of(tab)["values"])
    worst = int(values.argmin())
    box = tab.page.locator(".strip").bounding_box()
    x = box["x"] + (int(worst / (FRAMES - 1) * box["width"]) + 0.5)
    tab.page.mouse.move(x, box["y"] + 5)
    hint = tab.page.locator(".strip-hint")
    assert hint.inner_text() == f"Frame {worst:,}: coverage {values[worst]:.2f}"
    tab.page.mouse.click(x, box["y"] + 5)
    tab.until(f"s.frame === {worst}")
    painted = colours(tab)
    darkest = int(np.argmin(np.sum(painted, axis=1)))
    assert darkest == int(worst / (FRAMES - 1) * len(painted))


def test_a_click_goes_to_the_frame_that_the_hint_named(long_tab):
    tab = long_tab
    strip_of(tab)
    box = tab.page.locator(".strip").bounding_box()
    for share in (0.0, 0.13, 0.42, 0.61, 0.87, 0.999):
        x = box["x"] + int(share * box["width"])
        tab.page.mouse.move(x, box["y"] + 5)
        named = tab.page.locator(".strip-hint").inner_text().split(":")[0].removeprefix("Frame ").replace(",", "")
        tab.page.mouse.click(x, box["y"] + 5)
        tab.until(f"s.frame === {int(named)}")


def test_keys_go_through_the_worst_frames(tab):
    values = np.array(strip_of(tab)["values"])
    ranking = np.argsort(values, kind="stable")
    for key, rank in [("n", 0), ("n", 1), ("n", 2), ("Shift+N", 1)]:
        tab.page.keyboard.press(key)
        tab.until(f"s.frame === {ranking[rank]}")
    spoken = tab.page.get_by_role("slider", name="Frame").get_attribute("aria-valuetext")
    assert spoken.endswith(f"coverage {values[ranking[1]]:.2f}")


def test_the_chosen_score_is_part_of_the_link(tab, new_tab: Callable[..., Any]):
    tab.page.get_by_label("Score of the frames").select_option("misses")
    tab.until("s.score === 'misses'")
    tab.eventually(lambda: "score=misses" in tab.page.url, "the score is not in the address")
    other = new_tab(tab.page.url[len(tab.address) :])
    assert strip_of(other)["score"] == "misses"
    assert other.page.get_by_label("Score of the frames").input_value() == "misses"


def test_colours_keep_their_values_until_they_are_fitted_again(tab):
    strip_of(tab)
    legend = tab.page.locator(".legend")
    before = legend.inner_text()
    tab.type_value("min_length", "3")
    strip_of(tab, "s.params.min_length === 3")
    colours(tab)
    wider = legend.inner_text()
    assert wider.split()[-1] == before.split()[-1]
    assert float(wider.split()[0]) < float(before.split()[0])
    tab.page.get_by_role("button", name="Reset all").click()
    strip_of(tab, "s.params.min_length === 0.6")
    colours(tab)
    assert legend.inner_text() == wider
    legend.click()
    colours(tab)
    assert legend.inner_text() == before


def test_a_recording_of_one_frame_says_why_there_is_no_strip(tab):
    strip_of(tab)
    tab.choose_recording("1 perfect corner")
    tab.until("s.frames === 1")
    note = tab.page.locator(".strip-note")
    tab.eventually(lambda: note.inner_text() == "one frame: nothing to compare", "the strip does not say why")
    assert tab.page.locator(".strip").is_hidden()
    tab.choose_recording("Hallway (simulated)")
    tab.until("s.frames > 1")
    strip_of(tab)
    tab.eventually(note.is_hidden, "the note stays")


def test_while_a_score_is_computed_the_strip_says_so(tab, monkeypatch):
    go_on = threading.Event()

    def held(*asked: Any) -> Survey:
        assert go_on.wait(SECONDS)
        return with_stability(*asked)

    monkeypatch.setattr("lineseg_app.session.strip.with_stability", held)
    strip_of(tab)
    tab.page.evaluate("""() => {
        const note = document.querySelector(".strip-note");
        window.noted = [];
        new MutationObserver(() => window.noted.push(note.textContent)).observe(note, { childList: true });
    }""")
    tab.page.get_by_label("Score of the frames").select_option("unstable")
    note = tab.page.locator(".strip-note")
    tab.eventually(lambda: note.inner_text() == "computing scores…", "nothing says that scores are computed")
    go_on.set()
    strip_of(tab, "t.score === 'unstable'")
    tab.eventually(note.is_hidden, "the note stays")
    noted = tab.page.evaluate("window.noted")
    assert (set(noted), noted[-1]) == ({"computing scores…", ""}, "")


class Held:
    """Bags that are read part by part, as a test lets them."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.more = threading.Semaphore(0)
        self.torn = False
        monkeypatch.setattr(parts, "FIRST", 0.0)
        monkeypatch.setattr(parts, "EVERY", 0.0)
        monkeypatch.setattr(library, "open_recording", self._opened)

    def _opened(self, path: Path, reading: Reading, *, progress: Progress, so_far: Show) -> Recording:
        def show(part: Recording) -> None:
            so_far(part)
            while not self.more.acquire(timeout=0.05):
                progress(len(part), 400)

        def going_on(done: int, total: int) -> None:
            if self.torn:
                raise OSError("the disk is gone")
            progress(done, total)

        return open_recording(path, reading, progress=going_on, so_far=show)


def test_the_timeline_grows_and_keeps_what_was_read_when_it_is_stopped_or_cannot_go_on(tab, monkeypatch):
    held = Held(monkeypatch)
    tab.choose_recording("stopped.bag")
    first = tab.until('s.label === "stopped.bag" && s.growing')["frames"]
    held.more.release()
    frames = tab.until(f"s.frames > {first}")["frames"]
    assert len(strip_of(tab)["values"]) == frames
    scrubber = tab.page.get_by_role("slider", name="Frame")
    scrubber.press("End")
    assert tab.until(f"s.frame === {frames - 1}")["growing"]
    tab.page.get_by_role("button", name="Stop", exact=True).click()
    assert tab.until("!s.growing")["frames"] == frames
    told = tab.page.locator(".noticed")
    told.get_by_text(f"Only the first {frames} scans were read: you stopped it.").wait_for()

    tab.choose_recording("torn.bag")
    first = tab.until('s.label === "torn.bag" && s.growing')["frames"]
    held.torn = True
    held.more.release()
    assert tab.until("!s.growing")["frames"] == first
    told.get_by_text(re.compile(f"Only the first {first} scans were read: .*the disk is gone")).wait_for()
