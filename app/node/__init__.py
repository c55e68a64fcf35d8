"""`lineseg node`: the segments of a robot's scans, published to the robot without a page."""
