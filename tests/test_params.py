import math
from dataclasses import replace

import pytest

from lineseg import Params


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("seed_points", 2, ["seed_points is 2", "any 2 points fit a line exactly", "3 to 1000"]),
        ("seed_points", 6.5, ["not a whole number"]),
        ("epsilon", 0, ["epsilon is 0", "refuse every measured point"]),
        ("epsilon", math.nan, ["epsilon is nan", "not a number"]),
        ("delta", "wide", ["delta is 'wide'", "not a number"]),
        ("min_length", -1, ["min_length is -1", "never negative"]),
        ("max_gap", math.inf, ["max_gap is inf"]),
        ("min_points", True, ["min_points is True", "not a number"]),
        ("merge_angle", 2, ["right angle"]),
    ],
)
def test_a_wrong_value_is_refused_with_field_value_range_and_reason(name, value, words):
    with pytest.raises(ValueError) as error:
        Params(**{name: value})
    for word in [*words, "allowed: "]:
        assert word in str(error.value)


def test_an_unknown_threshold_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match="no threshold 'espilon'; choose from epsilon, delta"):
        Params().but(espilon=0.1)


def test_equal_parameters_are_one_cache_key():
    assert {Params(): 1}[Params(epsilon=0.03, seed_points=6.0)] == 1


def test_defaults_equal_the_paper():
    p = Params()
    assert (p.epsilon, p.delta, p.seed_points, p.min_points, p.min_length) == (0.03, 0.10, 6, 10, 0.6)


def test_a_slider_reaches_the_value_that_is_set_and_ends_at_a_round_number():
    knobs = {name: knob for name, _, knob in Params.knobs()}
    epsilon = knobs["epsilon"]
    assert (epsilon.high, knobs["max_dropout"].high) == (0.5, 40)
    assert epsilon.reaching(0.005, 0.5) == epsilon
    assert epsilon.reaching(0.6) == replace(epsilon, high=1.0)
    assert epsilon.reaching(0.0031, 1.0) == replace(epsilon, low=0.002, high=1.0)
    assert epsilon.reaching(1e-6, 100.0) == replace(epsilon, low=1e-6, high=100.0)
    assert knobs["min_points"].reaching(2, 101) == replace(knobs["min_points"], low=2, high=200)


def test_every_default_lies_on_its_slider_and_every_slider_within_what_is_allowed():
    for name, kind, knob in Params.knobs():
        assert knob.least <= knob.low <= getattr(Params(), name) <= knob.high <= knob.most
        assert kind in (int, float)
        assert knob.help.endswith(".")
