"""Keeps the trials of auto-tuning in a text file, so that a later run continues where an earlier one ended.

One line of JSON a trial, appended as it finishes. A study of Optuna on disk takes many times as long as its trials.
"""

from __future__ import annotations

import hashlib
import json
import logging
import math
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path

from lineseg import Params
from lineseg.tuning import Trial

log = logging.getLogger(__name__)


class KeptTrials:
    """The trials of one study; about: everything that distinguishes it from other studies."""

    def __init__(self, folder: Path, about: Mapping[str, object]) -> None:
        digest = hashlib.sha256(json.dumps(about, sort_keys=True).encode()).hexdigest()[:16]
        self.file = folder / f"{digest}.jsonl"

    def forget(self) -> None:
        self.file.unlink(missing_ok=True)

    def read(self) -> list[Trial]:
        """The trials of earlier runs; a line that was cut short is left out."""
        try:
            lines = self.file.read_text(encoding="utf-8", errors="replace").splitlines()
        except FileNotFoundError:
            return []
        found: list[Trial] = []
        for line in filter(None, lines):
            try:
                params, score = json.loads(line)
                found.append(Trial(len(found), Params().but(**params), math.nan if score is None else float(score)))
            except (ValueError, TypeError, OverflowError, RecursionError):
                log.warning("%s: a line is not a trial: %.60r", self.file, line)
        return found

    def add(self, trial: Trial) -> None:
        score = None if math.isnan(trial.score) else trial.score
        self.file.parent.mkdir(parents=True, exist_ok=True)
        with self.file.open("a", encoding="utf-8") as file:
            # What was cut short before it, by a full disk, stays a line of its own.
            file.write("\n" + json.dumps([asdict(trial.params), score]) + "\n")
