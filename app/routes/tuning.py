"""The page's socket for long work: sensitivity curves, maps, auto-tuning. A new request stops the previous one."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import math
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, get_args

import numpy as np
from fastapi import FastAPI
from numpy.typing import NDArray
from pydantic import Field, TypeAdapter, ValidationError
from starlette.exceptions import HTTPException
from starlette.websockets import WebSocket, WebSocketDisconnect

from lineseg import Cancelled, Params
from lineseg.failing import mistake, sentence_of
from lineseg.sweep import MEASURES, pool
from lineseg.sweep.workers import Pool
from lineseg.tuning import Objective, RecordingBlocks, Trial, Tuning

from ..bounds import Message, Name, Number, sentence
from ..newest import Newest
from ..session.sessions import Sessions
from ..told.answers import Job, Tuned
from ..told.answers import Trial as TrialTold
from ..tuning.fit import fit
from ..tuning.kept_trials import KeptTrials
from ..tuning.sensitivity import Subject, curves, relief
from .heard import text_from

# Frames per recording; more would slow down the trials and add little information.
MOST_FRAMES = 400
MOST_TRIALS = 2000
JUDGE_EVERY = 10
SURVEYED = "region-growing"

SEND_SECONDS = 30.0
log = logging.getLogger(__name__)
Values = Annotated[dict[Name, int | Number], Field(max_length=64)]


class CurvesWish(Message):
    type: Literal["curves"]
    job: int
    params: Values


class MapWish(Message):
    type: Literal["map"]
    job: int
    params: Values
    x: Name
    y: Name
    measure: Name


class AutoWish(Message):
    """anew: forget the trials of earlier runs."""

    type: Literal["auto"]
    job: int
    params: Values
    objective: Literal["truth", "label-free"]
    thresholds: Annotated[list[Name], Field(max_length=64)]
    trials: Annotated[int, Field(ge=1, le=MOST_TRIALS)]
    anew: bool = False


class FitWish(Message):
    """For the recording, the method and the thresholds on the screen."""

    type: Literal["fit"]
    job: int


class StopWish(Message):
    type: Literal["stop"]
    what: Job


Wish = CurvesWish | MapWish | AutoWish | FitWish | StopWish
_WISH: TypeAdapter[Wish] = TypeAdapter(Annotated[Wish, Field(discriminator="type")])
Answers = Iterator[Mapping[str, object]]


class Piece(NamedTuple):
    """A piece of work; number: by which the page knows its answers."""

    number: int
    work: Callable[[Pool], Answers]


class Slot:
    """One kind of work. Starting it again stops the previous work. Answers are sent in the thread of the work.

    A person waits for auto-tuning; all other work lets other threads go first.
    """

    def __init__(self, name: str, send: Callable[[dict[str, Any]], None]) -> None:
        self._name, self._send = name, send
        self._stop: NDArray[np.bool_] | None = None
        self._newest = Newest[Piece](f"tuning {name}", self._run, behind=name != "auto")

    def begin(self, number: int, stop: NDArray[np.bool_], work: Callable[[Pool], Answers]) -> None:
        self.stop()
        self._stop = stop
        self._newest.put(Piece(number, work))

    def stop(self) -> None:
        if self._stop is not None:
            self._stop[0] = True

    def close(self) -> None:
        """Stop; blocks until the work has ended."""
        self.stop()
        self._newest.close()

    def _run(self, job: Piece) -> None:
        about = {"type": self._name, "job": job.number}
        try:
            with pool() as workers:
                for answer in job.work(workers):
                    self._send({**about, **answer})
            self._send(about | {"done": True})
        except Cancelled:
            self._send(about | {"done": True, "stopped": True})
        except ValueError as error:
            self._send(about | {"done": True, "message": str(error)})
        except OSError as error:
            self._send(about | {"done": True, "message": sentence_of(error, str(error.filename or "the trials"))})
        except Exception as error:
            log.exception("%s failed", self._name)
            self._send(about | {"done": True, "message": mistake(error)})


def add_tuning(app: FastAPI, sessions: Sessions, folder: Path) -> None:
    """The socket /api/tuning?session=…; folder: where studies are kept."""

    @app.websocket("/api/tuning")
    async def tuning_socket(socket: WebSocket, session: str = "") -> None:
        await socket.accept()
        loop = asyncio.get_running_loop()

        def send(answer: dict[str, Any]) -> None:
            """Send an answer; if nobody listens any more, everything ends."""
            try:
                asyncio.run_coroutine_threadsafe(socket.send_text(json.dumps(answer)), loop).result(SEND_SECONDS)
            except Exception:
                for slot in slots.values():
                    slot.stop()

        slots = {name: Slot(name, send) for name in get_args(Job)}
        measures = {"type": "measures", "measures": [asdict(each) for each in MEASURES.values()]}
        try:
            with contextlib.suppress(WebSocketDisconnect, RuntimeError):
                await socket.send_text(json.dumps(measures))
                while True:
                    trouble = _obey(await text_from(socket), slots, sessions, session, folder)
                    if trouble is not None:
                        await socket.send_text(json.dumps({"type": "error", "message": trouble}))
        finally:
            await asyncio.to_thread(_close, slots.values())


def _close(slots: Collection[Slot]) -> None:
    for slot in slots:
        slot.stop()
    for slot in slots:
        slot.close()


def _obey(text: str, slots: dict[str, Slot], sessions: Sessions, session: str, folder: Path) -> str | None:
    """Start the requested work, or answer with one sentence why not."""
    try:
        wish = _WISH.validate_json(text)
        if isinstance(wish, StopWish):
            slots[wish.what].stop()
            return None
        shown = sessions.shown(session)
        view, stop = shown.view, np.zeros(1, np.bool_)
        if isinstance(wish, FitWish):
            work = fit(shown.recording, view.params, view.method, stop)
            slots["fit"].begin(wish.job, stop, lambda workers: work)
        else:
            if view.method != SURVEYED:
                raise ValueError("auto-tuning works with region growing only; choose region growing")
            subject = Subject(shown.recording, Params().but(**wish.params), stop)
            slots[wish.type].begin(wish.job, stop, _work_of(wish, subject, folder))
    except ValidationError as error:
        return sentence(error)
    except HTTPException as error:
        return error.detail
    except ValueError as error:
        return str(error)
    except Exception as error:
        log.exception("a wish failed")
        return mistake(error)
    return None


def _work_of(wish: CurvesWish | MapWish | AutoWish, subject: Subject, folder: Path) -> Callable[[Pool], Answers]:
    match wish:
        case CurvesWish():
            names = [name for name, _, _ in Params.knobs()]
            return lambda workers: curves(subject, workers, names)
        case MapWish(x=x, y=y, measure=measure):
            if x == y or measure not in MEASURES or not {x, y} <= {name for name, _, _ in Params.knobs()}:
                raise ValueError(f"a map needs two thresholds and one of {', '.join(MEASURES)}")
            return lambda workers: relief(subject, workers, x, y, measure)
        case AutoWish():
            return lambda workers: search(subject, workers, wish, folder)


def search(subject: Subject, workers: Pool, wish: AutoWish, folder: Path) -> Iterator[Tuned]:
    """Yield trials as they finish, and now and then the importances and the gain; a stop ends with a verdict too."""
    objective = Objective(wish.objective)
    blind = objective.kind == "label-free"
    blocks = RecordingBlocks(subject.recording, workers, blind, MOST_FRAMES, subject.params)
    tuning = Tuning(blocks, objective, None, wish.thresholds, subject.params)
    kept = KeptTrials(folder, _about(blocks, objective, wish))
    if wish.anew:
        kept.forget()
    tuning.recall(kept.read())
    yield {
        "text": objective.text,
        "caution": objective.caution,
        "thresholds": wish.thresholds,
        "trials": [_trial(trial) for trial in tuning.trials()],
    }
    judged = None
    for tried in range(1, wish.trials + 1):
        if subject.stop[0]:
            break
        trial = tuning.step()
        kept.add(trial)
        yield {"trials": [_trial(trial)]}
        if tried % JUDGE_EVERY == 0 and judged != (judged := tuning.best().number):
            yield _judged(tuning)
    yield _judged(tuning)


def _about(blocks: RecordingBlocks, objective: Objective, wish: AutoWish) -> dict[str, object]:
    """What distinguishes this study from others: recording, objective, tuned thresholds, and values of the rest."""
    fixed = {name: value for name, value in wish.params.items() if name not in wish.thresholds}
    return {
        "recording": blocks.name,
        "frames": list(blocks.frames),
        "objective": [asdict(objective), objective.text],
        "thresholds": wish.thresholds,
        "fixed": fixed,
    }


def _trial(trial: Trial) -> TrialTold:
    score = None if math.isnan(trial.score) else round(trial.score, 5)
    return {"number": trial.number, "params": asdict(trial.params), "score": score}


def _judged(tuning: Tuning) -> Tuned:
    verdict = tuning.verdict()
    return {
        "importance": tuning.importance(),
        "verdict": {"params": asdict(verdict.params), "text": verdict.text, "gained": verdict.gained},
    }
