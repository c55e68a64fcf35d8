"""A drawing of a step shows what the step is about."""

from pathlib import Path

from lineseg_app.frame.findings import findings
from lineseg_app.scene.drawing import WORDS, step_marks
from lineseg_app.view import View

from lineseg import figure_svg, open_recording

HALLWAY = Path(__file__).parents[3] / "sample_scans" / "hallway.npz"


def test_a_drawing_at_a_step_has_its_window_its_predicted_point_and_its_band():
    recording = open_recording(HALLWAY)
    found = findings(recording, 0, "region-growing", View().params)
    seen = set()
    for step in range(40):
        marks, near = step_marks(View(step=step), recording, found)
        seen |= {mark.words for mark in marks}
        drawing = figure_svg(found.scan, found.extraction, "", None, marks, near)
        assert all(f"<title>{mark.words}</title>" in drawing for mark in marks)
    assert {WORDS[name] for name in ("window", "predicted", "band", "candidate")} <= seen
