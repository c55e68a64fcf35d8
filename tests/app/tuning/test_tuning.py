"""Curves, maps and auto-tuning over the page's socket: the numbers of the library, in stages, until stopped."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lineseg_app.places import data_folder
from lineseg_app.server import Settings
from live import Address, Page, connect, page_of, serving
from waiting import SECONDS, eventually

from lineseg import Params, open_recording
from lineseg.proposal import propose
from lineseg.readers import save_npz
from lineseg.sweep import Batch, slider_values

FRAMES = 60


@pytest.fixture(scope="module")
def hall(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("hall") / "hall.npz"
    save_npz(open_recording(data_folder("sample_scans") / "hallway.npz").only(np.arange(FRAMES)), file)
    return file


@pytest.fixture(scope="module")
def bench(hall: Path) -> Iterator[Address]:
    with serving(Settings(files=(hall,), data_folder=hall.parent)) as address:
        yield address


class Bench:
    """Does what the page does on the socket for long work."""

    def __init__(self, socket: Any) -> None:
        self._socket, self._job = socket, 0
        self.measures = self.hear()["measures"]

    def hear(self) -> dict[str, Any]:
        self.last = json.loads(self._socket.recv(timeout=SECONDS))
        return self.last

    def ask(self, kind: str, **wish: Any) -> int:
        self._job += 1
        params = {} if kind == "fit" else {"params": {}}
        self._socket.send(json.dumps({"type": kind, "job": self._job} | params | wish))
        return self._job

    def stop(self, kind: str) -> None:
        self._socket.send(json.dumps({"type": "stop", "what": kind}))

    def answers(self, job: int) -> list[dict[str, Any]]:
        """All of a job, the last of which says that it is done."""
        found: list[dict[str, Any]] = []
        while not (found and found[-1].get("done")):
            answer = self.hear()
            assert answer["type"] != "error", answer["message"]
            if answer["job"] == job:
                found.append(answer)
        return found

    def tune(self, **wish: Any) -> int:
        return self.ask("auto", **({"objective": "truth", "thresholds": ["epsilon", "delta"], "trials": 15} | wish))


@pytest.fixture
def tab(bench: Address) -> Iterator[tuple[Page, Bench]]:
    with page_of(bench) as page:
        page.hello()
        session = page.welcome["session"]
        with connect(f"{bench.ws}/api/tuning?session={session}") as socket:
            yield page, Bench(socket)


def test_curves_come_coarse_first_and_end_with_the_numbers_of_the_library(tab, hall: Path):
    _, bench = tab
    *stages, end = bench.answers(bench.ask("curves", params={"min_points": 12}))
    assert [stage["frames"] for stage in stages] == [40, FRAMES]
    assert end == {"type": "curves", "job": 1, "done": True}
    values = slider_values("epsilon", 17)
    found = stages[-1]["curves"]["epsilon"]
    whole = Batch(open_recording(hall), False).measure([Params(min_points=12, epsilon=each) for each in values])
    assert found["values"] == list(values)
    for name in ("coverage", "segments", "true_rate", "false_rate", "completeness"):
        expected = [None if np.isnan(each) else round(each, 5) for each in whole.measure(name).tolist()]
        assert found[name] == expected, name
    assert set(stages[0]["curves"]) == {name for name, _, _ in Params.knobs()}


def test_the_newest_curves_win(tab):
    _, bench = tab
    jobs = [bench.ask("curves", params={"epsilon": 0.02 + 0.001 * k}) for k in range(8)]
    *_, stage, end = bench.answers(jobs[-1])
    assert stage["params"]["epsilon"] == 0.027
    assert end["done"]


def test_a_map_gets_finer_and_can_be_stopped(tab, hall: Path, monkeypatch: pytest.MonkeyPatch):
    _, bench = tab
    job = bench.ask("map", x="epsilon", y="min_length", measure="f_score")
    *stages, _ = bench.answers(job)
    assert [len(stage["xs"]) for stage in stages] == [7, 13, 25]
    last = stages[-1]
    params = [Params(epsilon=each, min_length=last["ys"][3]) for each in last["xs"]]
    row = Batch(open_recording(hall), False).measure(params).measure("f_score")
    np.testing.assert_allclose(np.array(last["heights"][3], float), row, atol=1e-5)
    measure = Batch.measure

    def held(batch, settings, cancelled):
        eventually(lambda: cancelled[0], "the stop")
        return measure(batch, settings, cancelled)

    monkeypatch.setattr(Batch, "measure", held)
    job = bench.ask("map", x="epsilon", y="delta", measure="coverage")
    bench.stop("map")
    assert bench.answers(job)[-1].get("stopped")


def test_auto_tuning_sends_trials_and_a_verdict_and_continues_later(tab, hall: Path):
    _, bench = tab
    first, *answers, end = bench.answers(bench.tune(anew=True))
    assert "Maximises the harmonic mean" in first["text"]
    assert first["trials"] == []
    trials = [trial for answer in answers for trial in answer.get("trials", [])]
    assert [trial["number"] for trial in trials] == list(range(15))
    assert trials[0]["params"]["epsilon"] == 0.03
    verdicts = [answer["verdict"] for answer in answers if "verdict" in answer]
    assert "held-back frames" in verdicts[-1]["text"]
    assert set(answers[-1]["importance"]) == {"epsilon", "delta"}
    assert end["done"]
    again, *_ = bench.answers(bench.tune(trials=1))
    assert again["trials"] == trials
    anew, *_ = bench.answers(bench.tune(trials=1, anew=True))
    assert anew["trials"] == []
    kept = max((hall.parent / "studies").glob("*.jsonl"), key=lambda file: file.stat().st_mtime_ns)
    with kept.open("a") as file:
        file.write('[{"epsilon": 0.0')
    after, *_ = bench.answers(bench.tune(trials=1))
    assert len(after["trials"]) == 1


def test_auto_tuning_stops_when_told_and_judges_what_it_has(tab):
    _, bench = tab
    job = bench.tune(objective="label-free", thresholds=["epsilon"], trials=2000, anew=True)
    while not bench.hear().get("trials"):
        pass
    bench.stop("auto")
    *_, verdict, end = bench.answers(job)
    assert "verdict" in verdict
    assert end["done"]


def test_what_fits_is_told_for_the_method_the_thresholds_and_the_recording_on_the_screen(tab, hall: Path):
    page, bench = tab
    page.change(params={"epsilon": 0.004})
    expected = propose(open_recording(hall), Params(epsilon=0.004))
    told, end = bench.answers(bench.ask("fit"))
    assert end["done"]
    assert (told["better"], told["text"]) == (True, expected.text)
    assert told["fits"] == {name: getattr(expected.params, name) for name in ("epsilon", "delta", "epsilon_growth")}
    assert told["noise"]["base"] == pytest.approx(expected.noise.base, rel=1e-3)
    page.change(params=told["fits"])
    again, _ = bench.answers(bench.ask("fit"))
    fits = {name: told["fits"][name] for name in ("epsilon", "delta")}
    assert (again["better"], again["text"], again["fits"]) == (False, "", fits)
    page.change(method="split-and-merge-textbook")
    other, _ = bench.answers(bench.ask("fit"))
    assert set(other["fits"]) == {"split_distance"}
    page.change(recording="lesson:1_perfect_corner")
    none, _ = bench.answers(bench.ask("fit"))
    assert (none["better"], none["fits"], none["noise"]) == (False, {}, None)
    assert "at least 4 scans" in none["text"]


def test_the_newest_fit_wins(tab):
    page, bench = tab
    jobs = []
    for k in range(5):
        page.change(params={"epsilon": 0.004 + 0.001 * k})
        jobs.append(bench.ask("fit"))
    assert "0.008" in bench.answers(jobs[-1])[0]["text"]


@pytest.mark.parametrize(
    ("wish", "said"),
    [
        ({"type": "map", "x": "epsilon", "y": "epsilon", "measure": "coverage"}, "a map needs two thresholds"),
        ({"type": "map", "x": "epsilon", "y": "delta", "measure": "beauty"}, "a map needs two thresholds"),
        ({"type": "curves", "params": {"epsilon": 0}}, "epsilon is 0; a distance of 0"),
        ({"type": "curves", "params": {"epsilon": "much"}}, "epsilon"),
        ({"type": "dance"}, "dance"),
    ],
)
def test_an_impossible_request_is_refused_and_the_socket_stays_open(tab, wish: dict[str, Any], said: str):
    _, bench = tab
    kind = wish.pop("type")
    bench.ask(kind, **wish)
    error = bench.hear()
    assert error["type"] == "error"
    assert said in error["message"]
    assert bench.answers(bench.ask("curves"))[-1]["done"]


def test_without_trials_with_a_score_the_page_is_told_why(tab):
    page, bench = tab
    page.change(recording="sample:hallway.log")
    message = bench.answers(bench.tune())[-1]["message"]
    assert "has no truth; tune it with the label-free objective" in message
    page.change(recording="lesson:1_perfect_corner")
    assert "4 or more frames" in bench.answers(bench.tune())[-1]["message"]


def test_an_unknown_tab_gets_a_sentence(bench: Address):
    with connect(f"{bench.ws}/api/tuning?session=gone") as socket:
        lonely = Bench(socket)
        lonely.ask("curves")
        assert "reload the page" in lonely.hear()["message"]


def test_a_search_ends_with_its_page_also_after_a_message_that_is_not_text(bench: Address):
    def searching() -> bool:
        return any(thread.name == "tuning auto" for thread in threading.enumerate())

    with page_of(bench) as page:
        page.hello()
        with connect(f"{bench.ws}/api/tuning?session={page.welcome['session']}") as socket:
            tuner = Bench(socket)
            tuner.tune(trials=2000)
            assert tuner.hear()["type"] == "auto"
            socket.send(b"\xff\x00")
            while (answer := tuner.hear())["type"] != "error":
                pass
            assert "invalid JSON" in answer["message"]
            assert searching()
    eventually(lambda: not searching(), "the search to end", threading.enumerate)
