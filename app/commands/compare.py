"""`lineseg compare`: all methods on the same frames."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.readers import Reading
from lineseg.scan import Recording
from lineseg.unfinished import write_whole

from .flag_types import Several, Unset
from .progress import open_with_truth, progress_bar
from .reading import ReadingFlags, reading_of

if TYPE_CHECKING:
    from lineseg.compare import Comparison

SAMPLES = ("hallway", "laboratory")


def compare(
    files: Positional[Annotated[Several[str], arg(metavar="[FILE ...]")]] = (),
    *,
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    methods: Annotated[Several[str], arg(metavar="NAME ...")] = (),
    budget: int = 150,
    most_frames: int = 60,
    out: Annotated[Unset[Path], arg(aliases=["-o"])] = None,
    figures: Unset[Path] = None,
) -> None:
    """Compare methods as in the paper's tables.

    The tables give TR, FR, completeness, endpoint errors and time. Each method is judged on one half of the frames with
    three settings: as installed; as proposed without truth, by the same search on the other half for each; and tuned
    with the truth of the other half. Recordings without truth take the walls that their scans with poses agree on; if
    there are none, methods are only timed. Ctrl-C stops and writes the results so far.

    Args:
        files: recordings, or names of samples and simulated worlds (default: all samples and worlds).
        methods: names of methods (default: all).
        budget: number of settings to try for each method, without and with truth; 0 runs the defaults only.
        reading: how to read the files.
        most_frames: number of frames to use from each recording; half of them are for tuning.
        out: file to write, .md, .csv or .json (default: Markdown on standard output).
        figures: folder for two pictures of each recording: the times of all frames, and one frame with every method.
    """
    from lineseg.compare import TABLE_WRITERS, Comparison
    from lineseg.compare.figures import write_figures
    from lineseg.simulate.worlds import WORLDS

    if out is not None and out.suffix.lower() not in TABLE_WRITERS:
        raise ValueError(f"{out}: use a name that ends in {', '.join(TABLE_WRITERS)}.")
    if out is not None and not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    if figures is not None and not figures.is_dir():
        raise FileNotFoundError(f"{figures}: there is no such folder; create it first.")
    recordings = [_recording(name, reading_of(reading)) for name in files or (*SAMPLES, *WORLDS)]
    comparisons = [Comparison(recording, methods or None, budget, most_frames) for recording in recordings]
    _run(comparisons)
    rows = [row for comparison in comparisons for row in comparison.rows]
    for comparison in comparisons:
        if figures is not None and comparison.rows:
            write_figures(comparison.rows, comparison.recording, comparison.halves.judged, figures)
    text = TABLE_WRITERS[".md" if out is None else out.suffix.lower()](rows)
    if out is None:
        sys.stdout.write(text)
    else:
        write_whole(out, text)


def _run(comparisons: Sequence[Comparison]) -> None:
    """Run until all is done, or until Ctrl-C."""
    total = sum(comparison.steps for comparison in comparisons)
    done = 0
    with progress_bar("compare", "step") as advance:
        try:
            for comparison in comparisons:
                for step, _ in enumerate(comparison.run(), 1):
                    done += 1
                    advance(done, total)
                    if step == len(comparison.methods):
                        _tell(comparison)
        except KeyboardInterrupt:
            if not any(comparison.rows for comparison in comparisons):
                raise
            print("lineseg: stopped; writing the results so far.", file=sys.stderr)


def _tell(comparison: Comparison) -> None:
    """The text above the progress bar: how the recording is divided, and which method leads."""
    from tqdm import tqdm

    from lineseg.compare.tables import ranked

    training, judged = (len(half) for half in comparison.halves)
    text = f"{comparison.recording.name}: {training} frames for tuning, {judged} for judging"
    if comparison.truth:
        best = ranked(comparison.rows)[0]
        text += f"; as installed {best.label} leads, {best.score:.3f}"
    tqdm.write(text, file=sys.stderr)


def _recording(name: str, reading: Reading) -> Recording:
    """A file, or the sample or simulated world with this name."""
    from lineseg.simulate.worlds import WORLDS

    from ..places import data_folder

    path = Path(name)
    if name in SAMPLES and not path.exists():
        path = data_folder("sample_scans") / f"{name}.npz"
    if name in WORLDS and not path.exists():
        return WORLDS[name].recording(name)
    if not path.exists():
        known = ", ".join((*SAMPLES, *WORLDS))
        raise FileNotFoundError(f"{name}: there is no such file, sample or world. Samples and worlds: {known}.")
    return open_with_truth(path, reading)
