"""What a kernel computes does not depend on which one was compiled before it."""

import subprocess
import sys

from waiting import SECONDS

PROGRAM = """
import numpy as np
from lineseg.total_least_squares import distance, squares_of
x, y = np.random.default_rng(1).normal(size=(2, 1000))
{}
print([squares_of(x, y, k, k + 40, (0.6, 0.8, -0.1)) for k in range(900)])
"""


def said_by(before: str) -> str:
    command = [sys.executable, "-c", PROGRAM.format(before)]
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=SECONDS).stdout


def test_squares_are_summed_to_the_same_bits_whatever_was_compiled_before():
    assert said_by("") == said_by("distance(0.0, 0.0, 3.0, 4.0)")
