"""Recordings that load slowly or not at all."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from bags import bag1
from lineseg_app.server import Settings
from lineseg_app.session.sessions import SessionLimits
from lineseg_app.shelf import library
from lineseg_app.shelf.library import Library
from lineseg_app.shelf.recent import Recent
from lineseg_app.shelf.uploads import Uploads
from live import Address, Page, page_of, serving
from waiting import SECONDS
from websockets.exceptions import ConnectionClosed

from lineseg import Recording
from lineseg.readers import Cancelled, Progress, Reading, open_recording, parts


@pytest.fixture(scope="module")
def long(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A table of 20 000 sweeps, which takes about a second to read, and shows nothing before all of it is read."""
    file = tmp_path_factory.mktemp("long") / "long.log"
    file.write_text(f"{' '.join(['2.50'] * 181)}\n" * 20_000)
    return file


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch) -> threading.Event:
    """The long table is read no further than to where its progress is first told, until this is set."""
    go_on = threading.Event()

    def opened(path: Path, reading: Reading, *, progress: Progress, so_far: Callable[[Recording], None]) -> Recording:
        def told(done: int, total: int) -> None:
            progress(done, total)
            while path.name == "long.log" and not go_on.wait(0.05):
                progress(done, total)

        return open_recording(path, reading, progress=told, so_far=so_far)

    monkeypatch.setattr(library, "open_recording", opened)
    return go_on


@pytest.fixture
def shelf(recordings: Path, long: Path, tmp_path: Path) -> Iterator[Address]:
    with serving(Settings(files=(recordings / "walls.npz", long), data_folder=tmp_path)) as address:
        yield address


def ids(page: Page) -> dict[str, str]:
    return {entry["label"]: entry["id"] for entry in page.welcome["recordings"]}


def test_a_long_load_tells_its_progress(shelf: Address, held: threading.Event):
    with page_of(shelf) as page:
        page.hello()
        page.ask(recording=ids(page)["long.log"])
        told = [page.hear_a("loading")]
        held.set()
        while (message := page.hear_a("loading", "drawn"))["type"] == "loading":
            told.append(message)
        assert {message["label"] for message in told} == {"long.log"}
        assert [message["done"] for message in told] == sorted(message["done"] for message in told)
        assert all(message["done"] <= message["total"] for message in told)
        assert message["state"]["frames"] == 20_000


def test_a_load_can_be_cancelled_and_started_again(shelf: Address, held: threading.Event):
    with page_of(shelf) as page:
        page.hello(frame=3)
        rev = page.ask(recording=ids(page)["long.log"])
        page.hear_a("loading")
        page.say(type="cancel")
        error = page.hear_a("error")
        assert (error["where"], error["rev"], error["message"]) == ("recording", rev, "loading long.log was cancelled")
        state = page.change(params={"epsilon": 0.04})
        assert (state["label"], state["frame"]) == ("walls.npz", 3)
        held.set()
        assert page.change(recording=ids(page)["long.log"])["label"] == "long.log"


def test_another_choice_ends_a_load(shelf: Address, held: threading.Event):
    with page_of(shelf) as page:
        page.hello()
        page.ask(recording=ids(page)["long.log"])
        page.hear_a("loading")
        assert page.change(recording=ids(page)["walls.npz"])["label"] == "walls.npz"


def test_a_load_that_one_tab_cancels_continues_for_another(long: Path, tmp_path: Path):
    library = Library([long], Recent(tmp_path), Uploads(1, 1, 1))
    with pytest.raises(Cancelled):
        library.recording(library.first(), wanted=lambda: False)
    assert len(library.recording(library.first())) == 20_000
    assert library.recording(library.first()) is library.recording(library.first())


def test_a_broken_file_of_the_command_line_is_reported_and_a_sample_is_shown(tmp_path: Path):
    broken = [tmp_path / "broken.bag", tmp_path / "empty.npz"]
    broken[0].write_bytes(b"#ROSBAG V2.0\nnothing")
    broken[1].write_bytes(b"")
    with serving(Settings(files=tuple(broken), data_folder=tmp_path / "data")) as server, page_of(server) as page:
        page.say(type="hello")
        assert "broken.bag" in page.hear_a("error")["message"]
        assert "empty.npz" in page.hear_a("error")["message"]
        assert page.hear_a("drawn")["state"]["format"] == "NPZ"


def test_a_topic_that_is_not_in_the_file_is_reported(recordings: Path, tmp_path: Path):
    settings = Settings(files=(recordings / "walls.npz",), reading=Reading(topic="/rear"), data_folder=tmp_path)
    with serving(settings) as server, page_of(server) as page:
        page.say(type="hello", view={"frame": 2})
        assert "/rear" in page.hear_a("error", "drawn").get("message", "")


def test_every_file_of_the_command_line_is_read_as_it_says(recordings: Path, tmp_path: Path):
    other = tmp_path / "other.npz"
    other.write_bytes((recordings / "walls.npz").read_bytes())
    settings = Settings(files=(recordings / "walls.npz", other), reading=Reading(every_scan=2), data_folder=tmp_path)
    with serving(settings) as server, page_of(server) as page:
        page.hello()
        entries = [each for each in page.welcome["recordings"] if each["group"] == "Command line"]
        assert [(each["label"], each["reading"]) for each in entries] == [
            ("walls.npz", {"every_scan": 2}),
            ("other.npz", {"every_scan": 2}),
        ]


def test_a_tab_without_input_for_long_is_closed(tmp_path: Path):
    with serving(Settings(data_folder=tmp_path, sessions=SessionLimits(idle=0.2))) as server, page_of(server) as page:
        page.say(type="hello")
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                page.hear()
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 4001


@pytest.fixture
def halfway(monkeypatch: pytest.MonkeyPatch) -> threading.Event:
    """A long bag is read no further than to its first part until this is set."""
    go_on = threading.Event()

    def held(path: Path, reading: Reading, *, progress: Progress, so_far: Callable[[Recording], None]) -> Recording:
        def show(part: Recording) -> None:
            so_far(part)
            waited = 0
            while not go_on.wait(0.05):
                waited += 1
                progress(waited, 1_000_000)

        return open_recording(path, reading, progress=progress, so_far=show)

    monkeypatch.setattr(parts, "FIRST", 0.0)
    monkeypatch.setattr(library, "open_recording", held)
    return go_on


@pytest.fixture
def bag_shelf(recordings: Path, tmp_path: Path) -> Iterator[Address]:
    bag = bag1(tmp_path / "long.bag", ("/scan", [2.0] * 90), stamps=[100 + 0.025 * k for k in range(400)])
    with serving(Settings(files=(recordings / "walls.npz", bag), data_folder=tmp_path)) as address:
        yield address


def test_the_first_scans_of_a_bag_are_shown_while_the_rest_is_read(bag_shelf: Address, halfway: threading.Event):
    with page_of(bag_shelf) as page:
        page.hello()
        state = page.change(recording=ids(page)["long.bag"])
        first = state["frames"]
        assert state["growing"]
        assert 0 < first < 400
        assert page.hear_a("loading")["behind"]
        assert page.change(frame=first - 1)["frame"] == first - 1
        assert page.change(params={"epsilon": 0.04})["growing"]
        wanted = page.ask(frame=300)
        halfway.set()
        state = page.drawn(wanted)["state"]
        assert (state["frame"], state["frames"], state["growing"]) == (300, 400, False)
        assert page.last["times"]["since"][-1] == pytest.approx(0.025 * 399)


def test_what_was_read_stays_when_a_person_stops_it(bag_shelf: Address, halfway: threading.Event):
    with page_of(bag_shelf) as page:
        page.hello()
        first = page.change(recording=ids(page)["long.bag"])["frames"]
        page.say(type="cancel")
        state = page.until(lambda state: not state["growing"])
        assert state["frames"] == first
        (notice,) = (each for each in state["account"]["notices"] if each["kind"] == "not all")
        assert f"the first {first} scans" in notice["text"]
        assert page.change(frame=first - 1, params={"epsilon": 0.05})["frames"] == first
        halfway.set()
        page.change(recording=ids(page)["walls.npz"])
        assert page.change(recording=ids(page)["long.bag"])["label"] == "long.bag"
        assert page.until(lambda state: not state["growing"])["frames"] == 400


def test_leaving_a_bag_that_is_read_stops_reading_it(bag_shelf: Address, halfway: threading.Event):
    with page_of(bag_shelf) as page:
        page.hello()
        assert page.change(recording=ids(page)["long.bag"])["growing"]
        page.change(recording=ids(page)["walls.npz"])
        loads = [thread for thread in threading.enumerate() if thread.name == "load long.bag"]
        for load in loads:
            load.join(SECONDS)
        assert not any(load.is_alive() for load in loads)


@pytest.mark.parametrize("fate", ["deleted", "grows", "replaced"])
def test_a_bag_that_changes_while_it_is_read_is_shown_as_it_was_and_read_once(
    bag_shelf: Address, halfway: threading.Event, tmp_path: Path, fate: str
):
    bag = tmp_path / "long.bag"
    with page_of(bag_shelf) as page:
        page.hello()
        assert page.change(recording=ids(page)["long.bag"])["growing"]
        if fate == "grows":
            with bag.open("ab") as file:
                file.write(b"more")
        else:
            bag.unlink()
        if fate == "replaced":
            bag.write_text("nothing")
        halfway.set()
        while (message := page.hear_a("drawn", "error"))["type"] == "drawn" and message["state"]["growing"]:
            pass
        assert message["type"] == "drawn"
        assert message["state"]["frames"] == 400


def test_a_bag_that_is_gone_when_one_comes_back_to_its_first_scans_is_told_once(
    bag_shelf: Address, halfway: threading.Event, tmp_path: Path
):
    with page_of(bag_shelf) as page:
        page.hello()
        first = page.change(recording=ids(page)["long.bag"])["frames"]
        (tmp_path / "long.bag").unlink()
        page.refused(recording="sample:none")
        halfway.set()
        state = page.until(lambda state: not state["growing"])
        assert (state["label"], state["frames"]) == ("long.bag", first)
        (notice,) = (each for each in state["account"]["notices"] if each["kind"] == "not all")
        assert "is no longer in" in notice["text"]


def test_a_tab_goes_on_with_what_was_read_of_a_file_that_is_gone(recordings: Path, tmp_path: Path):
    walls = tmp_path / "walls.npz"
    walls.write_bytes((recordings / "walls.npz").read_bytes())
    with serving(Settings(files=(walls,), data_folder=tmp_path / "data")) as server:
        with page_of(server) as page:
            recording = page.hello()["recording"]
            walls.unlink()
            assert page.change(frame=3)["frame"] == 3
            assert page.change(params={"epsilon": 0.05})["params"]["epsilon"] == 0.05
        with page_of(server) as other:
            assert other.hello(recording=recording, frame=2)["frame"] == 2
            assert "is no longer in" in other.refused(reading={"every_beam": 2})["message"]
