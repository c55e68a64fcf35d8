"""The command line in its own process."""

import subprocess
import sys

# A shell that starts the tests in the background has them ignore Ctrl-C, and a child would inherit that.
HEAR_CTRL_C = """
import runpy, signal
signal.signal(signal.SIGINT, signal.default_int_handler)
runpy.run_module("lineseg_app", run_name="__main__")
"""


def lineseg(*arguments, **options):
    return subprocess.Popen(
        [sys.executable, "-c", HEAR_CTRL_C, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )
