"""The kernels get every threshold that Params declares, with its name and value."""

from lineseg import Params
from lineseg.region_growing.limits import Limits, limits_of, loosened, unpacked

PARAMS = Params(epsilon=0.07, seed_points=8, max_dropout=3, merge_angle=0.2)


def test_each_threshold_arrives_in_the_kernels():
    limits = unpacked(limits_of(PARAMS))
    assert limits._asdict() == {name: getattr(PARAMS, name) for name in Params.names()}
    assert [type(value) for value in limits] == [kind for _, kind, _ in Params.knobs()]


def test_looser_limits_differ_in_epsilon_its_growth_and_delta_alone():
    limits = Limits(*(getattr(PARAMS, name) for name in Params.names()))
    twice = {name: 2.0 * getattr(limits, name) for name in ("epsilon", "epsilon_growth", "delta")}
    assert loosened(limits, 2.0) == limits._replace(**twice)
