"""`lineseg lessons`: a folder of pages."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from lineseg_app.__main__ import main
from lineseg_app.handout.site import index_page
from taught import taught


def test_lessons_become_a_folder_of_pages_that_lead_to_each_other(tmp_path: Path, capsys):
    site = tmp_path / "site"
    assert main(["lessons", "01_seed", "02_delta", "-o", str(site)]) == 0
    assert capsys.readouterr().out == f"{site / 'index.html'}: 2 lessons\n"
    assert sorted(path.name for path in site.iterdir()) == ["01_seed.html", "02_delta.html", "index.html"]
    index = (site / "index.html").read_text("utf-8")
    assert re.findall('href="([^"]*html)"', index) == ["01_seed.html", "02_delta.html"]
    assert "<script" not in index and "What a seed is" in index
    assert all(path.stat().st_size <= 3_000_000 for path in site.iterdir())
    assert main(["lessons", "01_seed", "-o", str(site)]) == 0


def test_the_list_sets_indices_as_the_lessons_do():
    lessons = taught().lessons
    index = index_page(lessons, {lesson.id: f"{lesson.id}.html" for lesson in lessons})
    told = re.sub(r'href="[^"]*"', "", index[index.index("<ol") :])
    assert "<i>S</i><sub>num</sub>" in told and not re.search(r"[A-Za-z]_[a-z]", told)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["13_none"], "there is no lesson '13_none'; choose from 01_seed, 02_delta, "),
        (["01_seed"], "holds notes.txt, which is no page of lessons; name a new or an empty folder"),
    ],
)
def test_what_cannot_be_written_is_told_before_anything_is(tmp_path: Path, capsys, arguments, sentence):
    site = tmp_path / "site"
    if "notes" in sentence:
        site.mkdir()
        (site / "notes.txt").write_text("mine")
    assert main(["lessons", *arguments, "-o", str(site)]) == 2
    assert sentence in capsys.readouterr().err
    assert not list(site.glob("*.html"))


def test_a_full_disk_leaves_no_half_file(tmp_path: Path, capsys, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(Path, "write_text", lambda path, *_, **__: (_ for _ in ()).throw(OSError(28, "no space left")))
    assert main(["lessons", "01_seed", "-o", str(tmp_path / "site")]) == 2
    assert "01_seed.html: no space left" in capsys.readouterr().err
    assert list((tmp_path / "site").iterdir()) == []
