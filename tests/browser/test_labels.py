"""Labels in the page: true lines drawn, dragged, split, merged, deleted; tags and notes; saved at once, never lost."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from lineseg_app.places import data_folder
from lineseg_app.server import Settings
from live import serving

from lineseg import TrueLine, extract, open_recording, read_labels

FRAME = 4


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return Path(shutil.copy(data_folder("sample_scans") / "hallway.npz", tmp_path / "hall.npz"))


@pytest.fixture
def sidecar(file: Path) -> Path:
    return file.with_name("hall.npz.lineseg.json")


@pytest.fixture
def hall(file: Path):
    return open_recording(file)


@pytest.fixture
def served(file: Path, tmp_path: Path):
    with serving(Settings(files=(file,), data_folder=tmp_path / "user")) as address:
        yield f"{address.http}/"


class Labeller:
    """A tab with the page Labels, and its label file."""

    def __init__(self, tab, sidecar: Path, recording) -> None:
        self.tab, self.page = tab, tab.page
        self._sidecar, self._recording = sidecar, recording

    def begin(self, frame: int = FRAME) -> Labeller:
        self.page.get_by_role("tab", name="Labels").click()
        self.tab.until(f"s.mode === 'inspect' && s.frame === {frame} && s.labels !== null")
        return self

    def go(self, frame: int) -> None:
        self.page.evaluate("(frame) => { location.hash += `&frame=${frame}` }", frame)
        self.tab.until(f"s.frame === {frame}")

    def runs(self, frame: int = FRAME) -> list[tuple[int, int]] | None:
        """The true lines in the file, once everything is saved."""
        self.page.locator(".labels-status[data-status=saved]").wait_for()
        lines = read_labels(self._sidecar, self._recording)[frame].lines if self._sidecar.exists() else None
        return None if lines is None else [(line.first, line.last) for line in lines]

    def until_runs(self, runs: list[tuple[int, int]]) -> None:
        self.tab.eventually(lambda: self.runs() == runs, f"the file never held {runs}, but {self.runs()}")

    def choose(self, line: int) -> None:
        self.page.locator(".labels-list tbody tr").nth(line).click()
        # Its handles are there once the points of the frame are.
        self.grip("last").wait_for()

    def grip(self, name: str):
        return self.page.locator(f".label-grip.{name}:not([hidden])")

    def place(self, beam: int) -> tuple[float, float]:
        """Position of the point of a beam on the screen; a handle of the selected line is moved there first."""
        x, y = self._recording[FRAME].xy[beam]
        box = self.page.locator("iframe.scene").bounding_box()
        left, top = self.page.evaluate("([x, y]) => window.lineseg.project(x, y)", [float(x), float(y)])
        return box["x"] + left, box["y"] + top

    def drag(self, start: tuple[float, float], beam: int) -> None:
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.mouse.move(*self.place(beam), steps=6)
        self.page.mouse.up()

    def drag_grip(self, name: str, beam: int) -> None:
        box = self.grip(name).bounding_box()
        self.drag((box["x"] + box["width"] / 2, box["y"] + box["height"] / 2), beam)


@pytest.fixture
def label(served, new_tab, sidecar, hall):
    def open_labeller(hash: str = f"#mode=inspect&frame={FRAME}") -> Labeller:
        return Labeller(new_tab(hash, at=served), sidecar, hall).begin()

    return open_labeller


def test_true_lines_are_begun_with_the_result_and_dragged_split_merged_deleted_drawn_and_undone(label, hall, sidecar):
    labeller = label()
    scan = hall[FRAME]
    result = [(line.first, line.last) for line in extract(scan).segments]
    assert labeller.runs() is None
    (first, last), rest = result[0], result[1:]
    labeller.choose(0)
    labeller.page.keyboard.press("s")
    middle = labeller.tab.eventually(lambda: (labeller.runs() or [(0, 0)])[0][1], "nothing was split")
    assert first < middle < last
    split = [(first, middle), (middle + 1, last), *rest]
    labeller.until_runs(split)
    end = middle - 12
    labeller.drag_grip("last", end)
    shorter = [(first, end), *split[1:]]
    labeller.until_runs(shorter)
    kept = read_labels(sidecar, hall)[FRAME].lines
    assert kept is not None
    assert kept[0] == TrueLine.over(scan, first, end)
    labeller.grip("last").press("ArrowRight")
    labeller.until_runs([(first, end + 1), *split[1:]])
    labeller.grip("first").press("Shift+ArrowRight")
    labeller.until_runs([(first + 10, end + 1), *split[1:]])
    labeller.page.keyboard.press("m")
    labeller.until_runs([(first + 10, last), *rest])
    labeller.page.keyboard.press("Delete")
    labeller.until_runs(rest)
    for expected in ([(first + 10, last), *rest], [(first + 10, end + 1), *split[1:]]):
        labeller.page.keyboard.press("Control+z")
        labeller.until_runs(expected)
    labeller.page.keyboard.press("Control+Shift+z")
    labeller.page.keyboard.press("Control+Shift+z")
    labeller.until_runs(rest)
    labeller.page.keyboard.press("a")
    labeller.drag(labeller.place(first + 5), last - 5)
    labeller.until_runs([(first + 5, last - 5), *rest])
    labeller.page.reload()
    labeller.begin()
    rows = labeller.page.locator(".labels-list tbody tr")
    labeller.tab.eventually(lambda: rows.count() == len(result), "the lines are gone after a reload")
    assert f"{first + 5}–{last - 5}" in rows.first.inner_text()
    labeller.page.mouse.click(*labeller.place((rest[0][0] + rest[0][1]) // 2))
    labeller.tab.eventually(lambda: "current" in (rows.nth(1).get_attribute("class") or ""), "a click chose no line")
    labeller.page.keyboard.press("Escape")
    labeller.grip("last").wait_for(state="detached")


def test_two_tabs_lose_no_edit_and_a_conflict_is_reported(label, hall, sidecar):
    one, other = label(), label()
    rest = [(line.first, line.last) for line in extract(hall[FRAME]).segments][1:]
    one.choose(0)
    one.page.keyboard.press("Delete")
    one.until_runs(rest)
    other.tab.until(f"s.labels.lines?.length === {len(rest)}")
    rows = other.page.locator(".labels-list tbody tr")
    other.tab.eventually(lambda: rows.count() == len(rest), "the other tab does not show the edit")
    other.go(FRAME + 1)
    other.page.get_by_label("Note", exact=True).fill("from the other tab")
    other.page.get_by_label("Note", exact=True).blur()
    other.runs()
    assert {frame: said.note for frame, said in read_labels(sidecar, hall).items()} == {
        FRAME: "",
        FRAME + 1: "from the other tab",
    }
    # Both write on top of the same: the slower one is told, and may insist.
    other.go(FRAME)
    other.page.route("**/api/labels", lambda route: held.append(route))
    held: list = []
    other.page.get_by_label("Add a tag").fill("theirs")
    other.page.get_by_label("Add a tag").press("Enter")
    other.tab.eventually(lambda: held, "nothing was sent")
    one.page.get_by_label("Add a tag").fill("mine")
    one.page.get_by_label("Add a tag").press("Enter")
    one.runs()
    held[0].continue_()
    other.page.unroute("**/api/labels")
    told = other.page.get_by_role("alert").filter(has_text="at the same time. You see its version")
    told.wait_for()
    other.tab.forgive("409")
    assert read_labels(sidecar, hall)[FRAME].tags == ("mine",)
    assert other.page.locator(".labels-tag").all_inner_texts() == ["mine"]
    other.page.get_by_role("button", name="Save mine instead").click()
    other.tab.eventually(lambda: read_labels(sidecar, hall)[FRAME].tags == ("theirs",), "mine was not saved")
    told.wait_for(state="hidden")
    # So is a note that another has written meanwhile, on top of all that was said before.
    one.tab.until("s.labels.tags.join() === 'theirs'")
    note = other.page.get_by_label("Note", exact=True)
    note.focus()
    note.evaluate("(field) => { field.value = 'half a word' }")
    one.page.get_by_label("Note", exact=True).fill("a whole note")
    one.page.get_by_label("Note", exact=True).blur()
    other.tab.until("s.labels.note === 'a whole note'")
    note.blur()
    told.wait_for()
    assert (note.input_value(), read_labels(sidecar, hall)[FRAME].note) == ("a whole note", "a whole note")


def test_tags_and_notes_are_kept_undone_and_filter_the_frames(label, hall, sidecar):
    labeller = label()
    page, tab = labeller.page, labeller.tab
    for tag in ("glass", "door"):
        page.get_by_label("Add a tag").fill(tag)
        page.get_by_label("Add a tag").press("Enter")
    note = page.get_by_label("Note", exact=True)
    note.fill("the pane\nof the entrance")
    note.blur()
    labeller.runs()
    said = read_labels(sidecar, hall)[FRAME]
    assert (said.lines, said.tags, said.note) == (None, ("glass", "door"), "the pane\nof the entrance")
    page.keyboard.press("Control+z")
    tab.eventually(lambda: read_labels(sidecar, hall)[FRAME].note == "", "the note was not undone")
    page.keyboard.press("Control+Shift+z")
    page.get_by_role("button", name="Remove the tag door").click()
    tab.eventually(lambda: read_labels(sidecar, hall)[FRAME].tags == ("glass",), "the tag was not removed")
    page.get_by_role("tab", name="Frames").click()
    row = page.locator(".frames-row")

    def listed() -> list[str]:
        return row.evaluate_all("(rows) => rows.map((row) => row.dataset.frame)")

    tag = page.get_by_label("Show only frames with this tag")
    tab.eventually(lambda: "#glass (1)" in tag.inner_text(), "the tag is not offered")
    tag.select_option(label="#glass (1)")
    tab.eventually(lambda: listed() == [str(FRAME)], "not filtered")
    said = page.locator(".frames-said")
    # Drawn a moment after the frame's tags are saved.
    tab.eventually(lambda: "#glass the pane of the entrance" in said.inner_text(), "the tags in the list are old")
    tag.select_option(label="any tag")
    words = page.get_by_label(re.compile("Show only frames with these words"))
    words.fill("ENTRANCE")
    tab.eventually(lambda: listed() == [str(FRAME)], "not searched")
    words.fill("nothing says this")
    page.get_by_text("0 of 300 frames", exact=True).wait_for()
    words.press("Escape")
    page.get_by_text("300 frames", exact=True).wait_for()


def test_a_saved_edit_survives_a_kill_of_the_server_and_an_unsaved_one_is_saved_later(
    killable_server, new_tab, tmp_path
):
    tab = new_tab(f"#mode=inspect&recording=sample:hallway&frame={FRAME}", at=killable_server.http)
    hall = open_recording(data_folder("sample_scans") / "hallway.npz")
    tab.page.get_by_role("tab", name="Labels").click()
    tab.until("s.labels !== null")
    rows = tab.page.locator(".labels-list tbody tr")
    lines = len(extract(hall[FRAME]).segments)
    rows.first.click()
    tab.page.keyboard.press("Delete")
    tab.page.locator(".labels-status[data-status=saved]").wait_for()
    killable_server.kill()
    (sidecar,) = (tmp_path / "lineseg" / "labels").iterdir()
    assert len(read_labels(sidecar, hall)[FRAME].lines or ()) == lines - 1
    rows.first.click()
    tab.page.keyboard.press("Delete")
    tab.page.get_by_text("Not saved: the server does not answer").wait_for()
    assert rows.count() == lines - 2
    killable_server.start()
    tab.page.locator(".labels-status[data-status=saved]").wait_for()
    assert len(read_labels(sidecar, hall)[FRAME].lines or ()) == lines - 2
    tab.page.reload()
    tab.until(f"s.labels?.lines?.length === {lines - 2}")
    tab.forgive("WebSocket connection", "ERR_CONNECTION_REFUSED", "Failed to load resource")


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("{", "this is not JSON"),
        ('{"format": "lineseg labels", "version": 9}', "have version 9, but this lineseg reads 1; update lineseg"),
    ],
)
def test_unreadable_labels_are_reported_with_their_path_and_kept(label, sidecar, content, sentence):
    sidecar.write_text(content)
    labeller = label()
    labeller.page.get_by_role("alert").filter(has_text=sentence).wait_for()
    assert labeller.tab.state["segments"]
    labeller.choose(0)
    labeller.page.keyboard.press("Delete")
    assert labeller.page.get_by_label("Note", exact=True).is_disabled()
    assert labeller.page.get_by_role("button", name="Delete").is_disabled()
    assert sidecar.read_text() == content


def test_a_save_that_is_refused_says_why_and_is_tried_again(label, sidecar, hall):
    labeller = label()
    labeller.choose(0)
    sidecar.mkdir()
    labeller.page.keyboard.press("Delete")
    labeller.page.locator(".labels-status").get_by_text("Not saved:").wait_for()
    assert "Is a directory" in labeller.page.locator(".labels-status[role=status]").inner_text()
    sidecar.rmdir()
    labeller.page.get_by_role("button", name="Try again").click()
    labeller.until_runs([(line.first, line.last) for line in extract(hall[FRAME]).segments][1:])
    labeller.tab.forgive("507")


def test_segments_are_compared_with_labels_or_walls_as_selected(label, hall, sidecar):
    labeller = label()
    page, tab = labeller.page, labeller.tab
    page.get_by_role("button", name="They are right").click()
    tab.until("s.judgedBy === 'labels'")
    page.get_by_role("tab", name="Truth").click()
    by = page.get_by_label("Compared with")
    row = page.locator(".truth-table tr:has(th:text-is('TR'))")
    tab.eventually(lambda: row.locator("td").all_inner_texts() == ["100.0 %"] * 2, "its own lines are not its truth")
    labeller.go(FRAME + 1)
    page.get_by_text("The lines of this frame are not labelled.").wait_for()
    assert row.locator("td").first.inner_text() == "–"
    by.select_option("wall")
    assert tab.until("s.judgedBy === 'wall'")["agreement"]["trueLines"] > 0
    tab.eventually(lambda: "reference=wall" in page.evaluate("location.hash"), "the link does not say it")
