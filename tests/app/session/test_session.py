"""A browser tab from hello to close."""

from __future__ import annotations

import asyncio
import gc
import itertools
import threading

import pytest
from lineseg_app.frame.findings import Findings
from lineseg_app.server import Settings
from lineseg_app.session.pace import QUICK_TURN
from lineseg_app.session.session import Session
from lineseg_app.session.sessions import SessionLimits, Sessions, TooManySessionsError
from lineseg_app.session.warm_up import WarmUp
from lineseg_app.shelf import library
from lineseg_app.shelf.label_files import LabelFiles
from lineseg_app.shelf.library import Library
from lineseg_app.shelf.recent import Recent
from lineseg_app.shelf.uploads import Uploads
from lineseg_app.view import View
from live import Address, Page, leave, page_of, serving
from waiting import SECONDS, eventually
from websockets.exceptions import ConnectionClosed


def id_of(page: Page, label: str) -> str:
    return next(entry["id"] for entry in page.welcome["recordings"] if entry["label"] == label)


def test_a_new_tab_shows_the_first_file_of_the_command_line(page: Page):
    state = page.hello()
    assert (state["label"], state["frame"], state["frames"]) == ("walls.npz", 0, 5)
    assert state["beams"] == 180
    assert [segment["first"] for segment in state["segments"]] == [0]


def test_the_welcome_describes_every_threshold(page: Page):
    page.hello()
    method = page.welcome["methods"][0]
    knobs = {knob["name"]: knob for knob in method["knobs"]}
    assert list(knobs)[:5] == ["epsilon", "delta", "seed_points", "min_points", "min_length"]
    assert (knobs["epsilon"]["symbol"], knobs["epsilon"]["kind"], knobs["epsilon"]["default"]) == ("ε", "float", 0.03)
    assert [name for name, knob in knobs.items() if knob["extension"]] == [
        "max_dropout",
        "max_gap",
        "merge_angle",
        "merge_rms",
        "max_occluder",
        "max_void",
        "epsilon_growth",
    ]


def test_a_threshold_changes_the_segments(page: Page):
    assert len(page.hello()["segments"]) == 1
    assert page.change(params={"min_length": 30.0})["segments"] == []
    assert len(page.change(params={"min_length": 0.6})["segments"]) == 1


def test_thresholds_that_were_not_named_stay(page: Page):
    page.hello()
    page.change(params={"epsilon": 0.05})
    assert page.change(params={"delta": 0.2})["params"]["epsilon"] == 0.05


def test_a_frame_beyond_the_end_is_the_last(page: Page):
    page.hello()
    assert page.change(frame=99)["frame"] == 4


def test_another_recording_begins_at_its_first_frame(page: Page):
    page.hello(frame=3)
    page.change(step=4, selected=7)
    state = page.change(recording=id_of(page, "corner.npz"))
    assert (state["label"], state["frame"], state["step"], state["selected"]) == ("corner.npz", 0, None, None)


def test_the_newest_of_many_changes_wins(page: Page):
    page.hello()
    revs = [page.ask(params={"epsilon": 0.01 + 0.001 * k}, frame=k % 5) for k in range(40)]
    told = [page.hear_a("drawn")]
    while told[-1]["rev"] < revs[-1]:
        told.append(page.hear_a("drawn"))
    assert told[-1]["state"]["params"]["epsilon"] == pytest.approx(0.049)
    assert told[-1]["state"]["frame"] == 4
    assert [message["rev"] for message in told] == sorted(message["rev"] for message in told)


def test_a_bad_threshold_is_refused_and_the_old_one_stays(page: Page):
    page.hello()
    error = page.refused(params={"seed_points": 2})
    assert (error["where"], error["rev"]) == ("params", 1)
    assert "any 2 points fit a line exactly" in error["message"]
    assert page.change(frame=1)["params"]["seed_points"] == 6


@pytest.mark.parametrize(
    ("patch", "where", "named"),
    [
        ({"params": {"epsilon": float("nan")}}, "params", "epsilon"),
        ({"params": {"epsilon": "0.1"}}, "params", "epsilon"),
        ({"params": {"gamma": 1.0}}, "params", "gamma"),
        ({"layers": {"clouds": True}}, "view", "clouds"),
        ({"frame": -1}, "view", "frame"),
        ({"frame": 1.5}, "view", "frame"),
        ({"zoom": 3}, "view", "zoom"),
        ({"method": "guessing"}, "view", "guessing"),
        ({"recording": "x" * 9000}, "view", "recording"),
    ],
)
def test_an_invalid_view_gets_one_sentence(page: Page, patch, where, named):
    page.hello()
    error = page.refused(**patch)
    assert (error["where"], error["rev"]) == (where, 1)
    assert named in error["message"]
    assert "\n" not in error["message"]
    assert page.change(frame=2)["frame"] == 2


def test_a_first_message_with_any_view_gets_a_picture(page: Page):
    state = page.hello(frame=2, mode="zz", topic="x" * 400, selected=3e99, params={"self": 1, "delta": 0.3}, zoom=[])
    assert (state["frame"], state["mode"], state["params"]["delta"]) == (2, "tune", 0.3)
    assert page.last["error"]["message"].startswith("mode is 'zz'")


def test_halves_of_characters_are_told_and_the_tab_opens(page: Page):
    page.say(type="hello", view={"recording": "\ud83d", "topic": "\udc00", "params": {"epsilon": 0.05}})
    assert page.hear()["type"] == "welcome"
    assert "there is no recording '�'" in page.hear_a("error")["message"]
    assert page.hear_a("drawn")["state"]["label"]


def test_a_link_opened_in_a_tab_is_applied_as_far_as_possible(page: Page):
    page.hello()
    page.say(type="link", rev=1, patch={"frame": 2, "params": {"epsilon": -1, "delta": 0.3}})
    state = page.drawn_or_told(1)
    assert (state["frame"], state["params"]["delta"], state["view"]["params"]["delta"]) == (2, 0.3, 0.3)
    assert page.last["error"]["message"].startswith("epsilon is -1")
    page.say(type="link", rev=2, patch=page.last["drawn"]["state"]["view"])
    assert page.drawn(2)["state"]["frame"] == 2


def test_a_message_that_is_not_json_does_not_end_the_tab(page: Page):
    page.hello()
    page._socket.send("{")
    assert page.hear_a("error")["where"] == "view"
    assert page.change(frame=2)["frame"] == 2


def test_an_unknown_recording_is_an_error_and_the_old_picture_stays(page: Page):
    page.hello()
    page.change(frame=3)
    for id in ("file:nothing", "../../etc/passwd", "/etc/passwd", "sample:../../etc/passwd", "upload:../x"):
        assert page.refused(recording=id)["where"] == "recording"
    state = page.change(params={"epsilon": 0.04})
    assert (state["label"], state["frame"]) == ("walls.npz", 3)


def holding(patch: pytest.MonkeyPatch, owner: object, name: str) -> tuple[threading.Event, threading.Event]:
    """Events of a function: it has been called, and may go on."""
    called, go_on, function = threading.Event(), threading.Event(), getattr(owner, name)

    def late(*what, **how):
        called.set()
        assert go_on.wait(SECONDS)
        return function(*what, **how)

    patch.setattr(owner, name, late)
    return called, go_on


def test_what_joins_a_recording_that_cannot_be_opened_is_answered_with_it(page: Page, monkeypatch: pytest.MonkeyPatch):
    page.hello()
    page.change(frame=2)
    opening, go_on = holding(monkeypatch, library, "open_recording")
    page.ask(recording="sample:hallway", topic="/none")
    assert opening.wait(SECONDS)
    page.ask(frame=1)
    last = page.ask(params={"epsilon": 0.05})
    # What is not valid is answered at once: the changes before it have been heard.
    page.ask(frame="one")
    assert page.hear_a("error")["where"] == "view"
    go_on.set()
    assert page.hear_a("error")["rev"] == last
    state = page.change(selected=None)
    assert (state["label"], state["frame"], state["params"]["epsilon"]) == ("walls.npz", 2, 0.03)


def test_a_recording_that_is_left_and_chosen_again_at_once_is_drawn(page: Page, monkeypatch: pytest.MonkeyPatch):
    page.hello()
    opening, may_open = holding(monkeypatch, library, "open_recording")
    given_up, go_on = holding(monkeypatch, Session, "_fall_back")
    page.ask(recording="sample:laboratory", reading={"frames": "7:9"})
    assert opening.wait(SECONDS)
    page.ask(recording="sample:hallway", reading={"frames": None})
    assert given_up.wait(SECONDS)
    last = page.ask(recording="sample:laboratory", reading={"frames": "7:9"})
    go_on.set()
    may_open.set()
    assert page.drawn(last)["state"]["recording"] == "sample:laboratory"


def test_a_tab_that_begins_with_a_bad_link_shows_the_first_recording(page: Page):
    page.say(type="hello", session=None, view={"recording": "file:gone", "frame": 7})
    assert page.hear_a("error")["where"] == "recording"
    assert page.hear_a("drawn")["state"]["label"] == "walls.npz"


def test_marks_come_with_a_new_trace_only(page: Page):
    page.hello()
    first = page.drawn(page.ask(frame=1))["state"]
    assert first["marks"]["seed"]
    assert "marks" not in page.change(step=3)
    assert "marks" in page.change(params={"epsilon": 0.05})


def test_replay_says_the_decision_and_stays_within_the_trace(page: Page):
    steps = page.hello()["steps"]
    state = page.change(step=10**6)
    assert state["step"] == steps - 1
    assert state["decision"]["index"] == steps - 1
    assert state["decision"]["phase"] == "endpoints"
    assert page.change(step=None)["decision"] is None


def test_a_selected_beam_is_explained(page: Page):
    page.hello()
    explanation = page.change(selected=20)["explanation"]
    assert (explanation["beam"], explanation["segment"]) == (20, 0)
    assert explanation["at"][0] == pytest.approx(4.0, abs=0.05)
    assert "ε" in explanation["text"]
    assert page.change(selected=5000)["explanation"] is None


def test_two_tabs_do_not_disturb_each_other(server: Address, page: Page):
    page.hello()
    with page_of(server) as other:
        other.hello(frame=2)
        other.change(params={"min_length": 30.0})
        state = page.change(frame=1)
        assert (state["frame"], state["params"]["min_length"], len(state["segments"])) == (1, 0.6, 1)
        assert other.welcome["session"] != page.welcome["session"]
        assert other.change(selected=3)["segments"] == []


def test_a_tab_that_comes_back_finds_its_session(server: Address, page: Page):
    page.hello()
    page.change(frame=3, params={"epsilon": 0.07})
    leave(server, page)
    with page_of(server) as again:
        state = again.hello(session=page.welcome["session"])
        assert again.welcome["resumed"]
        assert again.welcome["viser"] == page.welcome["viser"]
        assert (state["frame"], state["params"]["epsilon"]) == (3, 0.07)
        assert "marks" in state


def test_a_session_belongs_to_one_page_only(server: Address, page: Page):
    page.hello()
    with page_of(server) as copy:
        copy.hello(session=page.welcome["session"], frame=4)
        assert not copy.welcome["resumed"]
        assert copy.welcome["session"] != page.welcome["session"]


def test_after_a_restart_the_page_brings_its_view_along(server: Address, page: Page):
    state = page.hello(session="of-another-server", frame=2, params={"delta": 0.3}, dark=True)
    assert not page.welcome["resumed"]
    assert (state["frame"], state["params"]["delta"]) == (2, 0.3)


def test_a_closed_tab_ends_its_session(server: Address, page: Page):
    page.hello()
    page.say(type="close")
    with pytest.raises(ConnectionClosed):
        page.hear_a("nothing more")
    assert server.get(page.welcome["viser"]).status_code == 404


def test_a_first_message_other_than_hello_closes_the_socket(page: Page):
    page.say(type="view", rev=1, patch={})
    with pytest.raises(ConnectionClosed) as closed:
        page.hear()
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 4000


def test_too_many_tabs_are_told_so_and_room_is_made_by_those_that_left(tmp_path):
    settings = Settings(data_folder=tmp_path, sessions=SessionLimits(most=1))
    with serving(settings) as server:
        with page_of(server) as first:
            first.hello()
            with page_of(server) as second:
                second.say(type="hello")
                error = second.hear()
                assert (error["where"], error["type"]) == ("server", "error")
                assert "close one" in error["message"]

        def let_in() -> bool:
            with page_of(server) as third:
                third.say(type="hello")
                return third.hear()["type"] == "welcome"

        eventually(let_in, "a place for another tab")
        assert server.get(first.welcome["viser"]).status_code == 404


def test_a_session_without_a_page_is_closed_in_time(tmp_path):
    settings = Settings(data_folder=tmp_path, sessions=SessionLimits(grace=0.05))
    with serving(settings) as server:
        with page_of(server) as page:
            page.hello()
        eventually(lambda: server.get(page.welcome["viser"]).status_code == 404, "the session to be closed")


def test_of_what_arrives_during_a_picture_only_the_newest_is_drawn(page: Page, monkeypatch: pytest.MonkeyPatch):
    begun, sent, paint = threading.Event(), threading.Event(), Session._paint

    def painted(session: Session, *request):
        if threading.current_thread().name == "server under test":
            begun.set()
            assert sent.wait(SECONDS)
        return paint(session, *request)

    page.hello()
    monkeypatch.setattr(Session, "_paint", painted)
    # The thread may still be busy with the first picture.
    while not begun.wait(0.1):
        held = page.ask(frame=0)
    for frame in range(1, 5):
        rev = page.ask(frame=frame)
    sent.set()
    drawn = [page.hear_a("drawn")["rev"]]
    while drawn[-1] < rev:
        drawn.append(page.hear_a("drawn")["rev"])
    assert not set(drawn) & set(range(held + 1, rev))


def test_a_tab_keeps_the_findings_of_few_pictures(page: Page):
    page.hello()
    before = {id(thing) for thing in gc.get_objects() if isinstance(thing, Findings)}
    for number in range(30):
        page.change(params={"epsilon": 0.02 + number / 1000})
    gc.collect()
    assert len({id(thing) for thing in gc.get_objects() if isinstance(thing, Findings)} - before) <= 10


def test_a_method_that_takes_long_waits_for_other_turns(page: Page):
    page.hello()
    with QUICK_TURN:
        assert page.change(method="hough")["method"] == "hough"


def test_small_scans_are_drawn_in_the_thread_that_answers_all_tabs(page: Page, monkeypatch: pytest.MonkeyPatch):
    threads = list[str]()
    paint = Session._paint

    def drawn(session: Session, *request):
        threads.append(threading.current_thread().name)
        return paint(session, *request)

    monkeypatch.setattr(Session, "_paint", drawn)
    page.hello()
    assert threads[0].startswith("session")
    epsilons = itertools.count(500)

    def in_the_loop() -> bool:
        page.change(params={"epsilon": next(epsilons) / 10_000})
        return threads[-1] == "server under test"

    # The thread may still be busy with the first picture.
    eventually(in_the_loop, "a picture drawn in the loop", lambda: threads)
    page.change(method="hough")
    assert threads[-1].startswith("session")


def test_a_tab_that_is_just_greeted_is_neither_closed_nor_makes_room_for_another(tmp_path):
    shelf = Library([], Recent(tmp_path), Uploads(1, 1, 1))
    limits = SessionLimits(most=1, grace=-1.0)

    async def run() -> None:
        sessions = Sessions(shelf, LabelFiles(shelf, tmp_path), WarmUp(), limits)
        tab = await sessions.open(View(recording=shelf.first()))
        try:
            with pytest.raises(TooManySessionsError):
                await sessions.open(View(recording=shelf.first()))
            assert sessions._outdated() == []
            tab.detach()
            assert sessions._outdated() == [tab]
        finally:
            await sessions.close_all()

    asyncio.run(run())
