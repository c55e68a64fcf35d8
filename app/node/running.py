"""The method and the thresholds that a node runs: those of its file, or what was sent to it since."""

from __future__ import annotations

from collections.abc import Callable

from lineseg import Thresholds


class Running:
    """What was set last holds, whether it came from the file or was sent.

    reread: the thresholds in the file if it has changed, else None.
    """

    def __init__(self, method: str, params: Thresholds, reread: Callable[[], Thresholds | None] = lambda: None) -> None:
        self.now = method, params
        self._method, self._reread = method, reread

    def newest(self) -> tuple[str, Thresholds]:
        """Looks at the file, too."""
        found = self._reread()
        if found is not None:
            self.now = self._method, found
        return self.now

    def send(self, method: str, params: Thresholds) -> None:
        """Hold from the next scan on."""
        self.now = method, params
