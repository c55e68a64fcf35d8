"""`lineseg params`: thresholds for ROS, Python or the command line."""

from __future__ import annotations

import sys
from typing import Literal

from tyro.conf import OmitArgPrefixes

from lineseg.writers import params_text

from .thresholds import Choice, Flags


def params(
    method: OmitArgPrefixes[Choice],
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    *,
    to: Literal["ros2", "ros1", "python", "flags"] = "ros2",
) -> None:
    """Write thresholds for ROS, Python or the command line.

    Args:
        method: the method, and where its thresholds come from (default: the method's defaults).
        threshold: thresholds of region growing; they override --params.
        to: format: ROS 2 parameters, ROS 1 launch file, Python, or flags of `lineseg extract`.
    """
    sys.stdout.write(params_text(method.thresholds(threshold), to))
