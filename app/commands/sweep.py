"""`lineseg sweep`: tries many threshold values on whole recordings."""

from __future__ import annotations

from dataclasses import asdict, make_dataclass
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.knobs import Knob
from lineseg.params import Params

from .flag_types import Files, Unset
from .progress import progress_bar, tell_by_views
from .reading import ReadingFlags, files_of, reading_of
from .thresholds import read_file


def _axis_flag(knob: Knob, default: float) -> Any:
    text = f"{knob.symbol}{f' [{knob.unit}]' if knob.unit else ''}: {knob.help}"
    hint = f"(default: {default:g})"
    return Annotated[str | None, arg(help=text, metavar="FROM:TO:COUNT", help_behavior_hint=hint)]


Axes: type = make_dataclass(
    "Axes",
    [(name, _axis_flag(knob, getattr(Params(), name)), None) for name, _, knob in Params.knobs()],
    frozen=True,
)


def sweep(
    files: Positional[Files[Path]],
    threshold: OmitArgPrefixes[Axes],  # type: ignore[valid-type]
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    plot: Unset[Path] = None,
    measure: Annotated[Unset[str], arg(metavar="NAME")] = None,
    params: Unset[Path] = None,
    scheduler: Annotated[Unset[str], arg(metavar="ADDRESS")] = None,
) -> None:
    """Try every combination of threshold values on whole recordings.

    The table has coverage, segments and, with truth, TR and FR. Recordings without truth take the walls that their
    scans with poses agree on. Give thresholds as FROM:TO:COUNT, as values separated
    by commas, or as one value. To resume an interrupted sweep, run it again: finished work is kept in a file next to
    the table until the table is complete.

    Args:
        files: recordings to read; * and ? stand for several.
        threshold: values of the thresholds (default: from --params, else the defaults).
        reading: how to read the files.
        out: table to write, .csv or .parquet, with a row for each file and setting.
        plot: picture to write, .png or .svg: curves for one threshold, or a map for the first two.
        measure: the measure that the map shows.
        params: thresholds to start from: ROS 1 launch file, ROS 2 YAML, JSON, Python or flags.
        scheduler: address of a Dask scheduler, such as tcp://host:8786 (default: threads of this machine). Its workers
            must find the files at the same paths.
    """
    from lineseg.sweep import MEASURES, Grid, Journal, axis_values, pool
    from lineseg.sweep import sweep as measure_all
    from lineseg.sweep.plot import check_plot_path, write_plot
    from lineseg.sweep.table import check_table_path, write_table

    if not files:
        raise ValueError("a sweep needs at least one recording; name a file.")
    if measure is not None and measure not in MEASURES:
        raise ValueError(f"there is no measure {measure!r}; choose from {', '.join(MEASURES)}.")
    check_table_path(out)
    if plot is not None:
        check_plot_path(plot)
    given = {name: axis_values(text, name) for name, text in asdict(threshold).items() if text is not None}
    base = Params() if params is None else read_file(params, Params)
    grid = Grid(base, given)
    journal = Journal(out.with_name(out.name + ".partial"))
    complete = False
    try:
        with pool(scheduler) as workers, progress_bar("sweep", "frame") as advance:
            result = measure_all(files_of(files), grid, workers, reading_of(reading), journal, advance)
        write_table(result, out)
        for source in result.sources:
            tell_by_views(source.file, source.truth, source.by_views)
        complete = True
    finally:
        journal.close(remove=complete)
    if plot is not None:
        write_plot(result, plot, measure)
    print(_summary(result))


def _summary(result: Any) -> str:
    """The best setting, if truth is known."""
    import numpy as np

    totals = result.all_files
    frames = sum(source.frames for source in result.sources)
    said = f"{len(result.grid):,} settings on {frames:,} frames"
    scores = totals.measure("f_score")
    if not np.isfinite(scores).any():
        return f"{said}; without truth there is no single best setting; `lineseg tune` finds one that fits the noise."
    best = int(np.nanargmax(scores))
    params = asdict(next(p for k, p in enumerate(result.grid) if k == best))
    values = ", ".join(f"{name} {params[name]:g}" for name in result.grid.axes) or "the given thresholds"
    return f"{said}; best F × completeness {scores[best]:.4f} at {values}."
