"""Tabs that mirror a presenter, over real sockets."""

from __future__ import annotations

from lineseg_app.session.following import Presence, Presenter
from lineseg_app.view import View
from live import Address, page_of


class Note:
    """A follower that records what it is told."""

    def __init__(self) -> None:
        self.told: list[Presence | View] = []

    def mirror(self, view: View) -> None:
        self.told.append(view)

    def presenter_is(self, presence: Presence) -> None:
        self.told.append(presence)


def test_a_follower_sees_what_its_presenter_does_and_can_change_nothing(server: Address):
    with page_of(server) as teacher, page_of(server) as pupil:
        teacher.hello()
        teacher.change(params={"epsilon": 0.05}, mode="inspect")
        pupil.hello(follow=teacher.welcome["presenter"])
        state = pupil.until(lambda state: state["following"] == "here" and state["params"]["epsilon"] == 0.05)
        assert state["mode"] == "inspect"
        teacher.change(frame=2, step=4)
        state = pupil.until(lambda state: state["frame"] == 2)
        assert state["step"] == 4
        error = pupil.refused(params={"epsilon": 0.01})
        assert error["message"] == "this tab follows a presenter; stop following to change what it shows"
        assert pupil.change(dark=True)["params"]["epsilon"] == 0.05
        pupil.say(type="follow", id=None)
        pupil.until(lambda state: state["following"] is None)
        assert pupil.change(params={"epsilon": 0.01})["params"]["epsilon"] == 0.01
        assert teacher.change(frame=1)["params"]["epsilon"] == 0.05


def test_a_follower_is_compared_with_the_reference_of_its_presenter(server: Address):
    with page_of(server) as teacher, page_of(server) as pupil:
        teacher.hello()
        teacher.change(mode="inspect", reference="wall")
        pupil.hello(follow=teacher.welcome["presenter"])
        pupil.until(lambda state: state["reference"] == "wall")
        error = pupil.refused(reference="labels")
        assert error["message"] == "this tab follows a presenter; stop following to change what it shows"


def test_a_presenter_can_be_away_return_and_leave(server: Address):
    with page_of(server) as pupil:
        with page_of(server) as teacher:
            teacher.hello()
            teacher.change(frame=1)
            pupil.hello(follow=teacher.welcome["presenter"])
            pupil.until(lambda state: state["following"] == "here" and state["frame"] == 1)
        pupil.until(lambda state: state["following"] == "away")
        with page_of(server) as again:
            again.hello(session=teacher.welcome["session"])
            pupil.until(lambda state: state["following"] == "here")
            again.say(type="close")
            pupil.until(lambda state: state["following"] == "gone")
        state = pupil.change(frame=0)
        assert state["frame"] == 0
        assert state["following"] == "gone"


def test_a_presenter_that_has_left_stays_away():
    presenter, early, late = Presenter(), Note(), Note()
    view = View(recording="samples/hallway")
    presenter.show(view)
    presenter.join(early)
    presenter.tell("gone")
    presenter.tell("away")
    presenter.show(View(recording="samples/office"))
    presenter.join(late)
    assert early.told == ["here", view, "gone"]
    assert late.told == ["gone"]


def test_following_an_unknown_id_leaves_the_presenter(server: Address):
    with page_of(server) as teacher, page_of(server) as pupil:
        teacher.hello()
        pupil.hello(follow=teacher.welcome["presenter"])
        pupil.until(lambda state: state["following"] == "here")
        pupil.say(type="follow", id="nobody")
        pupil.until(lambda state: state["following"] == "gone")
        # The second is drawn after the first was shown to whoever follows.
        teacher.change(frame=2)
        teacher.change(frame=3)
        assert pupil.change(dark=True)["frame"] == 0


def test_a_link_to_an_unknown_id_says_so_and_a_session_id_is_not_a_link(server: Address):
    with page_of(server) as teacher, page_of(server) as pupil:
        teacher.hello()
        pupil.say(type="hello", follow=teacher.welcome["session"])
        assert "ask for a new link" in pupil.hear_a("error")["message"]
        assert pupil.until(lambda state: state["following"] == "gone")["segments"]
