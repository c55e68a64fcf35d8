"""How the kernels are compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import njit, types
from numba.extending import intrinsic

from .kept import KeptKernel

# A kernel works on memory that its caller gives it: it allocates nothing, so it counts no references, which in loops as
# short as these would cost more than the arithmetic. It needs no interpreter lock and divides as numpy does. Products
# and sums are rounded one by one: a trace then decides as the extraction does, to the last bit. Were fastmath not
# forbidden, a kernel would take it from the first that calls it.
_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "_nrt": False, "fastmath": False}
# Only what Python calls is kept on disk: the rest is compiled into it.
_INNER: dict[str, Any] = {**_OPTIONS, "no_cfunc_wrapper": True}


def entry_kernel(function: Callable) -> Any:
    """Compile a function of arrays and numbers that Python calls."""
    return keep(njit(**_OPTIONS)(function))


def keep(compiled: Any) -> Any:
    """Keep what numba compiles of a function that Python calls for the next program."""
    if hasattr(compiled, "_cache"):  # with NUMBA_DISABLE_JIT it is the function itself
        compiled._cache = KeptKernel(compiled)
    return compiled


def kernel(function: Callable) -> Any:
    """Compile a function that other kernels call."""
    return njit(**_INNER)(function)


def summing_kernel(function: Callable) -> Any:
    """The same, but sums may be taken in any order, several numbers at a time.

    Not all of fastmath: it would allow the compiler to assume that NaN and infinity never occur.
    """
    options: dict[str, Any] = {**_INNER, "fastmath": {"contract", "reassoc"}}
    return njit(**options)(function)


def inlined_kernel(function: Callable) -> Any:
    """The same, put into its callers: a call hands over some fifty numbers, which takes longer than a refused point."""
    return njit(**_INNER, inline="always")(function)


def _fma(typing_context: Any, a: Any, b: Any, c: Any) -> Any:
    def instruction(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.fma(*arguments)

    return types.float64(types.float64, types.float64, types.float64), instruction


# fma(a, b, c) is a·b + c, rounded once: one instruction instead of two, where that counts.
fma: Any = intrinsic(_fma)
