"""The entry of the command line, which loads what the command needs only once signals are handled."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from .stopping import interruptible

INTERRUPTED, TERMINATED = 130, 143


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code."""
    arguments = list(sys.argv[1:] if argv is None else argv)
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
