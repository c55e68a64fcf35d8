"""The names and measures of a decision in the scene say what was compared."""

from types import SimpleNamespace

from lineseg_app.frame.names import names_of
from scenes import wall_ahead

from lineseg import Params, trace


def test_the_band_has_the_epsilon_that_holds_at_the_tested_point():
    traced = trace(wall_ahead(distance=4.0, half_width=2.5, noise=0.01), Params(epsilon_growth=0.02))
    found = SimpleNamespace(scan=traced.scan, trace=traced)
    compared = [decision for decision in traced if decision.check == "epsilon" and decision.beam >= 0]
    assert len({decision.limit for decision in compared}) > 10
    for decision in compared:
        names, _ = names_of(found, decision)
        assert f"ε = {decision.limit:.3f} m" in [name.text for name in names]
