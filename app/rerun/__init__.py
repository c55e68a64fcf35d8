"""Recordings for rerun (rerun.io): to a file, in the page, and live. Nothing here is imported until it is used."""

import lineseg.rerun  # noqa: F401 - if rerun is missing, this says what to install
