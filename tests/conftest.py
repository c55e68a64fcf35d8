"""Where the real recordings and the reference outputs are."""

import gc
import math
import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from lineseg.readers import parts

# What is imported stays, so it need not be gone through again and again in search of garbage.
gc.disable()

# How long an example takes says nothing about its truth, and what passes here is to pass everywhere.
settings.register_profile(
    "lineseg", settings.default, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
# Fewer examples, for `make quick`.
settings.register_profile("quick", settings.get_profile("lineseg"), max_examples=15)
settings.load_profile("lineseg")


def pytest_collection_finish() -> None:
    gc.freeze()
    gc.enable()


def _folder(variable: str) -> Path:
    folder = os.environ.get(variable)
    if not folder:
        pytest.skip(f"set {variable} to the folder that holds them")
    return Path(folder)


@pytest.fixture(scope="session")
def data_dir() -> Path:
    """Real recordings."""
    return _folder("LINESEG_DATA")


@pytest.fixture(scope="session")
def reference_dir() -> Path:
    """Outputs of other programs."""
    return _folder("LINESEG_REFERENCE")


@pytest.fixture(autouse=True)
def whole_files(monkeypatch: pytest.MonkeyPatch) -> None:
    """However long it takes to read a file, nothing is shown of it before the end, unless a test asks for that."""
    monkeypatch.setattr(parts, "FIRST", math.inf)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests that start a server or a browser: those in files that import a helper that does."""
    helpers = {"live", "robots", "processes", "obeying"}
    for item in items:
        imported = {getattr(value, "__module__", None) for value in vars(getattr(item, "module", item)).values()}
        if imported & helpers or "browser" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.server)
    items.sort(key=_turn)


# They begin first among those with a browser, so that no worker is left with a long one at the end.
LONGEST = (
    "learn", "inspect", "places", "labels", "window", "rerun", "export", "methods", "kinds_of_files", "strip", "tuner",
    "lesson_views", "learn_scene",
)  # fmt: skip


def _turn(item: pytest.Item) -> int:
    """When the tests of a file have their turn.

    Those with a browser are last, because its loop runs in the main thread until the end, where other tests run loops.
    """
    if "browser" not in item.path.parts:
        return 0
    name = item.path.stem.removeprefix("test_")
    return 1 + (LONGEST.index(name) if name in LONGEST else len(LONGEST))


# What `.ci/run` does not install.
OPTIONAL = ("tests/browser/test_firefox.py",)


def _missed(reporter: pytest.TerminalReporter) -> int:
    """The number of tests that were skipped although nothing may be."""
    if not os.environ.get("LINESEG_NOTHING_SKIPPED"):
        return 0
    return sum(not report.nodeid.startswith(OPTIONAL) for report in reporter.stats.get("skipped", []))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """If everything is installed, no test may be skipped."""
    if missed := _missed(terminalreporter):
        terminalreporter.write_line(f"{missed} tests were skipped, and LINESEG_NOTHING_SKIPPED is set", red=True)


def pytest_sessionfinish(session: pytest.Session) -> None:
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if reporter and _missed(reporter):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
