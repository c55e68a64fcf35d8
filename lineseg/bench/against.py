"""Another program, timed beside this one: frames go to its standard input, one JSON line each, and it answers each."""

from __future__ import annotations

import json
import math
import shlex
import subprocess
import threading
from time import perf_counter_ns
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from ..scan import Scan
from ..writers.finite import finite_or_none

# A frame takes any program far less; one that is silent for longer waits for something else.
PATIENCE = 30.0
# A program that has closed its output is about to end.
END_SECONDS = 10.0


class AgainstError(ValueError):
    """The other program cannot be timed; says at which frame, what was found and what was expected."""


class Against:
    """A program that reads frames and answers each with one line; to be used as a context.

    It gets one line of JSON for each scan: `bearings` [rad], `ranges` [m], null where there is no return, and
    `range_min`, `range_max` [m], null for no limit. Once it has the segments, it writes one line and flushes it:
    {"us": TIME}, its own time for the frame [µs] without reading and writing text. With any other line, such as an
    empty one, the time is that there and back, with the text in it.
    """

    def __init__(self, command: str, scans: list[Scan], patience: float = PATIENCE) -> None:
        self.command, self.patience = command, patience
        self._frames = [_line(scan) for scan in scans]

    def __enter__(self) -> Against:
        try:
            words = shlex.split(self.command)
            self._program = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        except (OSError, ValueError, IndexError) as error:
            raise AgainstError(f"--against {self.command!r} cannot be started: {error}") from error
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._program.kill()
        self._program.communicate()

    def run(self) -> NDArray[np.float64]:
        """Times of all frames, in their order: (frames,) [ns]. Raises AgainstError."""
        return np.array([self._time(number, frame) for number, frame in enumerate(self._frames)])

    def _time(self, number: int, frame: bytes) -> float:
        sent, received = self._program.stdin, self._program.stdout
        assert sent and received
        silent = threading.Timer(self.patience, self._program.kill)
        silent.start()
        before = perf_counter_ns()
        try:
            sent.write(frame)
            sent.flush()
            answer = received.readline()
            there_and_back = perf_counter_ns() - before
        except OSError:
            answer, there_and_back = b"", 0
        finally:
            silent.cancel()
        if not answer:
            raise AgainstError(f"{self._place(number)} {self._end()}; expected one line for each frame.")
        own = self._own_time(number, answer)
        return there_and_back if own is None else 1e3 * own

    def _end(self) -> str:
        """What became of a program that gave no answer."""
        try:
            code = self._program.wait(END_SECONDS)
        except subprocess.TimeoutExpired:
            return "closed its output"
        return f"ended with code {code}" if code >= 0 else f"was silent for {self.patience:g} s, or was stopped"

    def _own_time(self, number: int, answer: bytes) -> float | None:
        """What the program says that the frame took [µs]; None if it doesn't."""
        try:
            said = json.loads(answer)
        except ValueError:
            return None
        if not isinstance(said, dict) or "us" not in said:
            return None
        own = said["us"]
        if isinstance(own, bool) or not isinstance(own, int | float) or not 0 < own < math.inf:
            raise AgainstError(f'{self._place(number)} answered "us": {own!r}; expected a time above 0 [µs].')
        return float(own)

    def _place(self, number: int) -> str:
        return f"Frame {number}: --against {self.command!r}"


def _line(scan: Scan) -> bytes:
    limits = {"range_min": scan.range_min, "range_max": finite_or_none(scan.range_max)}
    ranges = [value if valid else None for value, valid in zip(scan.ranges.tolist(), scan.valid, strict=True)]
    return json.dumps(limits | {"bearings": scan.bearings.tolist(), "ranges": ranges}).encode() + b"\n"
