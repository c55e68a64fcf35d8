"""Stamps of a counter of 32 bits that begins again at 0."""

from pathlib import Path

import numpy as np
import pytest

from lineseg import open_recording

WRAPPING = (np.arange(8) * 100 + 2**32 - 350) % 2**32


@pytest.mark.parametrize("unit", [1.0, 1e-3, 1e-6])
def test_the_advice_about_stamps_that_wrap_counts_on_from_there(tmp_path: Path, unit: float):
    file = tmp_path / "a.npz"
    np.savez(file, ranges=np.full((8, 3), 2.0), angle_min=0.0, angle_increment=0.1, stamps=unit * WRAPPING)
    (notice,) = (each for each in open_recording(file).account.notices if each.kind == "stamps")
    mended = open_recording(file, **notice.change)
    assert np.diff(mended.stamps) == pytest.approx(np.full(7, 100 * unit), abs=1e-5)
    assert mended.account.believable


def test_a_leading_column_that_wraps_is_still_one_of_stamps(tmp_path: Path):
    file = tmp_path / "a.csv"
    room = ",".join(f"{3 + 0.001 * beam:.3f}" for beam in range(181))
    file.write_text("".join(f"{stamp},{room}\n" for stamp in WRAPPING.tolist()))
    recording = open_recording(file)
    assert np.diff(recording.stamps).tolist() == pytest.approx([0.1] * 7)
    assert recording.beams == (181, 181)
