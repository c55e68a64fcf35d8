"""Reads the table of a sweep for the map on the page."""

from __future__ import annotations

import numpy as np
from fastapi import FastAPI, Request
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg.sweep import MEASURES
from lineseg.sweep.table import Table, read_table
from lineseg.writers.finite import finite_or_none

from ..told.answers import SweepTable
from .body import body_of

LARGEST = 64 * 1024 * 1024


def add_sweep_table(app: FastAPI) -> None:
    """The route /api/sweep-table, which converts a file to the data of the map; nothing is stored."""

    @app.post("/api/sweep-table")
    async def sweep_table(request: Request, name: str = "sweep.csv") -> SweepTable:
        content = await body_of(request, LARGEST, "the table of a sweep has")
        try:
            return columns_of(await run_in_threadpool(read_table, content, name[:120]))
        except ValueError as error:
            raise HTTPException(400, str(error)) from None


def columns_of(table: Table) -> SweepTable:
    """axes: the values of each swept threshold; file: index into `files` of each row; columns: of each row."""
    files, file = np.unique(table.files, return_inverse=True)
    known = [name for name in MEASURES if np.isfinite(table.numbers[name]).any()]
    axes = table.axes
    if len(axes) < 2:
        swept = ", ".join(axes) or "none"
        raise ValueError(f"a map needs two swept thresholds; this table has {swept}")
    return {
        "files": files.tolist(),
        "axes": {name: values.tolist() for name, values in axes.items()},
        "measures": known,
        "file": file.tolist(),
        "columns": {
            name: [finite_or_none(value) for value in table.numbers[name].tolist()]
            for name in (*axes, "frames", *known)
        },
    }
