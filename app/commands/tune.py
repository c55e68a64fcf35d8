"""`lineseg tune`: searches for thresholds that fit recordings."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Literal

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.params import Params
from lineseg.unfinished import write_whole
from lineseg.writers import params_text

from .flag_types import Files, Unset
from .progress import progress_bar, tell_by_views
from .reading import ReadingFlags, files_of, reading_of
from .thresholds import read_file


def tune(
    files: Positional[Files[Path]],
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    trials: int = 100,
    objective: Unset[Literal["truth", "label-free"]] = None,
    thresholds: Annotated[Unset[tuple[str, ...]], arg(metavar="NAME ...")] = None,
    split: Literal["frames", "files"] = "frames",
    most_frames: Unset[int] = None,
    recall: float = 1.0,
    completeness: float = 1.0,
    study: Unset[Path] = None,
    out: Annotated[Unset[Path], arg(aliases=["-o"])] = None,
    to: Literal["ros2", "ros1", "python", "flags"] = "ros2",
    params: Unset[Path] = None,
    scheduler: Annotated[Unset[str], arg(metavar="ADDRESS")] = None,
) -> None:
    """Search for thresholds with Optuna.

    The best are compared with the current ones and with the paper's defaults, on held-back frames. Ctrl-C stops the
    search and judges the best setting so far. With --study the trials are kept, and the next call continues them.

    Args:
        files: recordings to read; * and ? stand for several.
        reading: how to read the files.
        trials: number of settings to try in this call.
        objective: compare with the truth, or with lines that fit the noise of the laser (default: truth if all files
            have it, if need be the walls that scans with poses agree on).
        thresholds: names of the thresholds to tune (default: the paper's five with truth; epsilon, delta and
            seed_points without it, because label-free scores cannot know which lines you want).
        split: what to hold back: every other stretch of frames, or every other file.
        most_frames: total number of frames to use, spread over the files (default: all).
        recall: weight of TR relative to 1 - FR.
        completeness: exponent of the completeness.
        study: SQLite file to keep the trials in.
        out: file for the best thresholds (default: standard output).
        to: format of the thresholds.
        params: the present thresholds, kept where they are not tuned (default: the paper's defaults): ROS 1 launch
            file, ROS 2 YAML, JSON, Python or flags.
        scheduler: address of a Dask scheduler, such as tcp://host:8786 (default: threads of this machine).
    """
    from lineseg.sweep import pool
    from lineseg.tuning import FileBlocks, Objective, Tuning

    _check(trials, out)
    base = Params() if params is None else read_file(params, Params)
    with pool(scheduler) as workers:
        blind = None if objective is None else objective == "label-free"
        recordings = files_of(files)
        blocks = FileBlocks(recordings, workers, blind, split, reading_of(reading), most_frames, base)
        kind = objective or ("truth" if blocks.truth else "label-free")
        aim = Objective(kind, recall, completeness)
        tuning = Tuning(blocks, aim, study, thresholds, base)
        print(f"{aim.text}\n{aim.caution}", file=sys.stderr)
        for source in blocks.sources:
            tell_by_views(source.file, source.truth, source.by_views)
        _search(tuning, trials)
        verdict = tuning.verdict()
    _tell(verdict.text, tuning.importance())
    _write(params_text(verdict.params, to, ", ".join(each.name for each in recordings)), out)


def _check(trials: int, out: Path | None) -> None:
    if trials < 0:
        raise ValueError(f"--trials is {trials}; give 0 or more")
    if out is not None and not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")


def _tell(verdict: str, importance: Mapping[str, float]) -> None:
    print(verdict, file=sys.stderr)
    for name, share in importance.items():
        print(f"  {name:<14}{share:4.0%} importance", file=sys.stderr)


def _write(text: str, out: Path | None) -> None:
    if out is None:
        sys.stdout.write(text)
    else:
        write_whole(out, text)


def _search(tuning, trials: int) -> None:
    """Run all trials, or until Ctrl-C."""
    with progress_bar("tune", "trial") as advance:
        try:
            for done, _ in enumerate(tuning.run(trials), 1):
                advance(done, trials)
        except KeyboardInterrupt:
            if not tuning.trials():
                raise
            print("lineseg: stopped; judging the best setting so far.", file=sys.stderr)
