"""The window: its parts dragged to size and hidden, narrow and wide."""

from __future__ import annotations

import json
import math
from collections.abc import Callable

import pytest
from browser.conftest import Profile, Tab
from live import Address
from playwright.sync_api import ViewportSize

pytestmark = pytest.mark.own_tab
GRIP = ".divider-grip >> nth=0"
# Parts that stand out of the window, and rows that are wider than the place they have.
PARTS = "#topbar > *, #timeline > *, #status > *, #stage, #replay, #panel .tab"
CUT_OFF = """(parts) => [...document.querySelectorAll(parts)]
    .filter((part) => part.checkVisibility() && !part.matches(".off-screen"))
    .filter((part) => {
        const { left, right, top, bottom } = part.getBoundingClientRect();
        return left < -0.5 || right > innerWidth + 0.5 || top < -0.5 || bottom > innerHeight + 0.5;
    })
    .map((part) => part.id || part.className)"""


def width(tab: Tab) -> float:
    return tab.page.locator("#panel").evaluate("(panel) => panel.getBoundingClientRect().width")


def test_the_panel_is_dragged_to_a_width_that_a_new_page_has_too(new_tab: Callable[..., Tab]):
    tab = new_tab()
    usual = width(tab)
    box = tab.page.locator(GRIP).bounding_box()
    assert box is not None
    tab.page.mouse.move(box["x"] + 5, box["y"] + 200)
    tab.page.mouse.down()
    # Over the scene, whose frame would take the pointer.
    tab.page.mouse.move(box["x"] - 115, box["y"] + 220, steps=4)
    tab.page.mouse.up()
    tab.eventually(lambda: abs(width(tab) - usual - 120) < 2, "the panel is as wide as before")
    tab.page.reload()
    tab.until("true")
    tab.eventually(lambda: abs(width(tab) - usual - 120) < 2, "the width was forgotten")
    tab.page.locator(GRIP).dblclick(position={"x": 5, "y": 100})
    tab.eventually(lambda: width(tab) == usual, "a double click gives no usual width")
    tab.page.locator(GRIP).press("Enter")
    tab.eventually(lambda: not tab.page.locator("#panel").is_visible(), "the panel is not hidden")
    tab.page.keyboard.press("p")
    tab.eventually(lambda: tab.page.locator("#panel").is_visible(), "the panel does not come back")
    # The timeline is pulled up to plots, one for each score that is known.
    tab.page.locator("#plots .divider-grip").dblclick()
    tab.eventually(lambda: tab.page.locator(".plot").count() > 5, "no plots")
    tab.page.keyboard.press("t")
    tab.eventually(lambda: not tab.page.locator("#timeline, .plot").first.is_visible(), "the timeline is not hidden")


def test_at_every_width_nothing_is_cut_off_and_the_view_fits(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:laboratory")
    x1, y1, x2, y2 = tab.state["bounds"]
    clear = f"""() => {{
        const tools = document.querySelector(".stage-tools").getBoundingClientRect();
        const {{ left, top }} = stage.getBoundingClientRect();
        const [[first, high], [last]] = [lineseg.project({x1}, {y2}), lineseg.project({x2}, {y2})];
        return top + high >= tools.bottom || left + last <= tools.left || left + first >= tools.right;
    }}"""
    inside = f"""() => [[{x1}, {y1}], [{x2}, {y2}]].every(([x, y]) => {{
        const at = lineseg.project(x, y);
        return at && at[0] > 0 && at[1] > 0 && at[0] < stage.clientWidth && at[1] < stage.clientHeight;
    }})"""
    for wide, high in (2560, 1080), (1024, 700), (820, 1180), (480, 800):
        tab.page.set_viewport_size(ViewportSize(width=wide, height=high))
        tab.eventually(
            lambda: tab.page.evaluate(CUT_OFF, PARTS) == [],
            f"cut off at {wide} px: {tab.page.evaluate(CUT_OFF, PARTS)}",
        )
        tab.eventually(lambda: tab.page.evaluate(inside), f"the view does not fit at {wide} px")
        tab.eventually(lambda: tab.page.evaluate(clear), f"the tools cover a part of the plan at {wide} px")
    assert tab.page.evaluate("() => stage.getBoundingClientRect().bottom <= panel.getBoundingClientRect().top + 1")


def test_a_frame_that_reaches_beyond_the_view_is_shown_whole(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:laboratory&frame=0")
    inside = """() => {
        const [x1, y1, x2, y2] = lineseg.state.extent;
        return [[x1, y1], [x1, y2], [x2, y1], [x2, y2]].every(([x, y]) => {
            const at = lineseg.project(x, y);
            return at && at[0] >= 0 && at[1] >= 0 && at[0] <= stage.clientWidth && at[1] <= stage.clientHeight;
        });
    }"""
    tab.eventually(lambda: tab.page.locator("iframe.scene.ready").count(), "no scene")
    tab.eventually(lambda: tab.page.evaluate(inside), "the first frame is cut")
    before = tab.page.evaluate("() => [lineseg.project(0, 0), lineseg.project(1, 0)]")
    tab.page.evaluate("() => { location.hash = location.hash.replace('frame=0', '') + '&frame=240'; }")
    tab.until("s.frame === 240")
    tab.eventually(lambda: tab.page.evaluate(inside), "a later frame is cut")
    after = tab.page.evaluate("() => [lineseg.project(0, 0), lineseg.project(1, 0)]")
    assert (before[1][0] - before[0][0]) / (after[1][0] - after[0][0]) <= 1.4
    # What a person has moved stays.
    tab.page.mouse.move(400, 300)
    tab.page.mouse.wheel(0, -300)
    tab.eventually(lambda: tab.page.evaluate("() => location.hash.includes('look')"), "the view was not moved")
    places: list[list[float]] = []

    def rests() -> bool:
        # The wheel moves the camera for some frames more.
        places.append(tab.page.evaluate("() => lineseg.project(0, 0)"))
        return len(places) > 10 and all(place == places[-1] for place in places[-10:])

    tab.eventually(rests, "the camera never comes to rest")
    kept = places[-1]
    tab.page.keyboard.press("ArrowRight")
    tab.until("s.frame === 241")
    assert tab.page.evaluate("() => lineseg.project(0, 0)") == kept


def test_a_double_click_on_a_notice_does_not_reach_the_next(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=file:gone&name=gone.log")
    close = tab.page.locator(".notice.error").get_by_role("button", name="Dismiss")
    close.wait_for()
    tab.page.evaluate("""() => {
        const next = document.createElement("div");
        next.className = "notice next";
        next.innerHTML = '<div class="notice-row"><span class="notice-words">next</span></div>';
        const button = document.createElement("button");
        button.className = "icon-button";
        button.onclick = () => next.remove();
        next.firstChild.append(button);
        document.querySelector(".notice.error").after(next);
    }""")
    close.dblclick()
    assert not tab.page.locator(".notice.error").is_visible()
    assert tab.page.locator(".notice.next").is_visible()
    tab.page.locator(".notice.next button").click()
    assert not tab.page.locator(".notice.next").count()


def test_the_card_of_why_does_not_lie_over_its_point(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:laboratory&frame=5")
    tab.page.set_viewport_size(ViewportSize(width=820, height=1180))
    tab.eventually(lambda: tab.page.locator("iframe.scene.ready").count(), "no scene")
    for x, y in sorted((segment["start"] for segment in tab.state["segments"]), key=lambda at: at[1])[:4]:
        at = tab.page.evaluate(
            """([x, y]) => {
            const { left, top } = stage.getBoundingClientRect();
            const [across, down] = lineseg.project(x, y);
            return [left + across, top + down];
        }""",
            [x, y],
        )
        tab.page.keyboard.press("Escape")
        tab.until("s.selected === null")
        tab.page.mouse.click(*at)
        selected = tab.until("s.selected !== null")["selected"]
        tab.eventually(
            lambda: tab.page.locator(".explanation .what-if-change").first.is_visible(), "nothing is offered"
        )
        card = tab.page.locator(".explanation").bounding_box()
        assert card is not None
        over = card["x"] < at[0] < card["x"] + card["width"] and card["y"] < at[1] < card["y"] + card["height"]
        assert not over, selected


def test_on_a_phone_sentences_and_the_fields_of_a_dialog_are_whole(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:laboratory&mode=learn&step=0")
    tab.page.set_viewport_size(ViewportSize(width=480, height=800))
    whole = """() => {
        const { scrollHeight, clientHeight } = document.querySelector(".stepper .decision");
        return scrollHeight <= clientHeight;
    }"""
    step = tab.until("s.step === 0")["step"]
    for jump in "seed", "refusal", "line", "drop":
        tab.page.locator(f".stepper [data-jump={jump}]").click()
        step = tab.until(f"s.step > {step}")["step"]
        assert tab.page.evaluate(whole), tab.page.locator(".stepper .decision").inner_text()
    close = tab.page.locator(".stepper .replay-said .icon-button").bounding_box()
    assert close is not None
    assert close["x"] + close["width"] > 440
    tab.page.get_by_role("button", name="Export").click()
    tab.page.get_by_role("menuitem", name="Send parameters to a robot").click()
    tab.page.get_by_role("dialog").get_by_role("button", name="Send").wait_for()
    beyond = """() => {
        const dialog = document.querySelector("dialog[open]");
        const { right } = dialog.getBoundingClientRect();
        const fields = [...dialog.querySelectorAll("*")].filter((each) => each.checkVisibility());
        return fields.filter((each) => each.getBoundingClientRect().right > right + 0.5).map((each) => each.className);
    }"""
    assert tab.page.evaluate(beyond) == []


WITHOUT_WEBGL = """const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
        return kind.startsWith("webgl") ? null : get.call(this, kind, ...more);
    };"""
# How many colours the canvas of the scene has.
COLOURS = """() => {
    const canvas = document.querySelector("canvas.scene");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size;
}"""
POINTER = """([at, kinds]) => {
    const canvas = document.querySelector("canvas.scene");
    const { left, top } = canvas.getBoundingClientRect();
    canvas.setPointerCapture = () => {};
    for (const [kind, id, x, y] of kinds)
        canvas.dispatchEvent(new PointerEvent(kind, {
            pointerType: "touch", pointerId: id, isPrimary: id === 1, bubbles: true,
            clientX: left + at[0] + x, clientY: top + at[1] + y }));
}"""


def test_without_webgl_the_plan_is_drawn_in_2d_and_answers_fingers(profile: Profile, address: Address):
    page = profile.context.new_page()
    page.add_init_script(WITHOUT_WEBGL)
    tab = Tab(page, f"{address.http}/").open("#recording=sample:hallway")
    tab.eventually(lambda: page.locator(".notice.flat").is_visible(), "no line says why")
    tab.eventually(lambda: page.evaluate(COLOURS) > 8, "nothing is drawn")
    at = page.evaluate("() => lineseg.project(...lineseg.state.segments[0].start)")
    page.evaluate(POINTER, [at, [("pointerdown", 1, 0, 0), ("pointerup", 1, 0, 0)]])
    tab.until("s.view.selected !== null")
    wide = "() => lineseg.project(1, 0)[0] - lineseg.project(0, 0)[0]"
    before = page.evaluate(wide)
    pinch = [("pointerdown", 1, -20, 0), ("pointerdown", 2, 20, 0), ("pointermove", 2, 60, 0)]
    page.evaluate(POINTER, [at, pinch])
    tab.eventually(lambda: page.evaluate(wide) > 1.5 * before, "two fingers do not zoom")
    page.close()
    assert tab.complaints == []


def test_the_ruler_measures_between_two_lines(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:hallway")
    page = tab.page
    along = """([k, share]) => {
        const { start, end } = lineseg.state.segments[k];
        const at = lineseg.project(...[0, 1].map((i) => start[i] + share * (end[i] - start[i])));
        const { left, top } = document.querySelector("#stage").getBoundingClientRect();
        return [at[0] + left, at[1] + top];
    }"""
    tab.eventually(lambda: page.evaluate("() => lineseg.project(0, 0)"), "no plan")
    lines = tab.state["segments"]
    one, other = sorted(range(len(lines)), key=lambda k: -lines[k]["length"])[:2]
    page.keyboard.press("u")
    for k in (one, other):
        page.mouse.click(*page.evaluate(along, [k, 0.5]))
    (a, b, _), (c, d, _) = lines[one]["line"], lines[other]["line"]
    angle = math.degrees(math.atan2(abs(a * d - b * c), abs(a * c + b * d)))
    tab.eventually(lambda: f"{angle:.2f}°" in page.locator(".ruler").inner_text(), f"no angle of {angle:.2f}°")
    assert "range" in page.locator(".readout").inner_text()
    page.keyboard.press("Escape")
    tab.eventually(lambda: not page.locator(".ruler").is_visible(), "the ruler stays")


def test_space_plays_after_a_click_on_a_mode_or_a_tab(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:hallway")
    for button in ".mode[data-mode=inspect]", "#tab-lines":
        before = tab.state["frame"]
        tab.page.locator(button).click()
        tab.page.keyboard.press("Space")
        tab.until(f"s.frame !== {before}")
        tab.page.keyboard.press("Space")


def test_a_profile_is_kept_under_a_name_and_chosen_like_a_preset(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:hallway&epsilon=0.07&layers=normals")
    page = tab.page
    menu = page.locator(".panel-toolbar .menu-button").first
    menu.click()
    page.get_by_role("menuitem", name="Keep or open a profile").click()
    page.locator(".profile-name").fill("our RPLIDAR")
    page.get_by_role("button", name="Keep what is on the screen").click()
    page.locator(".profiles li").wait_for()
    with page.expect_download() as saved:
        page.get_by_role("button", name="Save file").click()
    assert json.loads(saved.value.path().read_text())["view"]["params"]["epsilon"] == 0.07
    page.evaluate("""() => {
        for (let [size, key] = [4_000_000, 0]; size >= 1; key++)
            try { localStorage["full" + key] = "x".repeat(size); } catch { size = Math.floor(size / 2); }
    }""")
    page.locator(".profile-name").fill("one more")
    page.get_by_role("button", name="Keep what is on the screen").click()
    page.get_by_text("This browser has no room for the profile one more").wait_for()
    assert (page.locator(".profiles li").count(), page.locator(".profile-name").input_value()) == (1, "one more")
    page.evaluate(
        "() => Object.keys(localStorage).forEach((key) => key.startsWith('full') && delete localStorage[key])"
    )
    page.keyboard.press("Escape")
    tab.type_value("epsilon", "0.02")
    tab.until("s.params.epsilon === 0.02")
    page.keyboard.press("Escape")
    page.keyboard.press("i")
    tab.until("s.layers.numbers")
    menu.click()
    page.get_by_role("menuitem", name="our RPLIDAR").click()
    tab.until("s.params.epsilon === 0.07 && s.layers.normals && !s.layers.numbers")
    tab.eventually(lambda: menu.inner_text() == "our RPLIDAR", "the button does not name the profile")
    page.keyboard.press("Control+z")
    tab.until("s.params.epsilon === 0.02 && s.layers.numbers")
    tab.eventually(lambda: menu.inner_text() != "our RPLIDAR", "the button names a profile that was undone")


def test_a_profile_of_anybody_leaves_the_page_usable_and_so_does_what_the_browser_kept(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:hallway")
    page = tab.page
    view = {"method": "region-growing", "params": {"epsilon": 0.05}, "reading": {}, "layers": {}}
    profile = {"format": "lineseg profile 1", "name": "__proto__", "view": view, "layout": {"hidden": 5, "panel": 1e9}}
    wrong = [
        {"params": {"epsilon": "x"}},
        {"params": None},
        {"layers": {"points": [[]]}},
        {"reading": 5},
        {"method": {}},
    ]
    page.locator(".panel-toolbar .menu-button").first.click()
    page.get_by_role("menuitem", name="Keep or open a profile").click()
    for content in [{}, [], *({**profile, "view": view | each} for each in wrong), profile]:
        with page.expect_file_chooser() as asked:
            page.get_by_role("button", name="Open a file…").click()
        file = {"name": "p.json", "mimeType": "application/json", "buffer": json.dumps(content).encode()}
        asked.value.set_files(file)  # pyright: ignore[reportArgumentType]
        told = page.get_by_text("p.json is not a profile of lineseg")
        told.wait_for(state="hidden" if content == profile else "visible")
    page.locator(".profiles li").filter(has_text="__proto__").get_by_role("button", name="Use").click()
    tab.until("s.params.epsilon === 0.05")
    assert page.locator("#panel").bounding_box()["width"] < 720  # pyright: ignore[reportOptionalSubscript]
    for poison in ("{", '{"hidden": 5, "panel": {}, "name": null}'):
        script = (
            "poison => ['layout', 'profiles', 'curves', 'robot'].forEach(k => localStorage['lineseg.' + k] = poison)"
        )
        page.evaluate(script, poison)
        page.reload()
        tab.until("s.params.epsilon === 0.05")
    page.evaluate("localStorage.clear()")
