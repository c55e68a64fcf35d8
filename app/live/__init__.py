"""Live scans: from a robot, or pushed by any program."""
