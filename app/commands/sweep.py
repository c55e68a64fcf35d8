"""`lineseg sweep`: what the thresholds do to whole recordings."""

from __future__ import annotations

from dataclasses import asdict, make_dataclass
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.params import Params
from lineseg.writers import read_params

from .progress import progress_bar


def _axis_flag(symbol: str, unit: str, text: str) -> Any:
    return Annotated[str | None, arg(help=f"{symbol}{f' [{unit}]' if unit else ''}: {text}", metavar="FROM:TO:COUNT")]


Axes: type = make_dataclass(
    "Axes",
    [(name, _axis_flag(knob.symbol, knob.unit, knob.help), None) for name, _, knob in Params.knobs()],
    frozen=True,
)


def sweep(
    files: Positional[list[Path]],
    axes: OmitArgPrefixes[Axes],  # type: ignore[valid-type]
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    plot: Path | None = None,
    measure: str | None = None,
    params: Path | None = None,
    topic: str | None = None,
    scheduler: str | None = None,
) -> None:
    """Try every combination of threshold values on whole recordings: coverage, segments, and with truth TR and FR.

    Thresholds are given as FROM:TO:COUNT, as values with commas between them, or as one value. An interrupted sweep
    goes on where it was when it is called again: what is done is kept beside the table until that is written.

    Args:
        files: recordings to read.
        axes: those that are not given are taken from --params, or are the defaults.
        out: table to write, .csv or .parquet: a row for each file and setting.
        plot: picture to write, .png or .svg: curves over one threshold, or a map over the first two.
        measure: what the map shows.
        params: ROS 1 launch file, ROS 2 YAML, JSON, Python or flags with thresholds to start from.
        topic: laser topic to take; the first without.
        scheduler: address of a Dask scheduler, such as tcp://host:8786; its workers must find the files under the same
            paths. The threads of this machine without.
    """
    from lineseg.sweep import MEASURES, Grid, Journal, axis_values, pool
    from lineseg.sweep import sweep as measure_all
    from lineseg.sweep.plot import check_plot_path, write_plot
    from lineseg.sweep.table import check_table_path, write_table

    if not files:
        raise ValueError("a sweep needs one recording or more.")
    if measure is not None and measure not in MEASURES:
        raise ValueError(f"there is no measure {measure!r}; there are {', '.join(MEASURES)}.")
    check_table_path(out)
    if plot is not None:
        check_plot_path(plot)
    given = {name: axis_values(text, name) for name, text in asdict(axes).items() if text is not None}
    base = Params() if params is None else read_params(params.read_text(encoding="utf-8-sig"))
    grid = Grid(base, given)
    journal = Journal(out.with_name(out.name + ".partial"))
    complete = False
    try:
        with pool(scheduler) as workers, progress_bar("sweep", "frame") as advance:
            result = measure_all(files, grid, workers, topic, journal, advance)
        write_table(result, out)
        complete = True
    finally:
        journal.close(remove=complete)
    if plot is not None:
        write_plot(result, plot, measure)
    print(_summary(result))


def _summary(result: Any) -> str:
    """The best setting, if there is truth to tell."""
    import numpy as np

    totals = result.all_files
    frames = sum(source.frames for source in result.sources)
    said = f"{len(result.grid):,} settings on {frames:,} frames"
    scores = totals.measure("f_score")
    if not np.isfinite(scores).any():
        return f"{said}; without truth none of them is best by itself: `lineseg tune` weighs the label-free scores."
    best = int(np.nanargmax(scores))
    params = asdict(next(p for k, p in enumerate(result.grid) if k == best))
    values = ", ".join(f"{name} {params[name]:g}" for name in result.grid.axes) or "the thresholds as they are"
    return f"{said}; best F × completeness {scores[best]:.4f} at {values}."
