"""Exports that open again: pictures, failure packs, segments; links, and links to missing files."""

from __future__ import annotations

import json
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

from lineseg import Params, extract, open_recording, read_pack, write_pack

HALLWAY = Path(__file__).parents[2] / "sample_scans" / "hallway.npz"


def choose(tab, entry: str, group: str = ""):
    """An entry of the menu; group: its heading, where several have an entry of this name."""
    tab.page.get_by_role("button", name="Export").click()
    among = tab.page.get_by_role("group", name=group) if group else tab.page
    among.get_by_role("menuitem", name=entry, exact=True).click()


def saved(tab, entry: str, folder: Path, group: str = "") -> Path:
    with tab.page.expect_download() as download:
        choose(tab, entry, group)
    place = folder / download.value.suggested_filename
    download.value.save_as(place)
    return place


def test_the_frame_is_taken_along_as_a_picture_and_all_segments_as_files(new_tab, tmp_path):
    tab = new_tab("#frame=17&epsilon=0.02")
    tab.page.get_by_role("button", name="Export").click()
    headings = tab.page.locator(".menu:popover-open .menu-title").all_inner_texts()
    assert headings[:4] == ["This frame", "Segments of all frames", "Line map", "Parameters"]
    tab.page.keyboard.press("Escape")
    found = extract(open_recording(HALLWAY)[17], Params(epsilon=0.02)).segments
    svg = saved(tab, "Picture (SVG)", tmp_path)
    assert svg.name == "Hallway_simulated__17.svg"
    assert svg.read_text().count('class="segment"') == len(found)
    assert "frame 17 of 0–299" in svg.read_text(encoding="utf-8")
    png = saved(tab, "Picture (PNG)", tmp_path).read_bytes()
    width, height = np.frombuffer(png[16:24], ">u4")
    assert (png[:8], width, height) == (b"\x89PNG\r\n\x1a\n", 1920, 1440)
    features = json.loads(saved(tab, "GeoJSON", tmp_path, "Segments of all frames").read_text())["features"]
    mine = [feature for feature in features if feature["properties"]["frame"] == 17]
    assert [feature["properties"]["first"] for feature in mine] == [line.first for line in found]
    rows = saved(tab, "CSV", tmp_path).read_text().splitlines()
    assert len(rows) == 1 + len(features)


def test_the_frame_and_the_lesson_are_taken_home_as_pages(new_tab, tmp_path):
    tab = new_tab("#mode=learn&lesson=01_seed")
    tab.until("s.view.lesson === '01_seed' && s.recording === 'lesson:8_noise_burst'")
    page = saved(tab, "This lesson as an interactive page (HTML)", tmp_path)
    assert page.name == "01_seed.html" and "<title>What a seed is</title>" in page.read_text("utf-8")
    page = saved(tab, "Interactive page (HTML)", tmp_path)
    assert page.name.endswith("_0.html") and "frame 0</title>" in page.read_text("utf-8")


def test_a_failed_export_is_reported_and_a_long_one_can_be_cancelled(new_tab):
    tab = new_tab()
    tab.page.route("**/api/segments?*", lambda route: route.abort())
    choose(tab, "JSON lines")
    alert = tab.page.locator(".notice.error")
    tab.eventually(lambda: "the connection was lost" in alert.inner_text(), "nothing says that the export broke")
    tab.page.unroute("**/api/segments?*")
    tab.page.route("**/api/segments?*", lambda route: None)
    choose(tab, "JSON lines")
    loading = tab.page.locator(".notice.loading")
    tab.eventually(lambda: "Writing the segments" in loading.inner_text(), "nothing says what is under way")
    loading.get_by_role("button", name="Cancel").click()
    loading.wait_for(state="hidden")
    assert alert.is_hidden()
    tab.forgive("ERR_FAILED")


def test_a_failure_pack_opens_again_by_drag_and_drop_with_its_parameters_and_its_note(new_tab, tmp_path):
    tab = new_tab("#frame=17&epsilon=0.02&mode=inspect")
    choose(tab, "Failure pack…")
    tab.page.get_by_label("What is wrong here?").fill("the door is bridged\n– why?")
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save").click()
    pack = tmp_path / download.value.suggested_filename
    download.value.save_as(pack)
    assert read_pack(pack).note == "the door is bridged\n– why?"
    with zipfile.ZipFile(pack) as content:
        assert {"frame.npz", "frame.csv", "segments.jsonl", "trace.jsonl", "picture.svg"} <= set(content.namelist())
    before = tab.state
    other = new_tab("#epsilon=0.05")
    drop(other, pack)
    state = other.until("s.pack !== null && s.params.epsilon === 0.02")
    assert (state["frames"], state["segments"]) == (1, before["segments"])
    other.page.get_by_role("button", name="Inspect").click()
    other.page.locator(".frames").get_by_text("one frame: nothing to compare").wait_for()
    card = other.page.get_by_role("region", name="Failure pack")
    assert "the door is bridged\n– why?" in card.inner_text()
    assert "frame 17 of hallway.npz" in card.inner_text()
    other.page.keyboard.press("Control+z")
    other.until("s.params.epsilon === 0.05")
    card.get_by_role("button", name="Use its parameters").click()
    other.until("s.params.epsilon === 0.02")
    choose(other, "Failure pack…")
    assert other.page.get_by_label("Note of this frame").input_value() == "the door is bridged\n– why?"


def drop(tab, file: Path) -> None:
    script = """([name, bytes]) => {
        const data = new DataTransfer();
        data.items.add(new File([new Uint8Array(bytes)], name));
        for (const kind of ["dragenter", "dragover", "drop"])
            document.body.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
    }"""
    tab.page.evaluate(script, [file.name, list(file.read_bytes())])


def test_a_damaged_pack_is_refused_in_a_sentence(tab, tmp_path):
    write_pack(tmp_path / "door.zip", open_recording(HALLWAY), 17)
    (tmp_path / "door.zip").write_bytes((tmp_path / "door.zip").read_bytes()[:3000])
    drop(tab, tmp_path / "door.zip")
    alert = tab.page.locator(".notice.error")
    tab.eventually(lambda: "door.zip" in alert.inner_text(), "nothing says what is wrong with the pack")
    assert tab.state["recording"] == "sample:hallway"


LINK = (
    "#mode=inspect&recording=sample:laboratory&frame=20&method=split-and-merge-textbook&split_threshold=0.08"
    "&beam=100&look=1.00,-0.50,4.00&score=gap&against=region-growing,epsilon:0.05&weights=gap:4&layers=normals,-grid"
)


def test_a_link_holds_all_of_it(new_tab):
    tab = new_tab(LINK)
    state = tab.until("s.recording === 'sample:laboratory' && s.frame === 20")
    assert (state["mode"], state["method"], state["selected"]) == ("inspect", "split-and-merge-textbook", 100)
    assert (state["score"], state["weights"]["gap"]) == ("gap", 4)
    assert state["against"]["params"]["epsilon"] == 0.05
    assert (state["layers"]["normals"], state["layers"]["grid"]) == (True, False)
    tab.eventually(lambda: span_of(tab) == pytest.approx(4.0, abs=0.01), "the link's part of the plan is not in view")
    tab.page.wait_for_function("location.hash.includes('look=1.00,-0.50,4.00')")
    tab.page.keyboard.press("f")
    tab.page.wait_for_function("!location.hash.includes('look=')")
    tab.page.mouse.move(400, 400)
    tab.page.mouse.wheel(0, -400)
    tab.page.wait_for_function("location.hash.includes('look=')")
    link = tab.page.evaluate("location.hash")
    (looked,) = map(float, re.findall(r"look=[-.\d]+,[-.\d]+,([.\d]+)", link))
    twin = new_tab(link)
    tab.eventually(lambda: span_of(twin) == pytest.approx(looked, abs=0.02), "the twin looks elsewhere")


def span_of(tab) -> float:
    """Height of the visible plan in metres."""
    return 2 * tab.scene.evaluate("() => window.__viserMutable.cameraControl.distance") * np.tan(np.radians(5))


@pytest.mark.own_tab
def test_a_link_to_a_missing_file_says_so_and_applies_once_the_file_is_opened(new_tab):
    link = "#mode=inspect&recording=file:0123456789ab&name=hallway.npz&frame=17&epsilon=0.02&beam=40"
    tab = new_tab(link)
    assert tab.state["recording"] == "sample:hallway"
    alert = tab.page.locator(".notice.error")
    assert "does not know the file of this link" in alert.inner_text()
    assert "Open hallway.npz or drop it here" in alert.inner_text()
    assert tab.page.evaluate("location.hash") == link
    with tab.page.expect_file_chooser() as chooser:
        alert.get_by_role("button", name="Open file").click()
    chooser.value.set_files([HALLWAY])
    state = tab.until("s.recording.startsWith('upload:')")
    assert (state["frame"], state["params"]["epsilon"], state["selected"], state["mode"]) == (17, 0.02, 40, "inspect")
    assert alert.is_hidden()
    tab.page.wait_for_function("/recording=upload:.*&name=hallway.npz&frame=17/.test(location.hash)")


@pytest.mark.own_tab
def test_opening_something_else_replaces_the_link(new_tab):
    tab = new_tab("#recording=upload:gone&frame=17&epsilon=0.02")
    assert "no longer on the server" in tab.page.locator(".notice.error").inner_text()
    tab.page.keyboard.press("ArrowRight")
    tab.page.wait_for_function("location.hash === '#recording=sample:hallway&frame=1'")
    assert re.match("Open the file or drop it here", tab.page.locator(".notice.error .muted").inner_text())
