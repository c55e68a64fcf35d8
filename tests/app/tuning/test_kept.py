import gc
import threading
import weakref

import pytest
from lineseg_app.tuning.kept import Kept
from lineseg_app.tuning.kept_trials import KeptTrials
from scenes import corner
from waiting import SECONDS

from lineseg import Params, Recording
from lineseg.tuning import Trial


@pytest.fixture
def recording() -> Recording:
    return Recording.from_scans([corner()])


def test_what_two_ask_for_at_once_is_worked_out_once(recording):
    kept, begun, go, worked, answers = Kept[int](), threading.Event(), threading.Event(), [], []

    def work() -> int:
        worked.append(1)
        begun.set()
        go.wait(SECONDS)
        return 7

    threads = [threading.Thread(target=lambda: answers.append(kept.get(recording, "ε", work))) for _ in range(4)]
    for thread in threads:
        thread.start()
    begun.wait(SECONDS)
    go.set()
    for thread in threads:
        thread.join(SECONDS)
    assert (answers, worked) == ([7] * 4, [1])


def test_work_that_is_stopped_leaves_nothing_and_the_next_begins_anew(recording):
    kept = Kept[int]()

    def stopped() -> int:
        raise KeyError("stopped")

    with pytest.raises(KeyError):
        kept.get(recording, "ε", stopped)
    assert kept.get(recording, "ε", lambda: 8) == 8
    assert kept.get(recording, "ε", stopped) == 8


def test_the_newest_are_kept(recording):
    kept = Kept[int](most=2)
    for key in (1, 2, 1, 3):
        kept.get(recording, key, lambda: 0)
    assert [kept.get(recording, key, lambda: 5) for key in (1, 3, 2)] == [0, 0, 5]


def test_results_go_with_their_recording():
    recording = Recording.from_scans([corner()])
    kept = Kept[int]()
    kept.get(recording, 1, lambda: 0)
    gone = weakref.ref(recording)
    del recording
    gc.collect()
    assert gone() is None


def test_trials_after_a_damaged_line_are_read(tmp_path):
    kept = KeptTrials(tmp_path, {"recording": "a"})
    kept.add(Trial(0, Params(), 0.5))
    with kept.file.open("ab") as file:  # what a full disk leaves, and other damage
        file.write(b'\n[{"epsilon": 0.0\n\xff\n' + b"[" * 5000 + b"\n[{}, 1" + b"0" * 400 + b"]\n[{")
    kept.add(Trial(1, Params(epsilon=0.05), 0.7))
    assert [(trial.params.epsilon, trial.score) for trial in kept.read()] == [(Params().epsilon, 0.5), (0.05, 0.7)]
