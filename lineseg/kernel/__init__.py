"""How the kernels are compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import njit, types
from numba.extending import intrinsic

from .kept import KeptKernel

# A kernel works on memory from its caller and allocates nothing. So it counts no references, which in such short loops
# would cost more than the arithmetic. It releases the interpreter lock and divides as numpy does. Every product and sum
# is rounded by itself, so that a trace decides exactly as the extraction does. fastmath must be turned off explicitly:
# otherwise a kernel takes it over from its first caller.
_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "_nrt": False, "fastmath": False}
# Only kernels that Python calls are kept on disk; the others are compiled into them.
_INNER: dict[str, Any] = {**_OPTIONS, "no_cfunc_wrapper": True}


def entry_kernel(function: Callable) -> Any:
    """Compile a function of arrays and numbers that Python calls."""
    return keep(njit(**_OPTIONS)(function))


def keep(compiled: Any) -> Any:
    """Keep the machine code of a function that Python calls, for the next program."""
    if hasattr(compiled, "_cache"):  # with NUMBA_DISABLE_JIT this is the plain function
        compiled._cache = KeptKernel(compiled)
    return compiled


def kernel(function: Callable) -> Any:
    """Compile a function that other kernels call."""
    return njit(**_INNER)(function)


def summing_kernel(function: Callable) -> Any:
    """The same, but sums may be taken in any order, several numbers at a time.

    This is not all of fastmath, which would let the compiler assume that NaN and infinity never occur.
    """
    options: dict[str, Any] = {**_INNER, "fastmath": {"contract", "reassoc"}}
    return njit(**options)(function)


def inlined_kernel(function: Callable) -> Any:
    """The same, inlined into its callers: passing about fifty numbers takes longer than refusing a point."""
    return njit(**_INNER, inline="always")(function)


def _fma(typing_context: Any, a: Any, b: Any, c: Any) -> Any:
    def instruction(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.fma(*arguments)

    return types.float64(types.float64, types.float64, types.float64), instruction


# fma(a, b, c) is a·b + c, rounded once: one instruction instead of two, where that counts.
fma: Any = intrinsic(_fma)
