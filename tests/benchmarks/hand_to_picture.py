"""The way from a hand to the picture, in headless Chromium: hand_to_picture.py [RECORDING] [SECONDS]

RECORDING is a sample or a file; more of a link may follow it, as in sample:hallway&space=world. The benchmark drags ε
at 60 Hz, then presses arrow keys at 30 Hz, and prints the time from the input to each stage that the page marks
(static/view/stages.js), and, if the segments are others, to the first drawing of the scene with new data. It does so
with a page and a scene that the processor paints, with the scene alone painted so, and with no scene painted, as if a
graphics card did it: the differences are the renderer's share.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from class_of_tabs import Server
from playwright.sync_api import Page, sync_playwright

FLAGS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking")
UNPAINTED = """if (location.pathname.includes("/viser/"))
    for (const draw of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced", "clear"])
        WebGL2RenderingContext.prototype[draw] = () => {};"""
# Who paints: further flags of the browser, and a script for the scene.
SCREENS = {
    "all by SwiftShader": ([], ""),
    "scene by SwiftShader": (["--disable-gpu-compositing"], ""),
    "scene not painted": (["--disable-gpu-compositing"], UNPAINTED),
}
STAGES = ("sent", "answered", "shown")
# The scene's frame notes when it draws for the first time after its buffers changed.
WATCHED = """if (location.pathname.includes("/viser/")) {
    const { prototype } = WebGL2RenderingContext;
    let fresh = false;
    const before = (name, run) => {
        const usual = prototype[name];
        prototype[name] = function (...given) {
            run();
            return usual.apply(this, given);
        };
    };
    for (const name of ["bufferData", "bufferSubData"]) before(name, () => { fresh = true; });
    for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"])
        before(name, () => {
            if (fresh) (parent.drawings ??= []).push(performance.timeOrigin + performance.now());
            fresh = false;
        });
} else {
    window.stages = [];
    window.shown = [];
    const mark = performance.mark.bind(performance);
    performance.mark = (name, options) => {
        if (name === "lineseg shown") shown.push([options.detail, JSON.stringify(lineseg.state.segments)]);
        return mark(name, options);
    };
    new PerformanceObserver((list) => {
        for (const { name, detail, startTime } of list.getEntries())
            if (name.startsWith("lineseg ")) stages.push([name.slice(8), detail, performance.timeOrigin + startTime]);
    }).observe({ type: "mark" });
}"""
MOVED = """async ([seconds, hertz, key]) => {
    const slider = document.querySelector("[data-knob=epsilon] input[type=range]");
    window.stages = [];
    window.drawings = [];
    window.shown = [];
    slider.focus();
    const begun = performance.now();
    for (let k = 0; performance.now() - begun < 1000 * seconds; k++) {
        await new Promise((go) => setTimeout(go, begun + (1000 * k) / hertz - performance.now()));
        const up = Math.floor(k / 20) % 2 === 0;
        if (key) {
            const name = up ? "ArrowRight" : "ArrowLeft";
            slider.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true }));
        } else {
            slider.value = String(slider.max * (0.5 + 0.4 * Math.sin(k / 40)));
            slider.dispatchEvent(new Event("input", { bubbles: true }));
        }
    }
    await new Promise((go) => setTimeout(go, 500));
    return { stages, drawings, shown };
}"""


def main(recording: str, seconds: float) -> None:
    chromium = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "google-chrome"))))
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        name, _, more = recording.partition("&")
        is_file = Path(name).is_file()
        server = Server(folder, *([name] if is_file else []))
        try:
            for screen, (flags, script) in SCREENS.items():
                browser = playwright.chromium.launch(executable_path=chromium, args=[*FLAGS, *flags])
                print(screen)
                try:
                    page = browser.new_page(viewport={"width": 1440, "height": 900})
                    for each in (script, WATCHED):
                        page.add_init_script(each)
                    page.goto(f"http://{server.address}/#{more if is_file else f'recording={recording}'}")
                    page.wait_for_function("window.lineseg?.state && window.lineseg.settled", timeout=120_000)
                    page.wait_for_timeout(5000)
                    for label, hertz, key in (("drag", 60, False), ("keys", 30, True)):
                        _print(label, _moved(page, seconds, hertz, key))
                finally:
                    browser.close()
        finally:
            server.stop()


def _moved(page: Page, seconds: float, hertz: float, key: bool) -> dict[str, list[float]]:
    """The times from the input to each stage [ms]."""
    seen: dict[str, Any] = page.evaluate(MOVED, [seconds, hertz, key])
    at: dict[int, dict[str, float]] = {}
    for stage, rev, when in seen["stages"]:
        at.setdefault(rev, {})[stage] = when
    drawings = np.array(sorted(seen["drawings"]))
    segments = [one for _, one in seen["shown"]]
    others = {rev for (rev, one), before in zip(seen["shown"][1:], segments, strict=False) if one != before}
    times: dict[str, list[float]] = {stage: [] for stage in (*STAGES, "scene")}
    for rev, marks in at.items():
        if len(marks) < len(STAGES) + 1:
            continue
        for stage in STAGES:
            times[stage].append(marks[stage] - marks["changed"])
        after = int(np.searchsorted(drawings, marks["answered"]))
        if rev in others and after < len(drawings):
            times["scene"].append(float(drawings[after]) - marks["changed"])
    return times


def _print(label: str, times: dict[str, list[float]]) -> None:
    for stage, each in times.items():
        if each:
            median, most = np.percentile(each, (50, 95))
            print(f"  {label}, {stage:9s} p50 {median:6.1f}  p95 {most:6.1f} ms  ({len(each)} changes)")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "sample:hallway", float(sys.argv[2]) if len(sys.argv) > 2 else 8.0)
