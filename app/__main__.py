"""The command line: which command, and what becomes of its errors. Only this and `commands/` print and exit."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

import tyro

from lineseg import __version__

from .commands import COMMANDS
from .commands.progress import interruptible

INTERRUPTED = 130
REFUSED = 2


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; the exit code. `lineseg FILE` is `lineseg view FILE`."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    if not arguments or arguments[0] not in (*COMMANDS, "-h", "--help", "--version"):
        arguments.insert(0, "view")
    if arguments == ["--version"]:
        print(f"lineseg {__version__}")
        return 0
    try:
        with interruptible():
            tyro.extras.subcommand_cli_from_dict(
                COMMANDS, prog="lineseg", description="Line segments from 2D laser scans.", args=arguments
            )
            sys.stdout.flush()
    except KeyboardInterrupt:
        print("lineseg: stopped.", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        # The reader of a pipe, such as `head`, has seen enough; Python would complain once more while it exits.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, OSError, MemoryError, ModuleNotFoundError) as error:
        print(f"lineseg: {_sentence(error)}", file=sys.stderr)
        return REFUSED
    return 0


def _sentence(error: BaseException) -> str:
    """What an error says, in a line; the errors of the system name the file behind a colon."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}." if error.filename else f"{error.strerror}."
    return " ".join(str(error).split()) or "there is not enough memory for this."


if __name__ == "__main__":
    sys.exit(main())
