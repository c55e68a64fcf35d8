"""Selects the command and reports its errors. Only this and `commands/` print."""

from __future__ import annotations

import contextlib
import inspect
import io
import logging
import os
import re
import shutil
import sys
import textwrap
from collections.abc import Callable, Iterator

import tyro
from tyro.conf import DisallowNone, FlagCreatePairsOff

from lineseg import __version__
from lineseg.failing import mistake

from .commands import COMMANDS, command

log = logging.getLogger(__name__)
REFUSED = 2


def run(arguments: list[str]) -> int:
    """Run the command line and return the exit code. `lineseg FILE` means `lineseg view FILE`."""
    if not arguments or arguments[0] not in (*COMMANDS, "-h", "--help", "--version"):
        arguments.insert(0, "view")
    if arguments == ["--version"]:
        print(f"lineseg {__version__}")
        return 0
    try:
        _call(arguments)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader of a pipe, such as `head`, has closed it; Python would report the error again on exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, OSError, MemoryError, ModuleNotFoundError) as error:
        print(f"lineseg: {_sentence(error)}", file=sys.stderr)
        return REFUSED
    except Exception as error:
        log.debug("not expected", exc_info=True)
        print(f"lineseg: {mistake(error)}", file=sys.stderr)
        return REFUSED
    return 0


def _call(arguments: list[str]) -> None:
    config = (DisallowNone, FlagCreatePairsOff)
    name, *rest = arguments
    if name in COMMANDS:
        function = command(name)
        # tyro would end a line of the help where one of the docstring ends.
        function.__doc__ = _flowing(function.__doc__ or "")
        with _wrapped() if {"-h", "--help"} & {*rest} else contextlib.nullcontext():
            tyro.cli(function, prog=f"lineseg {name}", args=rest, config=config)
    else:
        about = "Line segments from 2D laser scans."
        every = {name: _listed(command(name)) for name in COMMANDS}
        tyro.extras.subcommand_cli_from_dict(every, prog="lineseg", description=about, args=arguments, config=config)


def _flowing(docstring: str) -> str:
    """A docstring in which each paragraph and each argument is one line."""
    return re.sub(r"(?<=\S)\n(?!\n| {4}\S) *", " ", inspect.cleandoc(docstring))


@contextlib.contextmanager
def _wrapped() -> Iterator[None]:
    """Prints a help text with a description that is no wider than the terminal: tyro wraps only what is in boxes."""
    width = shutil.get_terminal_size().columns
    # Encoding and terminal are the same, so that tyro draws its boxes as ever.
    printed = io.TextIOWrapper(io.BytesIO(), sys.stdout.encoding)
    printed.isatty = sys.stdout.isatty
    try:
        with contextlib.redirect_stdout(printed):
            yield
    finally:
        printed.seek(0)
        for line in printed.read().splitlines():
            print(line if set(line) & set("│╭╰") else textwrap.fill(line, width, break_on_hyphens=False))


def _listed(function: Callable[..., None]) -> Callable[[], None]:
    """What stands for a command in the list of all: the first line of its description."""

    def listed() -> None: ...

    listed.__doc__ = (function.__doc__ or "").partition("\n")[0]
    return listed


def _sentence(error: BaseException) -> str:
    """An error in one line; system errors as "file: reason"."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}." if error.filename else f"{error.strerror}."
    return " ".join(str(error).split()) or "not enough memory; try a smaller file or fewer settings."
