"""Who is where in a class."""

from __future__ import annotations

from live import Address, page_of
from waiting import eventually


def test_the_teacher_alone_sees_who_is_where_until_they_leave(server: Address):
    def listed(page) -> list[dict]:
        return server.get("/api/class", params={"session": page.welcome["session"]}).json()

    def says(page, **said):
        return server.post("/api/class/me", params={"session": page.welcome["session"]}, json=said)

    with page_of(server) as teacher, page_of(server) as stranger:
        teacher.hello()
        stranger.hello()
        assert listed(teacher) == []
        with page_of(server) as pupil:
            pupil.hello(follow=teacher.welcome["presenter"])
            pupil.until(lambda state: state["following"] == "here")
            assert says(pupil, name="  <b>Ada</b>   L. ", done=2).status_code == 200
            (one,) = listed(teacher)
            assert (one["name"], one["done"], one["follows"]) == ("<b>Ada</b> L.", 2, True)
            pupil.say(type="follow", id=None)
            pupil.until(lambda state: state["following"] is None)
            pupil.change(mode="learn", recording="lesson:1_perfect_corner", lesson="05_corner", page=1)
            (one,) = listed(teacher)
            assert (one["lesson"], one["page"], one["pages"]) == ("Two lines at a corner", 2, 6)
            assert not one["follows"]
            assert listed(pupil) == listed(stranger) == []
            assert says(pupil, name="x" * 41).status_code == 422
            assert says(stranger, name="me").status_code == 400
        eventually(lambda: listed(teacher) == [], "the list to be empty", lambda: listed(teacher))
        assert server.get("/api/class", params={"session": teacher.welcome["presenter"]}).status_code == 404
