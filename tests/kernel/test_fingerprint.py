"""The fingerprint of a kernel changes only if its machine code may change."""

import importlib
import pkgutil
import sys

import pytest
from numba.core.dispatcher import Dispatcher

import lineseg
from lineseg.kernel.fingerprint import fingerprint
from lineseg.kernel.kept import KeptKernel

SOURCE = '''
from collections import namedtuple
from typing import NamedTuple
import numpy as np
from lineseg.kernel import entry_kernel, kernel, summing_kernel, intrinsic, types

class Pair(NamedTuple):
    left: float
    right: float

FACTOR = 2.0
TABLE = np.arange(3.0)
COLUMN = namedtuple("Columns", ["near", "far"])(0, 1)

@entry_kernel
def entry(x):
    """Twice."""
    pair = Pair(inner(x, 1), one())
    return FACTOR * pair.left * pair.right + TABLE[COLUMN.far]

@kernel
def inner(x, power=3):
    return x ** power + offset(x)

@summing_kernel
def offset(x):
    return x + 5

@intrinsic
def one(context):
    def write(context, builder, signature, arguments):
        return context.get_constant(types.float64, 1.0)
    return types.float64(), write

def not_a_kernel():
    return 7
'''


def of(source: str) -> str:
    module = {"__name__": "made"}
    exec(source, module)
    return fingerprint(module["entry"])


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("FACTOR = 2.0", "# Further down.\n\n\nFACTOR = 2.0"),
        ("Twice.", "Two times."),
        ("return 7", "return 8"),
        ("return x + 5", "return x + 5  # five"),
    ],
)
def test_the_fingerprint_stays_if_the_compiled_code_stays(before, after):
    assert before in SOURCE
    assert of(SOURCE.replace(before, after)) == of(SOURCE)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("FACTOR * pair.left", "FACTOR + pair.left"),
        ("return x + 5", "return x + 6"),
        ("FACTOR = 2.0", "FACTOR = 2"),
        ("np.arange(3.0)", "np.arange(1.0, 4.0)"),
        ("@summing_kernel", "@kernel"),
        ("power=3", "power=4"),
        ("left: float\n    right: float", "right: float\n    left: float"),
        ("types.float64, 1.0", "types.float64, 1.5"),
        ('"near", "far"', '"far", "near"'),
    ],
)
def test_the_fingerprint_changes_with_any_compiled_code(before, after):
    assert before in SOURCE
    assert of(SOURCE.replace(before, after)) != of(SOURCE)


def test_variables_around_the_declaration_of_a_kernel_count():
    source = (
        "from lineseg.kernel import entry_kernel\ndef made(k):\n  return entry_kernel(lambda x: k * x)\nentry = made(1)"
    )
    assert of(source) != of(source.replace("made(1)", "made(2)"))


def test_a_global_without_a_comparable_value_is_refused():
    with pytest.raises(TypeError, match="a kernel uses <object object at"):
        of(SOURCE.replace("TABLE = np.arange(3.0)", "TABLE = object()"))


def test_each_kernel_of_the_library_has_its_own_fingerprint():
    for module in pkgutil.walk_packages(lineseg.__path__, "lineseg."):
        if not module.name.startswith("lineseg.examples."):  # programs, which run when they are imported
            importlib.import_module(module.name)
    kept = {
        value
        for name, module in list(sys.modules.items())
        if name.partition(".")[0] == "lineseg"
        for value in vars(module).values()
        if isinstance(value, Dispatcher) and isinstance(value._cache, KeptKernel)
    }
    assert len(kept) > 20
    assert len({fingerprint(kernel) for kernel in kept}) == len(kept)
