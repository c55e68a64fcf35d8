"""Poses of the laser: from the messages of a bag, or from a trajectory beside the recording."""
