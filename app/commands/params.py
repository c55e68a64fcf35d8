"""`lineseg params`: thresholds for ROS, Python or the command line."""

from __future__ import annotations

import sys
from typing import Literal

from tyro.conf import OmitArgPrefixes

from lineseg.writers import params_text

from .thresholds import Choice


def params(
    choice: OmitArgPrefixes[Choice],
    *,
    to: Literal["ros2", "ros1", "python", "flags"] = "ros2",
) -> None:
    """Write thresholds for ROS, Python or the command line.

    Args:
        choice: method and thresholds (default: from --params, else the method's defaults).
        to: format: ROS 2 parameters, ROS 1 launch file, Python, or flags of `lineseg extract`.
    """
    sys.stdout.write(params_text(choice.thresholds, to))
