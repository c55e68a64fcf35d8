"""A fingerprint of what a kernel is compiled from: its own code and everything that it uses."""

from __future__ import annotations

import hashlib
from enum import Enum
from functools import cache
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np
from numba.core.dispatcher import Dispatcher
from numba.core.extending import _Intrinsic

_PLAIN = (bool, int, float, complex, str, bytes, type(None), np.generic, np.dtype)


def fingerprint(kernel: Any) -> str:
    """A number that changes when the machine code may change, but not when a file is touched, moved or commented.

    It covers the bytecode and constants of the kernel and of those that it calls, their compiler options, and the
    values of the globals that they use. Raises TypeError if a kernel uses something that has no value to compare.
    """
    digest = hashlib.sha256()
    reached = [kernel]
    for each in reached:  # the list grows during the loop
        text, used = _told(each)
        digest.update(text.encode())
        reached += [other for other in used if other not in reached]
    return digest.hexdigest()


@cache
def _told(function: Any) -> tuple[str, list[Any]]:
    """The function's own content, and the functions that it uses."""
    if isinstance(function, Dispatcher):
        options, function = function.targetoptions, function.py_func
    elif isinstance(function, _Intrinsic):
        options, function = {}, function._defn
    else:
        options = {}
    used: list[Any] = []
    cells = [cell.cell_contents for cell in function.__closure__ or ()]
    told = [
        f"{function.__module__}.{function.__qualname__}",
        _value(options, used),
        _value(function.__defaults__, used),
        _value(cells, used),
        _code(function.__code__, function.__doc__),
    ]
    # Attribute names are included too: this covers more than needed, never less.
    told += [
        _value(function.__globals__[name], used) for name in _names(function.__code__) if name in function.__globals__
    ]
    return "\n".join(told), used


def _code(code: CodeType, doc: str | None = None) -> str:
    constants = [
        _code(each) if isinstance(each, CodeType) else _value(each, []) for each in code.co_consts if each != doc
    ]
    return repr((code.co_code, code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars, constants))


def _names(code: CodeType) -> list[str]:
    inner = [name for each in code.co_consts if isinstance(each, CodeType) for name in _names(each)]
    return [*code.co_names, *inner]


def _value(value: Any, used: list[Any]) -> str:
    """A text that is unique to this value. Functions are only named, and added to `used`."""
    if isinstance(value, _PLAIN):
        return repr(value)
    if isinstance(value, tuple | list):
        fields = getattr(value, "_fields", "")
        return f"{type(value).__name__}{fields}[{', '.join(_value(each, used) for each in value)}]"
    if isinstance(value, dict):
        return _value(sorted(value.items(), key=repr), used)
    if isinstance(value, set | frozenset):
        return _value(sorted(value, key=repr), used)
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"
    if isinstance(value, ModuleType | BuiltinFunctionType | np.ufunc):
        return value.__name__
    if isinstance(value, type) and (value.__module__ in ("builtins", "numpy") or issubclass(value, tuple | Enum)):
        inside = list(value) if issubclass(value, Enum) else getattr(value, "_fields", ())
        return f"{value.__module__}.{value.__qualname__} {inside}"
    if isinstance(value, FunctionType | Dispatcher | _Intrinsic):
        used.append(value)
        return f"{value.__module__}.{value.__qualname__}"
    raise TypeError(f"a kernel uses {value!r}; lineseg cannot tell whether that has changed since it was compiled")
