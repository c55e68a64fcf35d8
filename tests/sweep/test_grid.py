"""Which settings a sweep tries, and which it refuses."""

import pytest

from lineseg import Params
from lineseg.sweep import Grid, axis_values, slider_values


def test_values_are_spread_as_the_slider_is():
    assert axis_values("0.01:0.04:3", "epsilon") == (0.01, 0.02, 0.04)
    assert axis_values("0:1:3", "min_length") == (0.0, 0.5, 1.0)
    assert axis_values("3:6:20", "seed_points") == (3, 4, 5, 6)
    assert axis_values("0.02,0.05", "epsilon") == (0.02, 0.05)
    assert axis_values("0.02", "epsilon") == (0.02,)
    assert slider_values("epsilon", 5)[0] == 0.005


def test_the_last_axis_changes_fastest():
    grid = Grid(Params(min_points=8), {"epsilon": (0.02, 0.03), "delta": (0.1, 0.2)})
    assert [(p.epsilon, p.delta, p.min_points) for p in grid] == [
        (0.02, 0.1, 8), (0.02, 0.2, 8), (0.03, 0.1, 8), (0.03, 0.2, 8)
    ]  # fmt: skip
    assert list(Grid(Params(), {})) == [Params()]


@pytest.mark.parametrize("text", ["0.01:0.1", "0.01:0.1:1", "a:b:3", "", "0.01:inf:4", "nan:1:3", "0.01:0.1:2.5"])
def test_an_invalid_sweep_is_refused_with_an_example(text):
    with pytest.raises(ValueError, match=r"--epsilon is .*FROM:TO:COUNT, such as 0.005:0.5:20"):
        axis_values(text, "epsilon")


def test_a_value_that_no_threshold_may_have_is_refused_before_the_work():
    with pytest.raises(ValueError, match="epsilon is 0; a distance of 0 would refuse"):
        Grid(Params(), {"epsilon": axis_values("0:0.1:3", "epsilon")})
    with pytest.raises(ValueError, match="there is no threshold 'beauty'; choose from epsilon"):
        axis_values("1:2:3", "beauty")


def test_a_sweep_larger_than_memory_says_how_large_it_is():
    values = axis_values("0.01:0.1:2000", "epsilon")
    with pytest.raises(ValueError, match=r"2000 × 2000 = 4,000,000 settings exceeds the 2,000,000"):
        Grid(Params(), {"epsilon": values, "delta": values})
    with pytest.raises(ValueError, match=r"100,000,000,000 settings exceeds"):
        axis_values("0.01:0.1:100000000000", "epsilon")
