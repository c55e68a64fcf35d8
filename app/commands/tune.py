"""`lineseg tune`: thresholds that fit recordings, found by trying."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Literal

from tyro.conf import Positional, arg

from lineseg.params import Params
from lineseg.writers import params_text, read_params

from .progress import progress_bar


def tune(
    files: Positional[list[Path]],
    *,
    trials: int = 100,
    objective: Literal["truth", "label-free"] | None = None,
    thresholds: tuple[str, ...] | None = None,
    split: Literal["frames", "files"] = "frames",
    frames: int | None = None,
    recall: float = 1.0,
    completeness: float = 1.0,
    rms: float = 0.03,
    study: Path | None = None,
    out: Annotated[Path | None, arg(aliases=["-o"])] = None,
    to: Literal["ros2", "ros1", "python", "flags"] = "ros2",
    params: Path | None = None,
    topic: str | None = None,
    scheduler: str | None = None,
) -> None:
    """Search for thresholds by Optuna, and compare the best with the paper's defaults on frames that were held back.

    Ctrl-C stops the search, and what was found so far is judged. With --study the trials are kept, and another call
    goes on with them.

    Args:
        files: recordings to read.
        trials: how many settings to try in this call.
        objective: compare with the truth, or judge by the scans alone; truth where all files have it, without.
        thresholds: names of those to tune; without, all of the paper's five with truth, and epsilon, delta and
            seed_points without, since which lines are wanted no label-free score can know.
        split: hold back every other stretch of frames, or every other file.
        frames: take so many frames in all, spread over the files; all of them without.
        recall: of truth, how many times as much TR weighs as 1 - FR.
        completeness: of truth, the exponent of the completeness.
        rms: of label-free, the root mean square distance [m] at which the score is halved.
        study: SQLite file to keep the trials in.
        out: file for the thresholds that were found; on standard output without.
        to: how to write them.
        params: ROS 1 launch file, ROS 2 YAML, JSON, Python or flags with the thresholds that are not tuned.
        topic: laser topic to take; the first without.
        scheduler: address of a Dask scheduler, such as tcp://host:8786.
    """
    from lineseg.sweep import pool
    from lineseg.tuning import FileBlocks, Objective, Tuning

    if trials < 0:
        raise ValueError(f"--trials is {trials}; 0 or more can be tried")
    if out is not None and not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    base = Params() if params is None else read_params(params.read_text(encoding="utf-8-sig"))
    with pool(scheduler) as workers:
        blocks = FileBlocks(files, workers, objective != "truth", split, topic, frames)
        kind = objective or ("truth" if blocks.truth else "label-free")
        aim = Objective(kind, recall, completeness, rms)
        tuning = Tuning(blocks, aim, study, thresholds, base)
        print(f"{aim.text}\n{aim.caution}", file=sys.stderr)
        _search(tuning, trials)
        verdict = tuning.verdict()
    print(verdict.text, file=sys.stderr)
    for name, share in tuning.importance().items():
        print(f"  {name:<14}{share:4.0%} of what makes a trial good", file=sys.stderr)
    text = params_text(verdict.params, to)
    if out is None:
        sys.stdout.write(text)
    else:
        out.write_text(text, encoding="utf-8")


def _search(tuning, trials: int) -> None:
    """Until all are tried, or Ctrl-C."""
    with progress_bar("tune", "trial") as advance:
        try:
            for done, _ in enumerate(tuning.run(trials), 1):
                advance(done, trials)
        except KeyboardInterrupt:
            if not tuning.trials():
                raise
            print("lineseg: stopped; judging what was found.", file=sys.stderr)
