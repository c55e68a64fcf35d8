"""The scores of every frame: after the picture, for the newest thresholds, equal to those of the library."""

from __future__ import annotations

import asyncio
import queue
import socket
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.listening import listen
from lineseg_app.server import Settings
from lineseg_app.session.strip import Strip, glance_of, stride_of
from lineseg_app.told.messages import Surveyed
from lineseg_app.view import View
from live import Address, Page, leave, page_of, serving, surveyed
from long import long_hallway
from waiting import SECONDS

from lineseg import Params, Recording, open_recording
from lineseg.doubt import SCORES
from lineseg.readers import save_npz
from lineseg.survey import survey
from lineseg.survey.committee import with_disputes
from lineseg.survey.stability import with_stability


@pytest.fixture(scope="module")
def long() -> Recording:
    """A recording long enough that the first survey is coarse."""
    return long_hallway(frames=2000)


@pytest.fixture(scope="module")
def busy(long: Recording, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Address]:
    folder = tmp_path_factory.mktemp("long")
    save_npz(long, folder / "long.npz")
    with serving(Settings(files=(folder / "long.npz",), data_folder=folder)) as server:
        yield server


@pytest.fixture
def long_page(busy: Address) -> Iterator[Page]:
    with page_of(busy) as page:
        yield page


def whole(page: Page) -> dict:
    """Wait for the next survey of all frames."""
    while (message := page.hear_a("survey"))["stride"] > 1:
        pass
    return message


def assert_same(message: dict, recording: Recording, params: Params) -> None:
    expected = survey(recording, params)
    # Another tab may have asked for the committee before.
    if not np.isnan(message["scores"]["disputed"]).all():
        expected = with_disputes(recording, expected)
    for name in SCORES:
        np.testing.assert_array_equal(message["scores"][name], expected.score(name), err_msg=name)


def test_the_strip_comes_after_the_first_picture_with_the_numbers_of_the_library(page: Page, recordings: Path):
    page.hello()
    message = page.hear()
    assert (message["type"], message["frames"], message["stride"], message["message"]) == ("survey", 5, 1, None)
    assert_same(message, open_recording(recordings / "walls.npz"), Params())


def test_the_scores_are_described_in_the_welcome(page: Page):
    page.hello()
    assert [score["name"] for score in page.welcome["scores"]] == [*SCORES, "suspicion", "difference"]
    assert all(score["help"] and score["worse"] in ("higher", "lower") for score in page.welcome["scores"])


def test_a_long_recording_is_first_surveyed_coarsely(long_page: Page, long: Recording):
    long_page.hello()
    glance, full = long_page.hear(), long_page.hear()
    assert (glance["type"], glance["stride"], full["stride"]) == ("survey", stride_of(long), 1)
    assert glance["stride"] > 1
    for name in SCORES:
        np.testing.assert_array_equal(glance["scores"][name], full["scores"][name][:: glance["stride"]], err_msg=name)
    assert_same(full, long, Params())


def test_the_strip_follows_the_newest_of_many_changes(long_page: Page, long: Recording):
    long_page.hello()
    steps = [0.02 + 0.001 * k for k in range(30)]
    for epsilon in steps:
        long_page.ask(params={"epsilon": epsilon})
    surveys = []
    while not surveys or surveys[-1]["params"]["epsilon"] != steps[-1] or surveys[-1]["stride"] > 1:
        surveys.append(long_page.hear_a("survey"))
    assert [message["rev"] for message in surveys] == sorted(message["rev"] for message in surveys)
    assert len([message for message in surveys if message["stride"] == 1]) < 15
    assert_same(surveys[-1], long, Params(epsilon=steps[-1]))


def test_an_outdated_survey_is_only_done_coarsely(long: Recording):
    heard: queue.Queue[Surveyed] = queue.Queue()
    old, new = View(recording="long"), View(recording="long", params=Params(epsilon=0.05))

    def hear(message) -> None:
        # Called in the strip's thread, before it begins with all frames.
        heard.put(message)
        if message.rev == 1:
            strip.keep(new)

    strip = Strip("strip under test", _set_event(), hear)
    strip.want(old, long, rev=1)
    assert heard.get(timeout=SECONDS).rev == 1
    strip.want(new, long, rev=2)
    later = [heard.get(timeout=SECONDS) for _ in range(2)]
    strip.close()
    assert [(message.rev, message.stride > 1) for message in later] == [(2, True), (2, False)]
    assert heard.empty()


def test_the_committee_and_then_stability_are_computed_last_and_only_on_request(page: Page, recordings: Path):
    page.hello()
    assert np.isnan(whole(page)["scores"]["unstable"]).all()
    page.ask(score="unstable")
    told = [whole(page)]
    while np.isnan(told[-1]["scores"]["unstable"]).all():
        told.append(whole(page))
    *early, last = told
    # The committee is known at once if another tab has asked for it before.
    assert [bool(np.isnan(each["scores"]["disputed"]).all()) for each in early] in ([True, False], [False])
    recording = open_recording(recordings / "walls.npz")
    expected = with_stability(recording, with_disputes(recording, survey(recording)))
    for name in SCORES:
        np.testing.assert_array_equal(last["scores"][name], expected.score(name), err_msg=name)


def test_another_frame_or_score_needs_no_new_strip(page: Page):
    page.hello()
    whole(page)
    assert page.change(score="rms")["score"] == "rms"
    page.change(frame=3)
    rev = page.ask(params={"epsilon": 0.05})
    assert whole(page)["rev"] == rev


def test_an_unknown_score_is_refused(page: Page):
    page.hello()
    error = page.refused(score="beauty")
    assert error["where"] == "view"
    assert "beauty" in error["message"]
    assert "coverage" in error["message"]


def test_one_frame_has_no_strip_and_the_page_is_told_why(page: Page):
    page.hello(recording="lesson:1_perfect_corner")
    message = page.hear_a("survey")
    assert message["message"] == "one frame: nothing to compare"
    assert len(message["scores"]["coverage"]) == 0


def test_a_tab_that_comes_back_gets_the_strip_again(server: Address, page: Page):
    page.hello()
    before = whole(page)
    leave(server, page)
    with page_of(server) as again:
        again.hello(session=page.welcome["session"])
        np.testing.assert_array_equal(whole(again)["scores"]["coverage"], before["scores"]["coverage"])


def test_after_a_failed_load_the_strip_stays_that_of_the_old_recording(page: Page):
    page.hello()
    whole(page)
    page.refused(recording="file:nothing")
    assert whole(page)["frames"] == 5
    rev = page.ask(params={"epsilon": 0.05})
    assert whole(page)["rev"] == rev


def test_a_survey_that_fails_says_so_and_the_next_one_runs(recordings: Path):
    heard: queue.Queue[Surveyed] = queue.Queue()
    walls = open_recording(recordings / "walls.npz")
    broken = replace(walls, ranges=walls.ranges.astype(object))
    strip = Strip("strip under test", _set_event(), lambda message: heard.put(message))
    strip.want(View(recording="broken"), broken, rev=1)
    message = heard.get(timeout=SECONDS).message
    assert message is not None
    assert message.startswith("no scores: ")
    assert "\n" not in message
    strip.want(View(recording="walls"), walls, rev=2)
    assert heard.get(timeout=SECONDS).message is None
    strip.close()


def test_a_coarse_survey_keeps_each_frame_with_its_neighbours(long: Recording):
    glance = glance_of(long, 100)
    assert len(glance) == 60
    for k, frame in enumerate([0, 0, 1, 99, 100, 101, 199, 200, 201]):
        np.testing.assert_array_equal(glance[k].ranges, long[frame].ranges)
        assert glance[k].stamp == long[frame].stamp


def test_a_binary_message_keeps_its_numbers():
    values = np.arange(2 * len(SCORES), dtype=np.float32)
    message = Surveyed(
        rev=3, recording="ä", place="", method="m", params={}, frames=2, stride=1, message=None, values=values.tobytes()
    )
    told = surveyed(message.as_bytes())
    assert (told["rev"], told["recording"]) == (3, "ä")
    np.testing.assert_array_equal(np.concatenate(list(told["scores"].values())), values)


def test_small_messages_do_not_wait_for_one_another():
    """The scores follow the picture at once; with Nagle's algorithm the next answer would come 40 ms late."""

    async def option() -> int:
        found = asyncio.get_running_loop().create_future()

        async def accept(_reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            accepted = writer.get_extra_info("socket")
            found.set_result(accepted.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY))
            writer.close()

        listener = listen("127.0.0.1", 0)
        async with await asyncio.start_server(accept, sock=listener):
            _, writer = await asyncio.open_connection("127.0.0.1", listener.getsockname()[1])
            result = await found
            writer.close()
            await writer.wait_closed()
            return result

    assert asyncio.run(option())


def _set_event() -> threading.Event:
    event = threading.Event()
    event.set()
    return event
