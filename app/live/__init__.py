"""Scans that arrive while one looks: from a robot, or pushed by any program."""
