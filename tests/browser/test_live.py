"""A live robot in the page: followed, paused, scrubbed back, followed again; parameters and segments sent to it."""

from __future__ import annotations

import math
import re
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from lineseg_app.node.door import open_door
from lineseg_app.node.running import Running
from live import Address
from robots import wall, watching
from rosbridge_peer import RosBridgePeer, scan_message
from waiting import SECONDS

from lineseg import EXTRACTORS

NODE = {"least_thresh": 0.04, "predict_distance": 0.1, "seed_line_points": 6, "min_line_points": 12}


class Driving:
    """A robot that drives towards a wall and back, ten scans a second, until it stops."""

    def __init__(self) -> None:
        self.peer = RosBridgePeer(nodes={"/line_extraction": dict(NODE)})
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._drive)
        self._thread.start()

    def _drive(self) -> None:
        count = 0
        while not self._stop.wait(0.1):
            self.peer.publish("/scan", scan_message(wall(3.0 + math.sin(count / 10)), count))
            count += 1

    def stop(self) -> None:
        if self._stop.is_set():
            return
        self._stop.set()
        self._thread.join()
        self.peer.close()


@pytest.fixture
def robot() -> Iterator[Driving]:
    robot = Driving()
    yield robot
    robot.stop()


@pytest.fixture
def watched(robot: Driving, tmp_path: Path) -> Iterator[Address]:
    with watching(robot.peer.url, tmp_path, keep=30) as server:
        yield server


def test_a_robot_is_watched_paused_and_given_its_parameters(robot: Driving, watched: Address, new_tab, tmp_path: Path):
    tab = new_tab(at=f"{watched.http}/")
    pill = tab.page.get_by_role("button", name="Live")
    begun = tab.until("s.live === true && s.frames > 3")
    tab.until(f"s.frame > {begun['frame']} && s.frame === s.first + s.frames - 1")
    assert pill.get_attribute("aria-pressed") == "true"
    # Old scans drop out, and the numbers of the frames go on.
    tab.until("s.first > 2 && s.frames === 30")
    told = tab.page.locator(".live-status")
    tab.eventually(lambda: "dropped" in told.inner_text(), "nothing is told of dropped scans")
    tab.eventually(lambda: "scans/s" in told.inner_text(), "the rate is not told")
    assert "frame=" not in tab.page.url

    # Paused, the frame stays, whatever arrives; one can scrub back.
    tab.page.keyboard.press("Space")
    paused = tab.until("s.live === false")
    tab.eventually(lambda: "+" in pill.inner_text(), "newer scans are not counted")
    tab.page.keyboard.press("Shift+ArrowLeft")
    back = tab.until(f"s.frame === {paused['frame'] - 10}")
    assert (back["first"], back["frames"], back["live"]) == (paused["first"], 30, False)
    assert back["stamp"] == pytest.approx(paused["stamp"] - 10)
    assert tab.page.get_by_role("textbox", name="Frame").input_value() == str(back["frame"])
    tab.type_value("epsilon", "0.02")
    assert tab.until("s.params.epsilon === 0.02")["stamp"] == back["stamp"]

    # And on.
    pill.click()
    on = tab.until("s.live === true")
    assert on["first"] + on["frames"] > paused["first"] + paused["frames"]
    assert on["params"]["epsilon"] == 0.02

    # What arrives is judged in Inspect too, and the newest frame stays on the screen.
    tab.page.get_by_role("button", name="Inspect").click()
    tab.until("s.score === 'suspicion' && s.live === true")
    value = tab.page.locator(".frames-row .frames-value").first
    tab.eventually(lambda: re.fullmatch(r"suspicion \d+(\.\d+)?", value.inner_text()), "no frame has a suspicion")
    words = tab.page.locator(".frames-row .frames-words").first
    tab.eventually(lambda: words.inner_text(), "nothing is said of the most suspicious frame")
    tab.until("s.live === true && s.frame === s.first + s.frames - 1")
    tab.page.get_by_role("button", name="Tune").click()

    # Segments go back, as long as it is wanted.
    menu = tab.page.get_by_role("button", name="Export")
    menu.click()
    tab.page.get_by_role("menuitem", name="Publish segments to the robot…").click()
    tab.page.get_by_role("textbox", name="Topic").fill("/walls")
    tab.page.get_by_role("button", name="Publish", exact=True).click()
    topic, message = robot.peer.received.get(timeout=SECONDS)
    assert (topic, message["markers"][0]["header"]["frame_id"]) == ("/walls", "laser")
    tab.eventually(lambda: "/walls" in told.inner_text(), "publishing is not shown")
    menu.click()
    tab.page.get_by_role("menuitem", name="Stop publishing segments").click()
    tab.eventually(lambda: "/walls" not in told.inner_text(), "publishing goes on")

    # A node of lineseg is offered by itself, and runs what is sent.
    runs, told_by_node = Running("ransac", EXTRACTORS["ransac"].params_type()), []
    with open_door("ros2:/scan", runs, lambda method, params: None, told_by_node.append, tmp_path):
        menu.click()
        tab.page.get_by_role("menuitem", name="Send parameters to a robot…").click()
        dialog = tab.page.get_by_role("dialog")
        to = dialog.get_by_role("combobox", name="Send to").locator("option:checked")
        assert to.inner_text() == "lineseg node on ros2:/scan"
        dialog.get_by_role("button", name="Send").click()
        dialog.get_by_text("The node runs region-growing with these").wait_for()
        assert dialog.get_by_role("row", name="epsilon 0.02").is_visible()
    method, params = runs.now
    assert (method, params.numbers()["epsilon"]) == ("region-growing", 0.02)
    assert told_by_node[-1].startswith("sent from the page: region-growing, epsilon 0.02")
    tab.page.keyboard.press("Escape")

    # The thresholds reach another node, and what it refuses is shown as it says it.
    menu.click()
    tab.page.get_by_role("menuitem", name="Send parameters to a robot…").click()
    dialog = tab.page.get_by_role("dialog")
    # Only robots that were named at the start are reached, and they are offered.
    address = dialog.get_by_role("combobox", name="Address")
    tab.eventually(lambda: address.input_value() == robot.peer.url, "the named robot is not offered")
    address.fill("ws://127.0.0.1:1")
    dialog.get_by_role("button", name="Send").click()
    dialog.get_by_role("alert").wait_for()
    assert "start it with --robot ws://127.0.0.1:1" in dialog.get_by_role("alert").inner_text()
    address.fill(robot.peer.url)
    dialog.get_by_role("textbox", name="Node").fill("/nobody")
    dialog.get_by_role("button", name="Send").click()
    dialog.get_by_text("Service /nobody/set_parameters does not exist").wait_for()
    dialog.get_by_role("textbox", name="Node").fill("/line_extraction")
    dialog.get_by_role("button", name="Send").click()
    dialog.get_by_text("The robot has 4 of 5 values.").wait_for()
    assert dialog.get_by_role("row", name="least_thresh 0.02 0.02").is_visible()
    assert "parameter 'min_line_length' cannot be set because it was not declared" in dialog.inner_text()
    assert robot.peer.nodes["/line_extraction"]["least_thresh"] == 0.02
    tab.forgive("403", "400")

    # A robot that goes away is told, and what came from it stays.
    tab.page.keyboard.press("Escape")
    robot.stop()
    tab.eventually(lambda: "trying again in" in told.inner_text(), "the loss is not told")
    assert tab.state["frames"] == 30
