"""At each step, the page, the scene and the trace agree, forward and backward."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from lineseg_app.places import data_folder
from waiting import SECONDS

from lineseg import Decision, Scan, Trace, open_recording, trace

# Goes through the steps: with the arrow keys to the next one, by its number to one farther off. At each it waits until
# the buffers that the browser's scene draws from hold what is expected there, and then notes what the page says.
WALK = """async ([steps, expected, patience]) => {
    const number = () => document.querySelector("#stepper .stepper-scrubber .frame-number");
    const press = (key) =>
        document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
    const go = (from, to) => {
        if (Math.abs(to - from) === 1) return press(to > from ? "ArrowRight" : "ArrowLeft");
        number().value = String(to + 1);
        number().dispatchEvent(new Event("change", { bubbles: true }));
    };
    const nodes = document.querySelector("iframe.scene").contentWindow.__viserMutable.nodeRefFromName;
    // What viser has not made yet is equal to nothing, so that the walk waits for it.
    const notYet = [NaN];
    const drawn = (name) => {
        const node = nodes[`/seen/${name}`];
        if (!node) return notYet;
        if (!node.visible) return [];
        let found = null;
        node.traverse((part) => (found = part.geometry?.attributes ?? found));
        if (!found) return notYet;
        const flat = [...(found.instanceStart ? found.instanceStart.data : found.position).array];
        return flat.filter((_, k) => k % 3 < 2);
    };
    const near = (value, other) => Math.abs(value - other) < 1e-4;
    const off = (one, other) => one.length !== other.length || !one.every((value, k) => near(value, other[k]));
    const lacks = ({ exactly, onLine }) => {
        for (const [name, numbers] of Object.entries(exactly))
            if (off(drawn(name), numbers)) return `${name}: ${drawn(name)} instead of ${numbers}`;
        for (const [name, line] of Object.entries(onLine)) {
            if (!line && drawn(name).length) return `${name} is drawn, but there is no such line`;
            if (!line) continue;
            const [[a, b, c], [x1, y1, x2, y2]] = [line, drawn(name)];
            const along = near(a * x1 + b * y1 + c, 0) && near(a * x2 + b * y2 + c, 0);
            if (!along) return `${name} is drawn elsewhere`;
        }
        return null;
    };
    const seen = [];
    const late = Date.now() + 1000 * patience;
    for (const [k, step] of steps.entries()) {
        if (k) go(steps[k - 1], step);
        const why = () => {
            const s = window.lineseg.state;
            return s?.step !== step || !window.lineseg.settled ? "the state is another" : lacks(expected[step]);
        };
        while (why()) {
            if (Date.now() > late) throw new Error(`step ${step}: ${why()}`);
            await new Promise((go) => setTimeout(go, 4));
        }
        seen.push({
            scene: window.lineseg.state.decision,
            said: document.querySelector("#stepper .decision").textContent,
            number: number().value,
            lit: document.querySelectorAll(".code-line.lit").length,
        });
    }
    return seen;
}"""


def on_line(xy, line) -> np.ndarray:
    a, b, c = line
    return xy - (xy @ (a, b) + c) * np.array((a, b))


def expected_at(scan: Scan, traced: Trace, decision: Decision) -> dict[str, Any]:
    """What the scene should draw after a decision, from the trace alone: x, y, x, y, … of each node; [] for nothing."""
    lines = traced.lines_at(decision.index)
    ends = [on_line(scan.xy[beam], line.line) for line in lines for beam in (line.first, line.last)]
    candidate = [decision.beam] if decision.beam >= 0 else []
    outermost = [decision.first, decision.last] if decision.ends else []
    tried = decision.phase == "seed" or decision.kind == "line dropped"
    exactly = {
        "segments": np.ravel(ends).tolist(),
        "candidate": scan.xy[candidate].ravel().tolist(),
        "outermost": scan.xy[outermost].ravel().tolist(),
        "window": scan.xy[traced.beams(decision.first, decision.last)].ravel().tolist() if tried else [],
    }
    if decision.ends:
        exactly["growing"] = list(decision.ends)
    fitted = np.isfinite(decision.line).all() and np.hypot(*decision.line[:2]) > 0.5
    # Two lines as they were compared, before one or both are fitted to what they become.
    before = {line.candidate: list(line.line) for line in traced.lines_at(decision.index - 1)}
    pair = [before[which] for which in (decision.candidate, decision.partner)] if decision.partner >= 0 else [None] * 2
    growing = list(decision.line) if fitted and (decision.partner < 0 or decision.kind == "lines merged") else None
    return {"exactly": exactly, "onLine": {"growing": growing, "first": pair[0], "other": pair[1]}}


def turns(traced: Trace) -> list[int]:
    """The first and the last decision, and those beside one of another kind: a line may grow by a hundred points."""
    kinds = [decision.kind for decision in traced]
    beside = [k for k in range(1, len(kinds)) if kinds[k - 1] != kinds[k]]
    return sorted({0, len(kinds) - 1, *beside, *(k - 1 for k in beside)})


@pytest.mark.parametrize("name", ["1_perfect_corner", "3_collinear_overlap", "7_doorway"])
def test_page_scene_and_trace_agree_on_steps_both_ways(new_tab, name):
    scan = open_recording(data_folder("sample_scans") / "lessons" / f"{name}.npz")[0]
    traced = trace(scan)
    expected = [expected_at(scan, traced, decision) for decision in traced]
    tab = new_tab(f"#mode=learn&recording=lesson:{name}&step=0")
    tab.eventually(lambda: tab.page.locator(".code-line").count() > 30, "no pseudocode")
    assert tab.scene
    # Every step of the shortest.
    back = turns(traced)[::-1]
    steps = list(range(len(traced))) if name == "7_doorway" else back[::-1]
    forward = tab.page.evaluate(WALK, [steps, expected, SECONDS])
    for step, seen in zip(steps, forward, strict=True):
        decision = traced[step]
        assert (seen["scene"]["index"], seen["scene"]["kind"]) == (step, decision.kind)
        assert (seen["number"], seen["lit"]) == (str(step + 1), 1)
        if decision.beam >= 0:
            assert str(decision.beam) in seen["said"]
        if decision.kind in ("point added", "line kept"):
            assert f"{decision.value:.3f} m" in seen["said"]
    said = dict(zip(steps, forward, strict=True))
    assert tab.page.evaluate(WALK, [back, expected, SECONDS]) == [said[step] for step in back]
