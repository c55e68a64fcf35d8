"""Plots a sweep: curves over one threshold, or a map of a measure over two."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..installation import install_command
from ..unfinished import whole_file
from . import MEASURES, Sweep
from .axes import knob_of

PLOT_FORMATS = (".png", ".svg")


def check_plot_path(path: Path) -> None:
    """Raises ValueError or FileNotFoundError if the plot cannot be written, before hours of work are spent."""
    if path.suffix.lower() not in PLOT_FORMATS:
        raise ValueError(f"{path}: use a name that ends in {' or '.join(PLOT_FORMATS)}")
    if not path.absolute().parent.is_dir():
        raise FileNotFoundError(f"{path}: the folder {path.parent} does not exist")
    figure_type()


def write_plot(result: Sweep, path: Path, measure: str | None = None) -> None:
    """Plot the first one or two swept thresholds, for all files together, with the best values of the others.

    measure: of the map (default: F × completeness if truth is known, else coverage).
    """
    totals = result.all_files
    measure = measure or ("f_score" if totals.has_truth else "coverage")
    axes = [name for name, values in result.grid.axes.items() if len(values) > 1]
    if not axes:
        raise ValueError("a plot needs a threshold with more than one value; sweep at least one")
    figure = figure_type()(figsize=(7, 4.5), layout="constrained")
    plot = figure.subplots()
    if len(axes) == 1:
        _curves(plot, result, axes[0])
    else:
        _map(figure, plot, result, (axes[0], axes[1]), measure)
    figure.suptitle(_title(result), fontsize=10)
    with whole_file(path) as unfinished:
        figure.savefig(unfinished, format=path.suffix[1:].lower(), dpi=150)


def _curves(plot: Any, result: Sweep, name: str) -> None:
    totals = result.all_files
    values = result.grid.axes[name]
    names = ["coverage", "true_rate", "false_rate", "completeness", "f_score"]
    for measure in names if totals.has_truth else names[:1]:
        plot.plot(values, totals.measure(measure), label=MEASURES[measure].label, marker=".", markersize=4)
    plot.set_ylim(0, 1)
    beside = plot.twinx()
    beside.plot(values, totals.measure("segments"), color="0.6", linestyle="--")
    beside.set_ylabel("segments per frame (dashed)")
    beside.set_ylim(bottom=0)
    _axis(plot, "x", name, result)
    plot.legend(fontsize=8)
    plot.grid(alpha=0.3)


def _map(figure: Any, plot: Any, result: Sweep, names: tuple[str, str], measure: str) -> None:
    x, y = (np.array(result.grid.axes[name]) for name in names)
    height = best_over_the_rest(result, names, measure)
    shades = plot.pcolormesh(x, y, height.T, shading="nearest")
    if len(x) > 1 and len(y) > 1 and np.isfinite(height).all() and np.ptp(height) > 0:
        lines = plot.contour(x, y, height.T, levels=8, colors="white", linewidths=0.7)
        plot.clabel(lines, fontsize=7)
    figure.colorbar(shades, label=f"{MEASURES[measure].label} {MEASURES[measure].unit}".strip())
    for axis, name in zip("xy", names, strict=True):
        _axis(plot, axis, name, result)


def best_over_the_rest(result: Sweep, names: tuple[str, str], measure: str) -> NDArray[np.float64]:
    """(values of the first, values of the second): the measure with the best values of the other thresholds."""
    swept = list(result.grid.axes)
    cube = result.all_files.measure(measure).reshape([len(values) for values in result.grid.axes.values()])
    cube = np.moveaxis(cube, [swept.index(name) for name in names], [0, 1])
    flat = cube.reshape(*cube.shape[:2], -1)
    worst = np.inf if MEASURES[measure].better == "lower" else -np.inf
    flat = np.where(np.isnan(flat), worst, flat)
    best = flat.min(axis=2) if MEASURES[measure].better == "lower" else flat.max(axis=2)
    return np.where(np.isinf(best), np.nan, best)


def _axis(plot: Any, axis: str, name: str, result: Sweep) -> None:
    _, knob = knob_of(name)
    getattr(plot, f"set_{axis}label")(f"{knob.symbol} {f'[{knob.unit}]' if knob.unit else ''}: {knob.label}")
    if knob.log and min(result.grid.axes[name]) > 0:
        getattr(plot, f"set_{axis}scale")("log")


def _title(result: Sweep) -> str:
    names = ", ".join(Path(source.file).name for source in result.sources[:3])
    more = len(result.sources) - 3
    frames = sum(source.frames for source in result.sources)
    return f"{names}{f' and {more} more' if more > 0 else ''}, {frames:,} frames"


def figure_type() -> Any:
    """matplotlib's Figure, or a ValueError that says what to install."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise ValueError(f"a plot needs matplotlib; `{install_command('plot')}` installs it") from None
    return Figure
