"""Computes the scores of every frame of the recording on the screen, for the strip of the page's timeline."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from lineseg import Params, Recording, Thresholds, differences
from lineseg.doubt.scores import COLUMN, SCORES
from lineseg.doubt.suspicion import suspicion
from lineseg.readers import Cancelled
from lineseg.survey import BESIDE, Survey, survey
from lineseg.survey.committee import disputed, known_committee, with_disputes
from lineseg.survey.difference import FATES, KEPT
from lineseg.survey.stability import with_stability

from ..live.ring import numbering
from ..newest import Newest, done_behind
from ..told.messages import Surveyed
from ..view import Against, View, all_weights
from .turns import Turns

# Scores that are computed only if they are shown, or in Inspect.
DEEP = ("suspicion", "disputed", "lapsed", "blank", "unstable")
# A quick survey of this many beams takes a few milliseconds on one core: too short to be worth stopping.
GLANCE_BEAMS = 400_000
LEAST_STRIDE = 4
# Time between updates of the scores of a growing recording [s].
LIVE_EVERY = 1.0
# Between them, it rests this many times as long as they took.
LIVE_REST = 2.0
# Changes that follow each other faster belong to one drag, and a survey that takes long waits for its end [s].
DRAG = 0.15
# Quick surveys of all tabs together take this share of the time, so that many tabs can be dragged at once.
QUICK = Turns(0.1)

log = logging.getLogger(__name__)


class Key(NamedTuple):
    """The part of a View that the scores depend on."""

    recording: str
    place: str
    method: str
    params: Thresholds
    against: Against | None
    weights: tuple[tuple[str, float], ...]
    deep: bool


def key_of(view: View) -> Key:
    # The committee and stability need many surveys: compute them only if shown.
    deep = view.mode == "inspect" or view.score in DEEP
    return Key(view.recording, view.place, view.method, view.params, view.against, view.weights, deep)


@dataclass(frozen=True, eq=False)
class Subject:
    """What to survey, and the revision of the View. dragged: whether it came soon after another."""

    key: Key
    recording: Recording
    rev: int
    stop: NDArray[np.bool_]
    dragged: bool


@dataclass(frozen=True, eq=False)
class Known:
    """The result for a whole recording, from which other weights give another suspicion. changed: (frames, 0 or 1)."""

    key: Key
    recording: Recording
    scores: NDArray[np.float32]
    changed: NDArray[np.floating]
    totals: dict[str, int] | None


def told(subject: Subject, known: Known) -> Surveyed:
    """The message with every frame."""
    return surveyed(subject, np.hstack([ranked(subject.key, known.scores), known.changed]), totals=known.totals)


def ranked(key: Key, scores: NDArray[np.floating]) -> NDArray[np.floating]:
    """The scores and the suspicion, which is unknown unless it is shown, and as long as the committee is."""
    known = key.deep and len(scores) > 0 and not np.isnan(scores[0, COLUMN.disputed])
    rank = suspicion(scores, all_weights(key.weights)) if known else np.full(len(scores), np.nan)
    return np.column_stack((scores, rank))


class Strip:
    """Surveys in its own thread; a new subject stops the previous one.

    A long recording first gets a quick survey of evenly spread frames, ready while a slider is still moving.
    ready: set once the kernels are compiled. send: called in the strip's thread; may block. whole: called there with
    each survey of all frames.
    """

    def __init__(
        self,
        name: str,
        ready: threading.Event,
        send: Callable[[BaseModel], None],
        whole: Callable[[Recording, Survey], None] = lambda recording, survey: None,
    ) -> None:
        self._ready, self._send, self._whole = ready, send, whole
        self._glance = lru_cache(maxsize=1)(glance_of)
        self._known: Known | None = None
        self._pinned: tuple[Recording, Thresholds, Survey] | None = None
        self._lock = threading.Condition()
        self._subject: Subject | None = None
        self._begun_at = -math.inf
        self._asked_at = -math.inf
        self._closing = False
        self._rest_until = 0.0
        self._surveying = Newest(name, self._work)

    def want(self, view: View, recording: Recording, rev: int, passing: bool = False) -> None:
        """Survey this unless it has been surveyed; only quickly, in passing, if a newer one is about to come."""
        key = key_of(view)
        self.keep(view)
        with self._lock:
            before, self._asked_at = self._asked_at, time.monotonic()
            subject = Subject(key, recording, rev, np.full(1, passing), self._asked_at - before < DRAG)
            if self._subject is None:
                self._subject = subject
                self._surveying.put(subject)
            elif self._subject.recording is not recording:
                if self._subject.recording.partial and not recording.partial:
                    self._subject.stop[0] = True
                    self._subject = subject
                growing = view.live or recording.partial
                self._surveying.put(subject, due=self._rest_until if growing else 0.0)

    def keep(self, view: View | None) -> None:
        """Stop work that is not for this View; with None, stop any work, which may be requested again."""
        with self._lock:
            if self._subject is not None and (view is None or self._subject.key != key_of(view)):
                self._subject.stop[0] = True
                self._subject = None
                self._surveying.drop()
                self._lock.notify_all()

    def close(self) -> None:
        """Stop; blocks until the thread has ended."""
        self.keep(None)
        with self._lock:
            self._closing = True
        self._surveying.close()

    def _work(self, asked: Subject) -> None:
        with ExitStack() as turn:
            turn.enter_context(QUICK.turn())
            subject = self._begins(asked)
            if subject is None:
                return
            try:
                for part in self._parts(subject, turn.close):
                    if self._stands(subject):
                        self._send(part)
                self._rest(subject)
            except Cancelled:
                pass
            except Exception as error:
                log.exception("surveying %s failed", subject.key)
                self._send(surveyed(subject, message=f"no scores: {_one_line(error)}"))

    def _rest(self, subject: Subject) -> None:
        """Before what a recording has grown to is surveyed, rest for longer if that takes long."""
        with self._lock:
            now = time.monotonic()
            self._rest_until = max(self._rest_until, now + LIVE_REST * (now - self._begun_at))
            if self._subject is not None and self._subject.key == subject.key:
                self._surveying.hold(self._rest_until)

    def _begins(self, asked: Subject) -> Subject | None:
        """What to survey now: this, or the newer one that came while it waited for its turn; None if none is wanted."""
        with self._lock:
            if self._closing or self._subject is None:
                return None
            if self._subject.key != asked.key:
                self._surveying.drop()
            else:
                # What the recording has grown to.
                self._subject = asked
            self._begun_at = time.monotonic()
            self._rest_until = self._begun_at + LIVE_EVERY
            return self._subject

    def _stands(self, subject: Subject) -> bool:
        """Whether it still matches the screen; a quick survey may be one change of the thresholds late."""
        with self._lock:
            now = self._subject
            return not self._closing and (now is None or now.key[:2] == subject.key[:2])

    def _parts(self, subject: Subject, end_turn: Callable[[], None]) -> Iterator[Surveyed]:
        key, recording = subject.key, subject.recording
        if len(recording) < 2:
            end_turn()
            yield surveyed(subject, message="one frame: nothing to compare")
            return
        while not self._ready.wait(0.1):
            if subject.stop[0]:
                return
        if (
            self._known is not None
            and self._known.key == key._replace(weights=())
            and self._known.recording is recording
        ):
            end_turn()
            yield told(subject, self._known)
            return
        stride = stride_of(recording)
        if stride >= LEAST_STRIDE:
            # The other methods are too slow for a quick survey that cannot be stopped.
            scores = self._glanced_scores(recording, stride, key.params) if isinstance(key.params, Params) else None
            end_turn()
            if scores is not None:
                yield surveyed(subject, ranked(key, scores), stride)
            self._wait_for_end_of_drag(subject)
            if subject.stop[0]:
                return
        elif not isinstance(key.params, Params):
            # Too slow to let other tabs wait for it.
            end_turn()
        whole = done_behind(partial(survey, recording, key.params, subject.stop))
        self._whole(recording, whole)
        committee = known_committee(recording)
        if committee is not None:
            whole = disputed(recording, whole, committee, np.arange(len(recording)))
        end_turn()
        known = Known(key._replace(weights=()), recording, whole.need_scores(), np.empty((len(recording), 0)), None)
        # While a recording grows, its suspicion as it was stays until it is known anew.
        grown = key.deep and self._known is not None and self._known.key == known.key
        if not grown:
            yield told(subject, known)
        if key.against is not None:
            fates = differences(self._pinned_survey(subject, key.against.params), whole, recording)
            changed = fates.sum(axis=1, keepdims=True) - fates[:, [KEPT]]
            totals = {name: int(total) for name, total in zip(FATES, fates.sum(axis=0), strict=True)}
            known = replace(known, changed=changed, totals=totals)
            yield told(subject, known)
        if key.deep and committee is None:
            whole = done_behind(partial(with_disputes, recording, whole, subject.stop))
            known = replace(known, scores=whole.need_scores())
            yield told(subject, known)
        if key.deep:
            deep = done_behind(partial(with_stability, recording, whole, subject.stop))
            known = replace(known, scores=deep.need_scores())
            yield told(subject, known)
        self._known = known

    def _wait_for_end_of_drag(self, subject: Subject) -> None:
        if subject.dragged:
            with self._lock:
                self._lock.wait_for(lambda: subject.stop[0], DRAG)

    def _glanced_scores(self, recording: Recording, stride: int, params: Params) -> NDArray[np.float32]:
        glance = self._glance(recording, stride)
        threes, committee = survey(glance, params, threads=1), known_committee(recording)
        if committee is not None:
            threes = disputed(glance, threes, committee, glanced_frames(len(recording), stride))
        scores = threes.need_scores()[1::3]
        # The first and the last frame have only one neighbour.
        ends = np.isin(np.arange(0, len(recording), stride), (0, len(recording) - 1))
        scores[ends] = np.where([name in BESIDE for name in SCORES], 0, scores[ends])
        return scores

    def _pinned_survey(self, subject: Subject, params: Thresholds) -> Survey:
        """The survey of A, which stays the same while the thresholds of B change."""
        if self._pinned is None or self._pinned[0] is not subject.recording or self._pinned[1] != params:
            pinned = done_behind(partial(survey, subject.recording, params, subject.stop, scores=False))
            self._pinned = subject.recording, params, pinned
        return self._pinned[2]


def surveyed(
    subject: Subject,
    scores: NDArray[np.floating] | None = None,
    stride: int = 1,
    message: str | None = None,
    totals: dict[str, int] | None = None,
) -> Surveyed:
    """The message with scores (frames, scores) of every stride-th frame."""
    first, every = numbering(subject.recording)
    return Surveyed(
        rev=subject.rev,
        recording=subject.key.recording,
        place=subject.key.place,
        method=subject.key.method,
        params=subject.key.params.numbers(),
        frames=len(subject.recording),
        first=first,
        every=every,
        stride=stride,
        message=message,
        totals=totals,
        values=b"" if scores is None else scores.T.astype("<f4").tobytes(),
    )


def stride_of(recording: Recording) -> int:
    """The stride of a quick survey."""
    return -(-3 * int(recording.offsets[-1]) // GLANCE_BEAMS)


def glance_of(recording: Recording, stride: int) -> Recording:
    """Every stride-th frame with its two neighbours, for scores that compare them."""
    return recording.only(glanced_frames(len(recording), stride))


def glanced_frames(frames: int, stride: int) -> NDArray[np.int64]:
    """Triples of every stride-th frame and its two neighbours."""
    glanced = np.arange(0, frames, stride)
    beside = np.column_stack((glanced - 1, glanced, glanced + 1))
    return np.clip(beside, 0, frames - 1).ravel()


def _one_line(error: Exception) -> str:
    said = next(iter(str(error).splitlines()), "")
    return said if isinstance(error, (ValueError, OSError)) else f"{type(error).__name__}: {said}"
