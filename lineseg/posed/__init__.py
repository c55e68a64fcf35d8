"""Scans and walls in the world: the returns of scans with poses, and the wall nearest to each."""
