"""Playing in the rhythm of the stamps, gaps between scans, and times that are not known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scenes import wall_ahead

from lineseg import Recording
from lineseg.readers import save_npz

BEGAN = 1_399_127_000.0
CASES = """async () => {
    const { Times } = await import("/static/bars/times.js");
    const even = new Times(5, [0, 0.1, 0.2, 0.3, 0.4]);
    const gap = new Times(6, [0, 0.1, 0.2, 60.2, 60.3, 60.4]);
    const slow = new Times(4, [0, 3, 6, 9]);
    const none = new Times(30, null, "no stamps");
    return {
        even: [0, 0.05, 0.1, 0.25, 9].map((passed) => even.after(0, passed)),
        later: even.after(2, 0.11),
        gap: [0.29, 0.31, 0.41].map((passed) => gap.after(0, passed)),
        gaps: gap.gaps,
        skipped: [gap.skipped(0, 2), gap.skipped(2, 3), gap.skipped(0, 5), gap.skipped(3, 5)],
        slow: [slow.gaps.length, slow.after(0, 2.9), slow.after(0, 3)],
        none: [none.real, none.why, none.after(3, 1.01), none.gaps.length],
    };
}"""


def saved(file: Path, stamps: np.ndarray) -> Path:
    scans = [wall_ahead(4.0 - 0.01 * k, 10.0, stamp=stamp) for k, stamp in enumerate(stamps.tolist())]
    save_npz(Recording.from_scans(scans), file)
    return file


def test_time_goes_on_while_frames_are_left_out_and_gaps_are_marked_and_skipped(new_tab, tmp_path: Path):
    steps = np.full(400, 0.001)
    steps[0], steps[200] = 0, 5400
    tab = new_tab()
    told = tab.page.evaluate(CASES)
    assert told["even"] == [0, 0, 1, 2, 4]
    assert told["later"] == 3
    # A gap takes as long as the usual step.
    assert told["gap"] == [2, 3, 4]
    assert [gap["place"] for gap in told["gaps"]] == [3]
    assert told["skipped"] == pytest.approx([0, 60, 60, 0])
    assert told["slow"] == [0, 0, 1]
    assert told["none"] == [False, "no stamps", 13, 0]

    tab.upload(saved(tmp_path / "run.npz", BEGAN + np.cumsum(steps)))
    tab.until('s.label === "run.npz"')
    when = tab.page.locator(".when")
    assert when.inner_text().splitlines() == ["0.000 s", "2014-05-03 14:23:20 UTC"]
    tab.page.evaluate(
        "() => (window.drawn = 0, new MutationObserver(() => window.drawn++).observe("
        "document.querySelector('.when-since'), {childList: true, characterData: true, subtree: true}))"
    )
    tab.page.get_by_role("button", name="Play (Space)").click()
    tab.until("s.frame === 399")
    assert tab.page.evaluate("window.drawn") < 398
    assert "Skipped 90 min without scans" in tab.page.locator(".toast").inner_text()
    assert when.inner_text().splitlines() == ["5400.398 s", "2014-05-03 15:53:20 UTC"]

    # The scrubber tells of the gap, to the pointer and to those who cannot see it.
    slider = tab.page.get_by_role("slider", name="Frame")
    slider.press("Home")
    tab.until("s.frame === 0")
    frame = tab.page.get_by_role("textbox", name="Frame", exact=True)
    frame.fill("200")
    frame.press("Enter")
    tab.until("s.frame === 200")
    assert "90 min without scans before frame 200" in (slider.get_attribute("aria-valuetext") or "")
    box = slider.bounding_box()
    tab.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 5)
    tab.eventually(lambda: "90 min" in tab.page.locator(".strip-hint").inner_text(), "the gap is not named")

    # The speed is kept in the link.
    tab.page.locator("body").press(".")
    tab.eventually(lambda: "speed=2" in tab.page.url, "the speed is not in the link")
    assert tab.page.get_by_role("combobox", name="Speed").input_value() == "2"

    # Stamps that cannot be believed give no time, but a reason, and a rate that is stated.
    tab.upload(saved(tmp_path / "odd.npz", np.r_[np.arange(5.0), np.arange(5.0)]))
    tab.until('s.label === "odd.npz"')
    assert when.inner_text().splitlines() == ["stamps run backwards", "20 frames/s"]
    assert tab.state["since"] is None
