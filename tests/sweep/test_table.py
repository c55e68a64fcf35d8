"""Reading the table of a sweep, and refusing other files."""

import io
from pathlib import Path

import numpy as np
import pytest

from lineseg import Params, open_recording
from lineseg.readers import save_npz
from lineseg.sweep import MEASURES, Grid, Sweep, pool, sweep
from lineseg.sweep.table import read_table, rows_of, write_table

SAMPLES = Path(__file__).parents[2] / "sample_scans"
GRID = Grid(Params(), {"epsilon": (0.02, 0.04), "min_points": (8, 12, 20)})


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Sweep:
    folder = tmp_path_factory.mktemp("files")
    files = [folder / f"{name}.npz" for name in ("with, truth", "=without")]
    hallway = open_recording(SAMPLES / "hallway.npz").only(np.arange(5))
    save_npz(hallway, files[0])
    save_npz(open_recording(SAMPLES / "hallway.log").only(np.arange(5)), files[1])
    with pool() as workers:
        return sweep(files, GRID, workers)


@pytest.mark.parametrize("name", ["sweep.csv", "sweep.parquet"])
def test_a_written_table_is_read_again(swept: Sweep, name: str, tmp_path: Path):
    write_table(swept, tmp_path / name)
    table = read_table((tmp_path / name).read_bytes(), name)
    rows = list(rows_of(swept))
    assert table.files.tolist() == [row["file"] for row in rows]
    for column, numbers in table.numbers.items():
        np.testing.assert_array_equal(numbers, [np.nan if row[column] is None else row[column] for row in rows])
    assert {axis: values.tolist() for axis, values in table.axes.items()} == {
        "epsilon": [0.02, 0.04],
        "min_points": [8, 12, 20],
    }
    assert "\n=" not in (tmp_path / name).read_text(errors="replace"), (
        "a spreadsheet computes what begins like a formula"
    )
    assert np.isnan(table.numbers["true_rate"][6:]).all() and np.isfinite(table.numbers["true_rate"][:6]).all()


HEAD = ",".join(["file", *(name for name, _, _ in Params.knobs()), "frames", *MEASURES])
ROW = ",".join(["a.npz", *(str(value) for value in Params().numbers().values()), "5", *["0.5"] * len(MEASURES)])


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("a.xlsx", b"", "ends in .csv or .parquet"),
        ("a.csv", b"", "it has no column 'file'"),
        ("a.csv", b"file,epsilon\nx,0.1\n", "it has no column 'delta'"),
        ("a.csv", f"{HEAD}\n".encode(), "it has 0 rows"),
        ("a.csv", f"{HEAD}\n{ROW}\na.npz,0.03\n".encode(), "row 2 has 2 cells"),
        ("a.csv", f"{HEAD}\n{ROW.replace('0.03', 'wide')}\n".encode(), "epsilon of row 1 is 'wide'"),
        ("a.csv", f"{HEAD}\n{ROW.replace('0.03', '')}\n".encode(), "epsilon of row 1 is missing"),
        ("a.csv", f"{HEAD}\n{ROW.replace('a.npz', 1001 * 'a')}\n".encode(), "column 'file' has 1,001 characters"),
        ("a.csv", b"\xff\xfe\x00", "it is not CSV"),
        ("a.csv", f"{HEAD}\n".encode() + f"{ROW}\n".encode() * 100_001, "the page shows 1 to 100,000"),
        ("a.parquet", b"PAR1 and no more", "it is not Parquet"),
    ],
)
def test_a_file_that_is_not_a_sweep_table_is_refused_in_one_sentence(name: str, content: bytes, sentence: str):
    with pytest.raises(ValueError, match=name) as refused:
        read_table(content, name)
    assert sentence in str(refused.value)


def test_a_parquet_file_that_grows_when_it_is_unpacked_is_refused(monkeypatch: pytest.MonkeyPatch):
    arrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")

    def packed(**columns: object) -> bytes:
        out = io.BytesIO()
        parquet.write_table(arrow.table(columns), out, compression="zstd")
        return out.getvalue()

    monkeypatch.setattr("lineseg.sweep.table.LARGEST_UNPACKED", 1 << 20)
    content = packed(file=[f"{number}{100_000 * 'x'}" for number in range(20)])
    assert len(content) < 20_000
    with pytest.raises(ValueError, match="more than 1 MB unpacked"):
        read_table(content, "sweep.parquet")
