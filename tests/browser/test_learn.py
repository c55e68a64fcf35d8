"""Mode Learn: stepping, and what the page says at each step."""

from __future__ import annotations

import json
import re
from functools import partial

import numpy as np
import pytest
from lineseg_app.frame.lesson_shown import frames_to_label
from lineseg_app.places import data_folder
from lineseg_app.shelf.lesson import USUAL, NamedLesson
from lineseg_app.shelf.lesson_numbers import the_one
from lineseg_app.shelf.lessons import lesson_files, scan_of
from taught import taught

from lineseg import Params, open_recording, trace


def learn(new_tab, sample: str, **places):
    more = "".join(f"&{name}={value}" for name, value in places.items())
    tab = new_tab(f"#mode=learn&recording={sample}{more}")
    tab.eventually(lambda: tab.page.locator(".code-line").count() > 30, "no pseudocode")
    leave = tab.page.get_by_role("button", name="Back to the list of lessons")
    if leave.is_visible():
        leave.click()
    return tab


def text_of(tab, selector: str) -> str:
    return tab.page.locator(selector).text_content() or ""


@pytest.mark.own_tab
@pytest.mark.parametrize("level", ["phase", "line"])
def test_a_level_steps_by_whole_stretches_both_ways(new_tab, level):
    starts = trace(open_recording(data_folder("sample_scans") / "laboratory.npz")[0]).starts(level)
    tab = learn(new_tab, "sample:laboratory", step=0)
    tab.page.get_by_label("How far → steps").select_option(level)
    tab.page.keyboard.press("Tab")
    for expected in starts[1:6]:
        tab.page.keyboard.press("ArrowRight")
        tab.until(f"s.step === {expected}")
    for expected in starts[4::-1]:
        tab.page.keyboard.press("ArrowLeft")
        tab.until(f"s.step === {expected}")


def test_jumps_lead_to_the_next_of_their_kind_and_end_with_the_last(new_tab):
    kinds = {
        "seed": ("s", {"seed found"}),
        "refusal": ("x", {"seed rejected", "growth stopped"}),
        "line": ("n", {"line kept"}),
        "drop": ("d", {"line dropped"}),
        "merge": ("m", {"lines merged"}),
        "cut": ("c", {"overlap cut"}),
    }
    samples = {"sample:hallway": "hallway", "lesson:1_perfect_corner": "lessons/1_perfect_corner"}
    for recording, file in samples.items():
        traced = trace(open_recording(data_folder("sample_scans") / f"{file}.npz")[0])
        tab = learn(new_tab, recording, step=0)
        for jump, (key, wanted) in kinds.items():
            button = tab.page.locator(f"#stepper [data-jump={jump}]")
            for way in (partial(tab.page.keyboard.press, key), button.click):
                later = [decision.index for decision in traced if decision.kind in wanted and decision.index > 0]
                tab.page.keyboard.press("Home")
                tab.until("s.step === 0")
                assert button.is_disabled() is (not later)
                if later:
                    way()
                    tab.until(f"s.step === {later[0]}")
        tab.page.keyboard.press("End")
        tab.until(f"s.step === {len(traced) - 1}")
        assert all(tab.page.locator(f"#stepper [data-jump={jump}]").is_disabled() for jump in kinds)


@pytest.mark.own_tab
def test_the_trail_draws_every_fit_of_the_growing_line_up_to_the_step(new_tab):
    tab = learn(new_tab, "lesson:1_perfect_corner", step=0)
    fits = tab.page.locator(".overlay-trail line")
    tab.page.get_by_role("button", name="Trail").click()
    for step, way in [(1, "Right"), (2, "Right"), (3, "Right"), (2, "Left"), (1, "Left"), (0, "Left")]:
        tab.page.keyboard.press(f"Arrow{way}")
        tab.until(f"s.step === {step}")
        tab.eventually(lambda step=step: fits.count() == step + 1, f"not {step + 1} fits")
    tab.page.keyboard.press("End")
    tab.eventually(lambda: fits.count() == 0, "no line grows there")


def test_nothing_is_animated_with_reduced_motion(new_tab):
    tab = learn(new_tab, "sample:hallway", step=0)
    moving = """() => [...document.querySelectorAll("*")].filter((part) => {
        const style = getComputedStyle(part);
        return parseFloat(style.transitionDuration) > 0 || parseFloat(style.animationDuration) > 0;
    }).map((part) => part.className)"""
    assert tab.page.evaluate(moving) != []
    tab.page.emulate_media(reduced_motion="reduce")
    assert tab.page.evaluate(moving) == []
    tab.page.get_by_role("button", name="Play (Space)").first.click()
    tab.until("s.step >= 2")
    assert tab.page.evaluate("document.getAnimations().length") == 0


@pytest.mark.own_tab
def test_a_loop_plays_between_its_ends(new_tab):
    tab = learn(new_tab, "lesson:1_perfect_corner", step=10)
    tab.page.get_by_role("button", name="Start the loop here").click()
    tab.page.keyboard.press("ArrowRight")
    tab.page.keyboard.press("ArrowRight")
    tab.until("s.step === 12")
    tab.page.get_by_role("button", name="End the loop here").click()
    tab.page.get_by_label("Steps per second").select_option("40")
    tab.page.get_by_role("button", name="Play (Space)").first.click()
    for _ in range(2):
        tab.until("s.step === 10")
        tab.until("s.step === 12")
    tab.page.keyboard.press("Escape")


def test_a_beam_leads_to_the_decisions_about_it(new_tab):
    tab = learn(new_tab, "lesson:1_perfect_corner", step=0)
    run_to(tab, 40)
    drawn = tab.until("s.selected === 40 && s.step > 0")
    assert (drawn["decision"]["kind"], drawn["decision"]["beam"]) == ("point added", 40)
    run_to(tab, 86)
    drawn = tab.until("s.selected === 86 && s.decision.beam === 86")
    # The same again and again: its line is kept, a second one takes it too, and they are cut.
    for kind in ("line kept", "point added", "line kept", "overlap cut"):
        run_to(tab, 86)
        drawn = tab.until(f"s.step > {drawn['step']}")
        assert drawn["decision"]["kind"] == kind
    assert "the cut at beam 87 left it to this one" in text_of(tab, ".explanation")


def test_the_formula_shows_the_numbers_of_the_decision_and_its_geometry(new_tab):
    scan = open_recording(data_folder("sample_scans") / "lessons" / "8_noise_burst.npz")[0]
    traced = trace(scan, Params(max_occluder=0.0))
    rejected = next(d for d in traced if d.kind == "seed rejected" and d.check == "delta")
    tab = learn(new_tab, "lesson:8_noise_burst", step=rejected.index, max_occluder=0)
    tab.eventually(lambda: f"{rejected.value:.3f}>δ" in text_of(tab, ".formulas"), "no formula")
    assert tab.page.locator(".overlay-term").count() == 0
    tab.page.locator(".term-chip[data-term=predicted]").focus()
    tab.eventually(lambda: tab.page.locator(".overlay-term circle").count() == 1, "nothing lights up")


def test_the_angle_of_a_merge_follows_from_the_numbers_put_in(new_tab):
    scan = open_recording(data_folder("sample_scans") / "lessons" / "5_shallow_corner.npz")[0]
    traced = trace(scan, Params(merge_rms=0.0))
    (merge,) = traced.indices("lines merged")
    (a, b, _), (a2, b2, _) = (line.line for line in traced.lines_at(merge - 1))
    assert np.arcsin(abs(a * b2 - b * a2)) == pytest.approx(traced[merge].value, abs=1e-6)
    tab = learn(new_tab, "lesson:5_shallow_corner", step=merge, merge_rms=0)
    put_in = [f"{abs(value):.3f}" for value in (a, b2, b, a2)]
    tab.eventually(lambda: f"{np.degrees(traced[merge].value):.1f}°" in text_of(tab, ".formulas"), "no formula")
    assert re.findall(r"\d\.\d{3}", text_of(tab, ".formulas .formula-row >> nth=1")) == put_in


def test_a_refused_merge_says_how_badly_it_fits(new_tab):
    traced = trace(open_recording(data_folder("sample_scans") / "lessons" / "5_shallow_corner.npz")[0])
    (apart,) = traced.indices("lines kept apart")
    value, limit = traced[apart].value, traced[apart].limit
    tab = learn(new_tab, "lesson:5_shallow_corner", step=apart)
    tab.eventually(lambda: f"{value:.3f}>{limit:.3f}" in text_of(tab, ".formulas"), "no formula")
    assert text_of(tab, "#stepper .decision") == traced[apart].text
    assert f"rms would be {value:.3f} m, more than {limit:.3f} m" in traced[apart].text
    assert "γmerge" in text_of(tab, ".code-line.lit")


def test_geometry_under_the_pointer_lights_its_term(new_tab):
    tab = learn(new_tab, "lesson:8_noise_burst", step=0, max_occluder=0, closeup="off")
    for _ in range(3):
        tab.page.keyboard.press("x")
    tab.until("s.decision.kind === 'seed rejected'")
    assert tab.scene
    lit = """() => [...new Set([...document.querySelectorAll(".formulas .lit")].map((part) => part.dataset.term))]"""
    scene = tab.page.locator("iframe.scene").bounding_box()
    for term, shape, x, y in [("point", "circle", "cx", "cy"), ("normal", "line", "x1", "y1")]:
        tab.page.locator(f".term-chip[data-term={term}]").hover()
        mark = tab.page.locator(f".overlay-term {shape}").first
        left, top = (float(mark.get_attribute(name)) for name in (x, y))
        tab.page.mouse.move(5, 5)
        tab.eventually(lambda: tab.page.evaluate(lit) == [], "a term stays lit")
        tab.page.mouse.move(scene["x"] + left, scene["y"] + top, steps=3)
        tab.eventually(lambda term=term: tab.page.evaluate(lit) == [term], f"{term} does not light up")
        tab.eventually(lambda: tab.page.locator(".overlay-term").count() == 1, "nothing is drawn")
    tab.page.mouse.move(scene["x"] + 8, scene["y"] + 8)
    tab.eventually(lambda: tab.page.evaluate(lit) == [], "a term stays lit")
    assert tab.page.locator(".overlay-term").count() == 0


def test_charts_are_walked_through_by_keyboard(new_tab):
    tab = learn(new_tab, "lesson:1_perfect_corner", step=5)
    chart = tab.page.locator(".charts canvas").first
    start = tab.state["decision"]["beam"]
    chart.focus()
    tab.page.keyboard.press("Home")
    tab.page.keyboard.press("End")
    tab.page.keyboard.press("ArrowLeft")
    words = chart.get_attribute("aria-valuetext")
    beam = int(words.split(":")[0].removeprefix("Beam "))
    assert beam != start
    assert tab.state["step"] == 5
    assert tab.page.locator(".overlay-beam circle").count() == 1
    tab.page.keyboard.press("Enter")
    tab.until(f"s.selected === {beam} && s.decision.beam === {beam}")
    tab.page.get_by_role("button", name="All steps").click()
    windows = tab.page.get_by_role("slider", name="Every window tried")
    windows.focus()
    tab.page.keyboard.press("Home")
    tab.page.keyboard.press("ArrowRight")
    fate = windows.get_attribute("aria-valuetext")
    assert fate in text_of(tab, ".ladder figcaption >> nth=0")
    tab.page.keyboard.press("Enter")
    decision = tab.until("s.decision.phase === 'seed' && s.step > 0")["decision"]
    assert fate.startswith(f"Beams {decision['first']} to {decision['last']}: ")


def test_a_failed_load_is_reported_in_its_place_and_can_be_tried_again(new_tab):
    tab = learn(new_tab, "sample:hallway", step=0)
    places = {
        "**/learn/listing.json": ("The pseudocode could not be loaded.", ".code-line >> nth=5"),
        "**/api/sweep?**": ("This chart could not be computed.", ".sweep-canvas[aria-label*=lines]"),
        "**/api/lessons": ("The lessons could not be loaded.", ".lesson-item >> nth=5"),
    }
    for path in places:
        tab.page.route(path, lambda route: route.fulfill(status=503, body='{"message": "Too busy."}'))
    tab.page.reload()
    tab.until("true")
    tab.page.get_by_role("button", name="All steps").click()
    for path, (words, there) in places.items():
        if path == "**/api/lessons":
            tab.page.get_by_role("button", name="All lessons").click()
        trouble = tab.page.locator(".trouble-here", has_text=words)
        trouble.wait_for()
        assert "Too busy." in trouble.text_content()
        assert tab.page.locator(there).count() == 0
        tab.page.unroute(path)
        trouble.get_by_role("button", name="Try again").click()
        tab.page.locator(there).wait_for()
        trouble.wait_for(state="detached")
    tab.forgive("503")
    tab.page.goto(f"{tab.address}?lesson=none_such")
    tab.page.get_by_text("There is no lesson “none_such”").wait_for()


def test_a_lesson_continues_after_a_step_with_another_method(new_tab):
    tab = learn(new_tab, "sample:hallway")
    tab.page.locator("[data-lesson='12_split_and_merge']").click()
    tab.page.locator(".lesson-foot .primary").click()
    tab.until("s.method === 'split-and-merge'")
    assert text_of(tab, ".lesson-foot .muted") == "2 of 6"


def test_a_link_keeps_lesson_and_step(new_tab):
    tab = learn(new_tab, "sample:hallway")
    tab.page.locator("[data-lesson='02_delta']").click()
    tab.until("s.recording === 'lesson:2_grazing_wall'")
    for page in (1, 2):
        tab.page.locator(".lesson-foot .primary").click()
        tab.until(f"s.view.page === {page} && s.step !== null")
    there = tab.state
    tab.eventually(lambda: "page=2" in tab.page.url, "the address does not have the page")
    link = tab.page.url
    tab.page.goto("about:blank")
    tab.page.goto(link)
    assert tab.until("s.view.page === 2 && s.step !== null")["step"] == there["step"]
    tab.eventually(lambda: text_of(tab, ".lesson-foot .muted") == "3 of 6", "the lesson is at another page")
    assert "predicted point" in text_of(tab, ".lesson-body")
    assert tab.state["framing"] == there["framing"]


def test_terms_are_explained_where_they_are_used_and_in_a_list(new_tab):
    tab = learn(new_tab, "sample:hallway")
    tab.page.locator("[data-lesson='02_delta']").click()
    tab.until("s.recording === 'lesson:2_grazing_wall'")
    tab.page.locator(".lesson-foot .primary").click()
    term = tab.page.locator(".lesson-body .term", has_text="ε").first
    term.wait_for()
    term.hover()
    tab.page.locator(".tooltip", has_text="(Eq. 3)").wait_for()
    term.click()
    lit = tab.page.locator(".glossary-entry.lit")
    lit.wait_for()
    assert "Distance to the line" in (lit.text_content() or "").replace("distance", "Distance")
    lit.get_by_role("button", name="Lesson 7").click()
    tab.until("s.view.lesson === '07_epsilon'")
    tab.page.get_by_text("7 · ε: how far is too far").wait_for()


def test_before_the_picture_of_a_lesson_nothing_else_is_shown_with_its_words(new_tab):
    tab = learn(new_tab, "sample:hallway")
    held = []
    tab.page.route("**/api/lessons", lambda route: held.append(route))
    tab.page.goto("about:blank")
    tab.page.goto(f"{tab.address}#mode=learn&lesson=09_shallow&page=2")
    # The lessons have not come, so that the page cannot know of which recording the link speaks.
    tab.until("s.recording === 'sample:hallway' && s.view.lesson === '09_shallow'")
    names = tab.page.locator(".stage > .name-marks")
    assert not names.is_visible() and not tab.page.locator(".stage > .scene").is_visible()
    tab.eventually(lambda: held, "the lessons are not asked for")
    held[0].continue_()
    tab.until("s.recording === 'lesson:5_shallow_corner' && s.step !== null")
    tab.page.locator(".stage:not(.before-lesson)").wait_for()
    assert tab.page.locator(".stage > .scene").is_visible()


def test_in_a_low_window_the_scene_of_a_lesson_comes_first(new_tab):
    tab = learn(new_tab, "sample:hallway")
    tab.page.locator("[data-lesson='05_corner']").click()
    tab.page.locator(".lesson-foot .primary").click()
    tab.until("s.view.page === 1 && s.step !== null")
    tab.page.set_viewport_size({"width": 1024, "height": 700})
    tab.page.locator(".timeline.single").wait_for(state="hidden")
    tab.page.set_viewport_size({"width": 900, "height": 560})
    stage = tab.page.locator("#stage")
    tab.eventually(lambda: stage.evaluate("(stage) => stage.clientHeight") >= 200, "the stage is low")
    names = tab.page.locator(".scene-name")
    tab.eventually(lambda: names.count() and all(each.is_visible() for each in names.all()), "names are hidden")


def test_a_lesson_begins_with_the_algorithm_that_it_is_about(new_tab):
    tab = learn(new_tab, "sample:hallway")
    for lesson, title in (
        ("06_endpoints", "Endpoint generation"),
        ("07_epsilon", "Algorithm 2: grow the line"),
        ("04_collinear", "Algorithm 3: resolve overlaps"),
        ("13_least_squares", "Algorithm 1: find a seed"),
    ):
        tab.page.locator(f"[data-lesson='{lesson}']").click()
        tab.until(f"s.view.lesson === '{lesson}' && s.step === null")
        tab.page.locator(".algorithm:not([hidden]) h3", has_text=title).wait_for()
        tab.page.get_by_role("button", name="Back to the list of lessons").click()
        tab.until("s.view.lesson === null")


def test_leaving_a_lesson_gives_back_what_was_set_before_it(new_tab):
    tab = learn(new_tab, "sample:hallway", step=7, epsilon=0.05)
    tab.until("s.step === 7")
    tab.page.get_by_role("button", name="All lessons").click()
    tab.page.locator("[data-lesson='12_split_and_merge']").click()
    tab.until("s.method === 'split-and-merge' && s.recording === 'lesson:4_lost_end'")
    tab.page.get_by_role("button", name="Back to the list of lessons").click()
    tab.until("s.recording === 'sample:hallway' && s.method === 'region-growing' && s.step === 7")
    assert tab.state["params"]["epsilon"] == 0.05


@pytest.mark.own_tab
def test_predictions_are_asked_before_the_decision_and_counted(new_tab):
    tab = learn(new_tab, "lesson:1_perfect_corner", step=0)
    tab.page.get_by_role("button", name="Predict").click()
    tab.page.keyboard.press("ArrowRight")
    assert text_of(tab, "#stepper .decision").startswith("Beam 15: does it join")
    assert tab.state["step"] == 0
    # The point, the line and both edges of the band are to be seen, but not how far apart they are.
    tab.eventually(lambda: tab.page.locator(".overlay-question line").count() == 3, "no line and band")
    tab.eventually(lambda: tab.page.locator(".scene-name", has_text="P, beam n = 15").count() == 1, "no name")
    assert tab.page.locator(".scene-name", has_text=re.compile("d =|f =")).count() == 0
    tab.page.keyboard.press("1")
    tab.until("s.step === 1")
    assert text_of(tab, "#stepper .decision").startswith("Right.")
    tab.page.keyboard.press("ArrowRight")
    tab.page.keyboard.press("2")
    tab.until("s.step === 2")
    assert text_of(tab, "#stepper .decision").startswith("No.")
    assert text_of(tab, ".predict-score") == "1 of 2 right"


def test_decisions_are_shown_from_near_by_and_z_shows_the_whole_plan(new_tab):
    tab = learn(new_tab, "lesson:1_perfect_corner", step=0)
    metre = "lineseg.project(1, 0)[0] - lineseg.project(0, 0)[0]"
    tab.eventually(lambda: tab.page.locator(".scene-name", has_text="i = 9").count() == 1, "no names")
    near = tab.page.evaluate(metre)
    tab.page.keyboard.press("z")
    tab.until("s.framing === null")
    tab.eventually(lambda: 2 * tab.page.evaluate(metre) < near, "Z does not show the whole plan")
    assert tab.page.locator(".scene-name").count() == 0
    tab.page.keyboard.press("z")
    tab.until("s.framing !== null")
    tab.eventually(lambda: tab.page.evaluate(metre) == near, "Z does not show the decision again")
    # What was moved by hand comes back.
    tab.page.keyboard.press("f")
    tab.eventually(lambda: 2 * tab.page.evaluate(metre) < near, "F does not show the whole plan")
    tab.page.keyboard.press("z")
    tab.eventually(lambda: tab.page.evaluate(metre) == near, "Z does not show the decision again")


def test_the_picture_of_a_threshold_takes_a_click_back_to_its_value(new_tab):
    tab = learn(new_tab, "sample:hallway", step=0)
    tab.page.get_by_role("button", name="All steps").click()
    picture = tab.page.locator(".sweep-canvas")
    tab.eventually(lambda: "7 lines" in (picture.get_attribute("aria-label") or ""), "no sweep")
    box = picture.bounding_box()
    picture.click(position={"x": box["width"] * 0.9, "y": 10})
    assert tab.until("s.params.epsilon > 0.1")["params"]["delta"] == 0.1


def test_words_fit_and_controls_have_names_on_a_small_screen(new_tab):
    tab = learn(new_tab, "sample:hallway", step=900)
    tab.page.set_viewport_size({"width": 480, "height": 800})
    lit = tab.page.locator("#learn .code-line.lit")
    tab.eventually(lit.is_visible, "no line of the listing is lit")
    tab.page.keyboard.press("ArrowRight")
    tab.until("s.step === 901")
    tab.eventually(lit.is_visible, "no line of the listing is lit after the step")
    # The line of the listing comes into view, the sentence and its buttons stay there.
    assert tab.page.evaluate("() => main.scrollTop") == 0
    tab.page.set_viewport_size({"width": 1024, "height": 700})
    tab.page.get_by_role("button", name="All lessons").click()
    tab.page.locator("[data-lesson='01_seed']").click()
    tab.until("s.recording === 'lesson:8_noise_burst'")
    controls = "#stepper :is(button, input, select, canvas[tabindex]), #learn :is(button, input, select)"
    nameless = f"""() => [...document.querySelectorAll("{controls}")]
        .filter((e) => e.checkVisibility() && !(e.getAttribute("aria-label") || e.textContent.trim()))
        .map((e) => e.outerHTML)"""
    assert tab.page.evaluate(nameless) == []
    wide = """() => ["#stepper", "#learn", ".topbar"].filter((name) => {
        const part = document.querySelector(name); return part.scrollWidth > part.clientWidth + 1; })"""
    assert tab.page.evaluate(wide) == []


def to_the_task(new_tab, lesson: str):
    """Open a lesson and go to its task."""
    tab = learn(new_tab, "sample:hallway")
    tab.page.locator(f"[data-lesson='{lesson}']").click()
    while tab.page.get_by_role("button", name="Hint").is_hidden():
        tab.until("true")
        tab.page.locator(".lesson-foot .primary").click()
    tab.until("s.step === null && s.selected === null")
    assert text_of(tab, ".lesson-verdict") == ""
    return tab


def says(tab, words: str) -> None:
    """Wait until the verdict on the task starts with these words."""
    judged = tab.page.locator(".lesson-verdict")
    tab.eventually(lambda: (judged.text_content() or "").startswith(words), f"the task never said {words!r}")


def jump(tab, name: str, times: int = 1) -> None:
    for _ in range(times):
        tab.page.locator(f"#stepper [data-jump={name}]").click()


def run_to(tab, beam: int) -> None:
    tab.page.locator(".beam-number").fill(str(beam))
    tab.page.locator(".beam-number").press("Enter")


def value(name: str, number: float | str):
    def type_it(tab) -> None:
        field = tab.page.locator(f".lesson-knobs [data-knob={name}] input.number")
        field.fill(str(number))
        field.press("Enter")

    return type_it


def press(*keys: str):
    def press_them(tab) -> None:
        for key in keys:
            tab.page.keyboard.press(key)

    return press_them


def choose(words: str):
    return lambda tab: tab.page.get_by_role("button", name=words).click()


def typed(number: str):
    def type_it(tab) -> None:
        tab.page.get_by_label("Your answer").fill(number)
        tab.page.get_by_role("button", name="Check").click()

    return type_it


def do_the_task(tab, lesson: NamedLesson) -> None:
    """What the file of the lesson says is right."""
    goal, number = lesson.task.goal, lesson.task.number
    if goal is None:
        right = [option.text for option in lesson.task.choice if option.right]
        (choose(right[0]) if number is None else typed(re.findall(r"[-−\d.]+", number.answer)[0]))(tab)
        return
    for name, (least, _) in [*lesson.accepted.items()][:1]:
        value(name, f"{least:.6g}")(tab)
        tab.until(f"Math.abs(s.params.{name} - {least}) < 1e-9")
    if goal.at is not None:
        params = Params().but(**lesson.params | lesson.task.params)
        shown = the_one(trace(scan_of(lesson), params), goal.at).index
        step = tab.page.locator("#stepper").get_by_label("Number of the decision")
        step.fill(str(shown + 1))
        step.press("Enter")
        tab.until(f"s.step === {shown}")
    if goal.selected:
        run_to(tab, goal.selected[0])


# Wrong answers with what is said of them, in lessons where there is something to tell.
WRONG = {
    "01_seed": [(lambda tab: jump(tab, "refusal", 3), "Here ε decided, not δ. The right one comes later.")],
    "02_delta": [(value("epsilon", 0.05), "You changed a threshold"), (value("delta", 0.12), "δ is too small.")],
    "03_growth": [
        (lambda tab: jump(tab, "refusal"), "This is “growth stopped”, but of another line or point. The right one")
    ],
    "04_collinear": [(value("merge_angle", 0.05), "α_merge is too large."), (value("epsilon", 0.1), "ε is too large.")],
    "05_corner": [(lambda tab: run_to(tab, 60), "Beam 60 is not the answer. The right one has a lower number.")],
    "06_endpoints": [(press("End"), "This is “endpoints”, but of another line or point. The right one comes earlier.")],
    "07_epsilon": [(value("epsilon", 0.08), "ε is too small.")],
    "08_how_much": [
        (value("min_points", 5), "P_min alone cannot do it."),
        (value("min_length", 0.5), "L_min is too large."),
    ],
    "09_shallow": [(value("merge_angle", 0.08), "α_merge is too large.")],
    "10_curve": [(value("min_length", 3.6), "L_min is too large."), (value("min_length", 0.7), "L_min is too small.")],
    "11_doorway": [(value("max_dropout", 20), "D_max is too small.")],
    "12_split_and_merge": [
        (lambda tab: run_to(tab, 60), "Beam 60 is not the answer. There are right ones with lower and")
    ],
    "13_least_squares": [(choose("It does not exist"), "No. Turn the wall until")],
    "14_without_it": [(typed("26"), "It is too small."), (typed("40"), "It is too large.")],
    "15_laser": [(value("epsilon", 0.04), "ε is too small.")],
    "17_splitting": [(choose("It fits a line"), "No. That is how")],
    "18_time": [(typed("24"), "It is too small."), (typed("26"), "It is too large.")],
    "19_seam": [(choose("The wall at"), "No. Then the seam")],
}
# Frames to label take a while: the tests below do it.
LESSONS = [path.stem for path in lesson_files() if '"labelled"' not in path.read_text("utf-8")]


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_task_says_on_which_side_a_wrong_answer_is_and_takes_the_right_one(new_tab, lesson):
    tab = to_the_task(new_tab, lesson)
    begun = tab.state["params"]
    for wrong, why in WRONG.get(lesson, []):
        wrong(tab)
        tab.until("true")
        says(tab, why.replace("_", ""))
        for name, number in begun.items():
            if tab.state["params"][name] != number:
                value(name, number)(tab)
                tab.until(f"s.params.{name} === {number}")
    do_the_task(tab, next(each for each in taught().lessons if each.id == lesson))
    says(tab, "Done.")


@pytest.mark.own_tab
def test_frames_that_were_labelled_elsewhere_count_for_a_task(new_tab, address):
    told = address.get("/api/labels", params={"recording": "sample:hallway"}).json()
    assert not told["frames"]
    tab = to_the_task(new_tab, "16_correctness")
    for frame in range(20, 30):
        line = {"first": 10, "last": 60}
        body = {"recording": "sample:hallway", "frame": frame, "revision": 0, "lines": [line], "tags": [], "note": ""}
        assert address.put("/api/labels", json=body).status_code == 200
        if frame == 22:
            tab.page.get_by_role("button", name="Inspect").click()
            tab.until("s.mode === 'inspect'")
            tab.page.get_by_role("button", name="Learn").click()
            says(tab, "You have labelled 3 of 10 frames")
    tab.page.keyboard.press("End")
    says(tab, "Done.")


@pytest.mark.own_tab
def test_what_was_answered_is_saved_as_a_file_and_read_back(new_tab):
    tab = to_the_task(new_tab, "18_time")
    # The browser keeps answers of the tests before.
    tab.page.evaluate("localStorage.clear()")
    tab.page.reload()
    tab.until("true")
    for number, words in (("24", "It is too small."), ("25", "Done.")):
        typed(number)(tab)
        says(tab, words)
    tab.page.get_by_role("button", name="Back to the list of lessons").click()
    with tab.page.expect_download() as saved:
        tab.page.get_by_role("button", name="Save my progress").click()
    text = saved.value.path().read_text("utf-8")
    lesson = json.loads(text)["lessons"]["18_time"]
    assert [(each["answer"], each["right"]) for each in lesson["answers"]] == [("24 ms", False), ("25 ms", True)]
    mark = tab.page.locator("[data-lesson='18_time'] .off-screen")
    mark.wait_for(state="attached")
    tab.page.evaluate("localStorage.clear()")
    tab.page.reload()
    tab.until("true")
    tab.page.locator("[data-lesson='18_time']").wait_for()
    assert mark.count() == 0
    tab.drop("lineseg_progress.json", text)
    tab.page.get_by_text("Progress in 1 lesson was read; 1 are done now.").wait_for()
    mark.wait_for(state="attached")


def test_ten_frames_labelled_in_the_lesson_give_tr_and_fr(new_tab):
    recording = open_recording(data_folder("sample_scans") / "hallway.npz")
    found = sum(len(each["lines"]) for each in frames_to_label(recording, Params().but(**USUAL)))
    tab = new_tab("#mode=learn&recording=sample:hallway&frame=5&lesson=16_correctness&page=3")
    tab.page.get_by_role("button", name="Line 1, beams").click()
    tab.page.get_by_role("button", name="One missed wall more").click()
    for _ in range(10):
        tab.page.get_by_role("button", name="Frame is labelled").click()
    says(tab, "Done.")
    # One line was no wall, and one wall was missed.
    tab.page.get_by_text(f"10 frames: TR = {found - 1} / {found} = ").wait_for()
    tab.page.get_by_text(f"FR = 1 / {found} = ").wait_for()
    tab.page.get_by_text("By the known walls of the same frames: TR = ").wait_for()
