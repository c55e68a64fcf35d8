"""The entry of the command line, which loads what the command needs only once signals are handled."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from .stopping import end_if_stuck, interruptible

INTERRUPTED, TERMINATED = 130, 143


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code."""
    if argv is not None:
        return _run(list(argv))
    try:
        code = _run(sys.argv[1:])
    except SystemExit as ended:
        end_if_stuck(ended.code if isinstance(ended.code, int) else 1)
        raise
    end_if_stuck(code)
    return code


def _run(arguments: list[str]) -> int:
    try:
        with interruptible(0 if _serves(arguments) else TERMINATED):
            from .command_line import run

            return run(arguments)
    except KeyboardInterrupt:
        print("lineseg: stopped.", file=sys.stderr)
        return INTERRUPTED


def _serves(arguments: Sequence[str]) -> bool:
    """Whether SIGTERM is how the command usually ends. What is not one word is a file to view."""
    return not arguments or arguments[0] in ("view", "node") or not arguments[0].isalpha()


if __name__ == "__main__":
    sys.exit(main())
