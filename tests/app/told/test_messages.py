"""Messages that are sent many times a second."""

import json

import numpy as np
import pytest
from lineseg_app.told.messages import Quick


class Told(Quick):
    found: dict[str, object]


def test_numbers_that_a_reader_found_are_sent_whatever_their_type():
    found = {"angle_min": np.float64(-1.57), "beams": np.int32(181), "no": np.float32("nan"), "so": np.bool_(True)}
    sent = json.loads(Told(found=found).as_json())["found"]
    assert sent == {"angle_min": -1.57, "beams": 181, "no": None, "so": True}


def test_what_has_no_json_is_named():
    with pytest.raises(TypeError, match="object has no JSON"):
        Told(found={"what": object()}).as_json()
