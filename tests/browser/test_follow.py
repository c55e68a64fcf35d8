"""A class that looks at what its teacher shows."""

from __future__ import annotations

import pytest


def test_a_class_follows_its_teacher_leaves_and_returns(new_tab):
    teacher = new_tab("#mode=learn&step=0&recording=lesson:1_perfect_corner")
    teacher.page.get_by_role("button", name="Export").click()
    teacher.page.get_by_role("menuitem", name="Copy a link that follows this tab").click()
    teacher.page.get_by_text("Whoever opens it sees what you see").wait_for()
    link = teacher.page.evaluate("window.lineseg.followLink")
    pupil = new_tab(link[link.index("#") :])
    assert pupil.until("s.following === 'here' && s.recording === 'lesson:1_perfect_corner'")["mode"] == "learn"
    teacher.page.bring_to_front()
    teacher.page.keyboard.press("s")
    step = teacher.until("s.step > 0")["step"]
    assert pupil.until(f"s.step === {step}")["decision"] == teacher.state["decision"]
    pupil.page.keyboard.press("ArrowRight")
    pupil.page.keyboard.press("f")
    assert pupil.until("true")["step"] == step
    assert teacher.state["step"] == step
    pupil.page.get_by_role("button", name="Stop following").click()
    pupil.until("s.following === null")
    pupil.page.keyboard.press("ArrowRight")
    pupil.until(f"s.step === {step + 1}")
    assert teacher.state["step"] == step
    pupil.page.get_by_role("button", name="Follow again").click()
    pupil.until(f"s.step === {step}")
    teacher.page.bring_to_front()
    teacher.page.get_by_role("button", name="All lessons").click()
    teacher.page.locator("[data-lesson='02_delta']").click()
    teacher.page.locator(".lesson-foot .primary").click()
    shown = teacher.until("s.view.page === 1 && s.step !== null")
    assert pupil.until("s.view.page === 1 && s.step !== null")["step"] == shown["step"]
    pupil.page.locator(".lesson-foot", has_text="2 of 6").wait_for()
    assert pupil.page.locator(".lesson-body").text_content() == teacher.page.locator(".lesson-body").text_content()
    teacher.page.get_by_role("button", name="Back to the list of lessons").click()
    pupil.page.locator(".lesson-foot").wait_for(state="hidden")
    teacher.page.close()
    pupil.until("s.following === 'away'")
    pupil.page.get_by_text("who is away at the moment").wait_for()


@pytest.mark.own_tab
def test_a_teacher_sees_who_is_where(new_tab):
    teacher = new_tab("#mode=learn&recording=sample:hallway")
    link = teacher.page.evaluate("window.lineseg.followLink")
    pupil = new_tab(link[link.index("#") :])
    pupil.until("s.following === 'here'")
    name = pupil.page.get_by_label("Your name for the teacher")
    name.fill("Ada <b>L.</b>")
    name.press("Enter")
    teacher.page.get_by_role("button", name="Export").click()
    teacher.page.get_by_role("menuitem", name="Who is where").click()
    row = teacher.page.locator(".class-list tbody tr")
    row.get_by_text("Ada <b>L.</b>").wait_for()
    row.get_by_text("follows").wait_for()
    pupil.page.close()
    teacher.page.get_by_text("Nobody has opened the link of this tab yet.").wait_for()
