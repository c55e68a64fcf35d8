"""Sweeps over whole files: the sums are the same if interrupted, continued or run on other machines."""

import csv
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.__main__ import main
from waiting import SECONDS, eventually

from lineseg import Params, Recording, open_recording
from lineseg.readers import save_npz
from lineseg.sweep import MEASURES, Batch, Grid, Journal, axis_values, chunks, pool, sweep
from lineseg.sweep.plot import best_over_the_rest
from lineseg.sweep.table import rows_of

SAMPLES = Path(__file__).parents[2] / "sample_scans"
GRID = Grid(Params(), {"epsilon": axis_values("0.015:0.08:10", "epsilon"), "delta": axis_values("0.05:0.3:8", "delta")})


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("files")
    for name in ("hallway", "laboratory"):
        save_npz(open_recording(SAMPLES / f"{name}.npz").only(np.arange(60)), folder / f"{name}.npz")
    return [folder / "hallway.npz", folder / "laboratory.npz"]


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Several a file."""
    monkeypatch.setattr(chunks, "CHUNK_BEAMS", 22_000)


class StoppedError(Exception):
    pass


def test_a_sweep_in_chunks_is_the_sweep_of_the_whole(files: list[Path]):
    with pool() as workers:
        found = sweep(files, GRID, workers)
    assert [len(source.chunks()) for source in found.sources] == [3, 3]
    for file, sums in zip(files, found.totals.sums, strict=True):
        whole = Batch(open_recording(file), scored=True).measure(list(GRID))
        np.testing.assert_allclose(sums, whole.sums, rtol=1e-12)


def test_an_interrupted_sweep_goes_on_and_computes_nothing_twice(files: list[Path], tmp_path: Path, monkeypatch):
    measured = []
    work = Batch.measure

    def counting(batch, settings, cancelled=None):
        measured.extend((id(batch), params) for params in settings)
        return work(batch, settings, cancelled)

    monkeypatch.setattr(Batch, "measure", counting)
    chunks._batch.cache_clear()
    with pool() as workers:
        undisturbed = sweep(files, GRID, workers)
    total = len(measured)
    assert total == 6 * len(GRID)

    measured.clear()

    def stop(done: int, _: int) -> None:
        if done > 2000:
            raise StoppedError

    def attempt(progress=lambda done, total: None):
        journal = Journal(tmp_path / "sweep.partial")
        try:
            with pool() as workers:
                return sweep(files, GRID, workers, journal=journal, progress=progress)
        finally:
            journal.close()

    with pytest.raises(StoppedError):
        attempt(stop)
    in_journal = Journal(tmp_path / "sweep.partial")
    (kept,) = in_journal._rows.execute("SELECT COUNT(*) FROM done").fetchone()
    in_journal.close()
    assert 0 < kept < total
    measured.clear()
    resumed = attempt()
    assert len(measured) == total - kept
    np.testing.assert_array_equal(resumed.totals.sums, undisturbed.totals.sums)
    measured.clear()
    attempt()
    assert not measured


def test_a_file_that_changed_is_measured_anew(files: list[Path], tmp_path: Path):
    file = tmp_path / "mine.npz"
    grid = Grid(Params(), {})
    journal = Journal(tmp_path / "sweep.partial")
    with pool() as workers:
        file.write_bytes(files[0].read_bytes())
        before = sweep([file], grid, workers, journal=journal)
        file.write_bytes(files[1].read_bytes())
        os.utime(file, ns=(1, 1))
        after = sweep([file], grid, workers, journal=journal)
        other = sweep([files[1]], grid, workers)
    journal.close(remove=True)
    assert not (tmp_path / "sweep.partial").exists()
    np.testing.assert_array_equal(after.totals.sums, other.totals.sums)
    assert (before.totals.sums != after.totals.sums).any()


def test_a_file_that_is_not_a_journal_is_left_alone(tmp_path: Path):
    (tmp_path / "sweep.partial").write_text("my notes, which are long enough to be no empty database" * 20)
    with pytest.raises(ValueError, match="this is not the journal of a sweep"):
        Journal(tmp_path / "sweep.partial")
    assert (tmp_path / "sweep.partial").read_text().startswith("my notes")


def test_the_table_and_the_plots_are_written_and_read_back(files: list[Path], tmp_path: Path, capsys):
    import pyarrow.parquet

    sizes = ["--epsilon", "0.02:0.05:3", "--delta", "0.05,0.1", "--min-points", "8:12:3"]
    for out, plot in [("sweep.csv", "map.svg"), ("sweep.parquet", "map.png")]:
        outputs = ["-o", str(tmp_path / out), "--plot", str(tmp_path / plot)]
        assert main(["sweep", *map(str, files), *sizes, *outputs]) == 0
        assert "best F × completeness" in capsys.readouterr().out
    assert b"<svg" in (tmp_path / "map.svg").read_bytes()
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    with (tmp_path / "sweep.csv").open() as file:
        rows = list(csv.DictReader(file))
    table = pyarrow.parquet.read_table(tmp_path / "sweep.parquet").to_pylist()
    assert len(rows) == len(table) == 2 * 3 * 2 * 3
    for row, other in zip(rows, table, strict=True):
        assert row["file"] == other["file"]
        for name in MEASURES:
            assert float(row[name]) == pytest.approx(other[name]), name
    assert sorted(each.name for each in tmp_path.iterdir()) == ["map.png", "map.svg", "sweep.csv", "sweep.parquet"]


def test_a_map_of_two_thresholds_takes_the_best_of_the_others(files: list[Path]):
    axes = {"epsilon": (0.02, 0.03), "min_points": (8, 10, 14), "delta": (0.05, 0.1)}
    with pool() as workers:
        found = sweep(files, Grid(Params(), axes), workers)
    scores = found.all_files.measure("f_score").reshape(2, 3, 2)
    np.testing.assert_array_equal(best_over_the_rest(found, ("delta", "epsilon"), "f_score"), scores.max(axis=1).T)
    worst = found.all_files.measure("false_rate").reshape(2, 3, 2)
    np.testing.assert_array_equal(best_over_the_rest(found, ("epsilon", "delta"), "false_rate"), worst.min(axis=1))


def test_without_truth_the_table_leaves_the_rates_empty(tmp_path: Path, files: list[Path]):
    from dataclasses import replace

    blind: Recording = replace(open_recording(files[0]), wall=None, track=None)
    save_npz(blind, tmp_path / "blind.npz")
    with pool() as workers:
        (row,) = rows_of(sweep([tmp_path / "blind.npz"], Grid(Params(), {}), workers))
    assert row["true_rate"] is row["f_score"] is None
    assert row["coverage"] > 0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--epsilon", "0.01:0.1"], "--epsilon is '0.01:0.1'; give FROM:TO:COUNT"),
        (["--measure", "beauty"], "there is no measure 'beauty'; choose from coverage"),
        (["-o", "sweep.xlsx"], "sweep.xlsx: use a name that ends in .csv or .parquet"),
        (["-o", "nowhere/sweep.csv"], "the folder nowhere does not exist"),
        (["--plot", "sweep.gif"], "sweep.gif: use a name that ends in .png or .svg"),
        (["--scheduler", "tcp://127.0.0.1:1"], "tcp://127.0.0.1:1: no Dask scheduler answers there"),
    ],
)
def test_an_impossible_sweep_is_refused_before_the_work(files, tmp_path, capsys, monkeypatch, arguments, said):
    monkeypatch.setattr("lineseg.sweep.workers.CONNECT_SECONDS", 1)
    monkeypatch.chdir(tmp_path)
    out = [] if "-o" in arguments else ["-o", "sweep.csv"]
    assert main(["sweep", str(files[0]), *arguments, *out]) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, list[subprocess.Popen]]]:
    """The address of a Dask scheduler on the loopback, and its two workers, each a process; a test kills the first."""
    pytest.importorskip("distributed")
    folder = tmp_path_factory.mktemp("cluster")
    where = folder / "scheduler.json"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": folder}
    dask = [sys.executable, "-m", "dask"]
    local = ["--scheduler-file", str(where), "--no-dashboard"]
    scheduler = subprocess.Popen([*dask, "scheduler", "--host", "127.0.0.1", "--port", "0", *local], **quiet)
    worker = [*dask, "worker", *local, "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny"]
    workers = [subprocess.Popen([*worker, "--name", str(k)], **quiet) for k in range(2)]
    try:
        with pytest.MonkeyPatch.context() as patient:
            patient.setattr("lineseg.sweep.workers.CONNECT_SECONDS", SECONDS)
            yield _address_in(where, workers=2), workers
    finally:
        for process in [*workers, scheduler]:
            process.send_signal(signal.SIGKILL)
            process.wait()


def _address_in(where: Path, workers: int) -> str:
    """The scheduler's address, once its workers are there."""
    import json

    from distributed import Client

    eventually(lambda: where.exists() and where.read_text().endswith("}"), "the scheduler to start")
    address = json.loads(where.read_text())["address"]
    with Client(address, timeout=SECONDS, set_as_default=False) as client:
        client.wait_for_workers(workers, timeout=SECONDS)
    return address


def test_a_killed_worker_costs_only_its_chunk(files: list[Path], cluster):
    address, (victim, survivor) = cluster
    with pool() as threads:
        undisturbed = sweep(files, GRID, threads)
    seen: list[int] = []

    def kill_at_once(done: int, total: int) -> None:
        seen.append(done)
        if len(seen) == 1:
            assert done < total
            victim.kill()

    with pool(address) as workers:
        found = sweep(files, GRID, workers, progress=kill_at_once)
    np.testing.assert_array_equal(found.totals.sums, undisturbed.totals.sums)
    assert victim.wait() == -signal.SIGKILL
    assert survivor.poll() is None
    # Six chunks in two blocks of settings: each was handed over once.
    assert len(seen) == 12


def test_an_error_of_a_worker_is_reported(tmp_path: Path, cluster, capsys):
    address, _ = cluster
    arguments = [str(tmp_path / "gone.npz"), "-o", str(tmp_path / "out.csv"), "--scheduler", address]
    assert main(["sweep", *arguments]) == 2
    assert "gone.npz" in capsys.readouterr().err


def test_a_full_disk_is_not_taken_for_a_foreign_journal(tmp_path):
    journal = Journal(tmp_path / "sweep.partial")
    (pages,) = journal._rows.execute("PRAGMA page_count").fetchone()
    journal._rows.execute(f"PRAGMA max_page_count = {pages}")
    with pytest.raises(OSError, match=r"sweep\.partial: .* disk is full.* What it holds is kept"):
        for _ in range(100):
            journal._write("INSERT INTO meaning VALUES (?)", [(str(np.random.default_rng().bytes(4000)),)])
    journal.close()
    with pytest.raises(OSError, match="cannot be written: unable to open"):
        Journal(tmp_path / "nowhere" / "sweep.partial")


def test_a_damaged_journal_is_told_as_such_and_left_alone(files: list[Path], tmp_path: Path, capsys):
    path = tmp_path / "out.csv.partial"
    Journal(path)._write("INSERT INTO done VALUES (?, ?, ?)", [(str(k), "", bytes(3000)) for k in range(20)])
    content = bytearray(path.read_bytes())
    for page in range(4096, len(content), 4096):
        content[page : page + 9] = b"\xff" * 9
    path.write_bytes(content)
    arguments = ["sweep", str(files[0]), "--epsilon", "0.02,0.04", "-o", str(tmp_path / "out.csv")]
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert f"{path}: this is not the journal of a sweep (" in error
    assert "mistake" not in error
    assert path.read_bytes() == bytes(content)
