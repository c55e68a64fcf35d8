"""The scene in its frame: a locked camera, picking, and a stable layout."""

from __future__ import annotations

import pytest
from browser.conftest import Profile, Tab
from lineseg_app.scene.looks import CLOUDS
from live import Address

CAMERA = """() => {
    const { cameraControl: control, camera } = window.__viserMutable;
    const at = control.getTarget(camera.position.clone());
    const eye = control.getPosition(camera.position.clone());
    const { up } = control.camera;
    return { at: [at.x, at.y, at.z], eye: [eye.x, eye.y, eye.z], up: [up.x, up.y, up.z], fov: control.camera.fov };
}"""
PLAN_UP = pytest.approx([-1, 0, 0], abs=1e-6)


def looks_straight_down(camera: dict) -> bool:
    aside = max(abs(camera["eye"][0] - camera["at"][0]), abs(camera["eye"][2] - camera["at"][2]))
    return aside < 1e-3 * (camera["eye"][1] - camera["at"][1])


def camera_when(tab, condition) -> dict:
    """Return the camera of the scene as soon as it meets the condition."""
    scene = tab.scene
    return tab.eventually(lambda: (now := scene.evaluate(CAMERA)) and condition(now) and now, "the camera stays")


def camera_at_rest(tab) -> dict:
    """The camera once ten checks in a row agree: viser first sets its own, then the page corrects it."""
    looks: list[dict] = []

    def same() -> bool:
        looks.append(tab.scene.evaluate(CAMERA))
        return len(looks) > 10 and all(look["eye"] == pytest.approx(looks[-1]["eye"]) for look in looks[-10:])

    tab.eventually(same, "the camera never comes to rest")
    return looks[-1]


def middle_of_scene(tab) -> tuple[float, float]:
    box = tab.page.locator("iframe").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_the_camera_looks_straight_down_and_a_drag_moves_but_never_turns_it(tab):
    before = camera_when(tab, looks_straight_down)
    assert before["up"] == PLAN_UP
    assert before["fov"] == pytest.approx(10)
    for button in ("left", "right"):
        x, y = middle_of_scene(tab)
        tab.page.mouse.move(x, y)
        tab.page.mouse.down(button=button)
        tab.page.mouse.move(x + 60, y + 40, steps=5)
        tab.page.mouse.up(button=button)
        last = before["at"]
        before = camera_when(tab, lambda camera, last=last: camera["at"] != last)
        assert looks_straight_down(before)
        assert before["up"] == PLAN_UP


# The size of the points on the screen as they are drawn, and as they should be [px].
MARKS = """() => {
    const { cameraControl: control, nodeRefFromName: nodes, canvas } = window.__viserMutable;
    const sizes = {};
    for (const name of ["/seen/points", "/seen/endpoints"])
        nodes[name]?.traverse((part) => {
            if (!part.isPoints) return;
            const density = canvas.height / canvas.clientHeight;
            sizes[name] = part.material.uniforms.scale.value / control.distance / density / 2;
        });
    return sizes;
}"""


@pytest.mark.own_tab
def test_marks_keep_their_size_on_the_screen_before_the_server_hears_of_the_camera(tab):
    before = camera_when(tab, looks_straight_down)
    tab.eventually(lambda: len(tab.scene.evaluate(MARKS)) == 2, "no marks in the scene")
    tab.scene.evaluate("() => { window.__viserMutable.sendMessage = () => {}; }")
    tab.page.mouse.move(*middle_of_scene(tab))
    for _ in range(6):
        tab.page.mouse.wheel(0, -480)
    camera_when(tab, lambda camera: camera["eye"][1] < 0.5 * before["eye"][1])

    def of_size() -> bool:
        sizes = tab.scene.evaluate(MARKS)
        return sizes == {name: pytest.approx(CLOUDS[name.split("/")[-1]][0], rel=0.02) for name in sizes}

    tab.eventually(of_size, "the marks have another size")


def test_the_wheel_zooms(tab):
    before = camera_when(tab, looks_straight_down)
    tab.page.mouse.move(*middle_of_scene(tab))
    tab.page.mouse.wheel(0, -240)
    after = camera_when(tab, lambda camera: camera["eye"][1] < 0.95 * before["eye"][1])
    assert looks_straight_down(after)


def test_keys_in_the_scene_work_for_the_page_and_do_not_move_the_camera(tab):
    before = camera_at_rest(tab)
    tab.scene.locator("body").press("ArrowRight")
    tab.until("s.frame === 1")
    for key in ("w", "a", "q", "ArrowUp"):
        tab.scene.locator("body").press(key)
    tab.scene.locator("body").press("ArrowRight")
    tab.until("s.frame === 2")
    after = tab.scene.evaluate(CAMERA)
    for name in ("at", "eye", "up", "fov"):
        assert after[name] == pytest.approx(before[name], abs=1e-3), name


def test_the_free_view_turns_and_the_plan_comes_back(tab):
    before = camera_at_rest(tab)
    assert looks_straight_down(before)
    tab.page.keyboard.press("v")
    tab.until("s.camera === 'free'")
    camera_when(tab, lambda camera: not looks_straight_down(camera))
    tab.page.keyboard.press("v")
    tab.until("s.camera === 'plan'")
    after = camera_when(tab, looks_straight_down)
    assert after["at"] == pytest.approx(before["at"], abs=1e-6)
    assert after["up"] == PLAN_UP


def test_a_click_on_a_point_asks_why(tab):
    tab.choose_recording("1 perfect corner")
    state = tab.until("s.frames === 1")
    # The view fits the bounds of the recording anew, and what this frame sees beyond them.
    middle = [(state["bounds"][0] + state["bounds"][2]) / 2, (state["bounds"][1] + state["bounds"][3]) / 2]
    former = []

    def rests_near_the_middle(camera):
        former.append(camera)
        return former[-2:-1] == [camera] and camera["at"] == pytest.approx([-middle[1], 0, -middle[0]], abs=0.5)

    camera = camera_when(tab, rests_near_the_middle)
    middle = [-camera["at"][2], -camera["at"][0]]
    segment = state["segments"][0]
    x, y = ((segment["start"][k] + segment["end"][k]) / 2 for k in (0, 1))
    box = tab.page.locator("iframe").bounding_box()
    metres = 2 * (camera["eye"][1] - camera["at"][1]) * 0.08748866352592401 / box["height"]
    left, top = middle_of_scene(tab)
    tab.page.mouse.click(left + (x - middle[0]) / metres, top - (y - middle[1]) / metres)
    chosen = tab.until("s.selected !== null")
    assert chosen["explanation"]["segment"] == 0
    assert chosen["explanation"]["text"] in tab.page.locator(".explanation").inner_text()


def test_visers_own_panel_is_hidden(tab):
    camera_when(tab, looks_straight_down)
    assert tab.scene.locator("[data-floating-window]").first.is_hidden()


@pytest.mark.parametrize("size", [(1440, 900), (1024, 700)])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_overlaps_overflows_or_jumps(tab, size, scheme):
    tab.page.set_viewport_size({"width": size[0], "height": size[1]})
    tab.page.emulate_media(color_scheme=scheme)
    overflow = """() => {
        const { scrollWidth, scrollHeight } = document.scrollingElement;
        return [scrollWidth - innerWidth, scrollHeight - innerHeight];
    }"""
    assert tab.page.evaluate(overflow) == [0, 0]
    parts = """() => Object.fromEntries(["topbar", "stage", "replay", "panel", "timeline", "status"].map((id) => {
        const { x, y, width, height } = document.getElementById(id).getBoundingClientRect();
        return [id, [x, y, width, height]];
    }))"""
    places = """() => [...document.querySelectorAll(".threshold, .threshold *, .figure, #timeline > *")]
        .filter((element) => !element.closest("svg, .fit-mark") && !element.closest("[hidden]"))
        .map((element) => { const box = element.getBoundingClientRect(); return [box.x, box.y]; })"""
    before = tab.page.evaluate(parts), tab.page.evaluate(places)
    boxes = list(before[0].values())
    for one in boxes:
        assert one[2] > 0
        for other in boxes:
            apart = (
                one is other
                or one[0] + one[2] <= other[0] + 0.5
                or other[0] + other[2] <= one[0] + 0.5
                or one[1] + one[3] <= other[1] + 0.5
                or other[1] + other[3] <= one[1] + 0.5
            )
            assert apart, (one, other)
    tab.type_value("min_points", "100")
    tab.type_value("epsilon", "0.2")
    tab.page.keyboard.press("End")
    tab.until("s.frame === 299 && s.params.epsilon === 0.2")
    assert (tab.page.evaluate(parts), tab.page.evaluate(places)) == before


def test_every_control_has_a_name(tab):
    tab.page.keyboard.press("r")
    tab.until("s.step === 0")
    unnamed = tab.page.evaluate(
        """() => [...document.querySelectorAll("button, input, select, textarea, iframe")]
            .filter((element) => !element.closest("[hidden]") && element.type !== "file")
            .filter((element) => !(element.ariaLabel || element.title || element.innerText?.trim()))
            .filter((element) => !element.labels?.length)
            .map((element) => element.outerHTML.slice(0, 120))"""
    )
    assert unnamed == []


def test_a_link_is_shown_in_the_colours_of_the_page(tab):
    # A page of its own: a session that is resumed is told the whole View once more.
    fresh = tab.page.context.new_page()
    fresh.emulate_media(color_scheme="dark")
    fresh.goto(f"{tab.address}#recording=sample:hallway&frame=3")
    fresh.wait_for_function("window.lineseg?.state?.view.frame === 3 && lineseg.settled")
    assert fresh.evaluate("lineseg.state.view.dark") is True
    fresh.close()


def test_in_the_world_the_points_of_a_frame_are_where_a_click_finds_them(tab):
    tab.page.keyboard.press("g")
    state = tab.until("s.world !== null && s.view.space === 'world'")
    assert "scans, from the array poses" in state["poses"]
    tab.page.keyboard.press("Shift+ArrowRight")
    moved = tab.until("s.frame === 10")
    assert moved["world"]["pose"] != state["world"]["pose"]
    start = moved["segments"][0]["start"]
    box = tab.page.locator("iframe").bounding_box()
    at = tab.eventually(lambda: tab.page.evaluate("at => window.lineseg.project(...at)", start), "it is on the stage")
    tab.page.mouse.click(box["x"] + at[0], box["y"] + at[1])
    picked = tab.until("s.selected !== null")
    assert picked["explanation"]["at"] == pytest.approx(start, abs=0.3)
    tab.page.keyboard.press("g")
    assert tab.until("s.view.space === 'laser'")["world"] is None


# A hand that is faster than viser: it presses as soon as viser's page is there, before the server's first camera is.
PRESSED = """if (location.pathname.includes("/viser/"))
    addEventListener("load", () => setTimeout(() => dispatchEvent(new PointerEvent("pointerdown"))));"""


def test_a_press_before_the_scene_has_come_does_not_move_the_plan(profile: Profile, address: Address):
    page = profile.context.new_page()
    page.add_init_script(PRESSED)
    tab = Tab(page, f"{address.http}/").open("#recording=sample:hallway")
    tab.eventually(lambda: page.locator("iframe.scene.ready").count(), "no scene")
    resting = camera_at_rest(tab)
    assert looks_straight_down(resting)
    from_above = """([x, , z]) => {
        const [left, top] = lineseg.project(-z, -x);
        return [left / stage.clientWidth, top / stage.clientHeight];
    }"""
    assert page.evaluate(from_above, resting["at"]) == pytest.approx([0.5, 0.5], abs=0.01)
    assert "look=" not in page.url
    page.close()
