"""How readers put scans together."""

import numpy as np
import pytest

from lineseg.readers.source import Joined


@pytest.mark.parametrize(
    "types", [["<f4"] * 3, [">f4"] * 3, ["f4", "f8", "f4"], ["f8", "f4", "i4"], ["i2", "f4", "i2"]]
)
def test_arrays_are_joined_as_numpy_joins_them(types):
    arrays = [np.arange(length).astype(type) for length, type in zip((3, 0, 40), types, strict=True)]
    joined = Joined()
    for array in arrays:
        joined.append(array)
    expected = np.concatenate(arrays)
    assert joined.lengths.tolist() == [3, 0, 40]
    assert joined.all().tolist() == expected.tolist()
    assert joined.all().dtype == expected.dtype


def test_nothing_joined_is_an_empty_array():
    assert len(Joined().all()) == 0
