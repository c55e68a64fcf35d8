import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from lineseg.readers.tables.numbers import all_numbers, leading_numbers

plain = st.builds(lambda value, digits: f"{value:.{digits}f}", st.floats(-1e6, 1e6), st.integers(0, 9))
other = st.floats().map(repr) | st.sampled_from(["nan", "inf", "+5", "-0", ".5", "5.", "1e-3", "123456789012345678"])
words = st.lists(plain | other, max_size=30)


@given(words, st.sampled_from([" ", ", ", ";", "\t", "  "]))
def test_values_are_those_of_float_to_the_last_bit(words, separator):
    values = all_numbers(separator.join(words).encode())
    assert values is not None
    assert values.tobytes() == np.array([float(word) for word in words]).tobytes()


@given(words, st.integers(0, 10))
def test_reading_stops_behind_the_numbers_asked_for(words, count):
    text = " ".join([*words, "pippo"]).encode()
    values, end = leading_numbers(text, count)
    assert len(values) == min(count, len(words))
    assert text[end:].split() == [*(word.encode() for word in words[count:]), b"pippo"]


def test_a_line_with_a_word_has_no_numbers():
    assert all_numbers(b"1.0 2.0 x") is None
    assert all_numbers(b"1.0 0.6.1") is None
