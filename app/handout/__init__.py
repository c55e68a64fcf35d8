"""Pages that stand alone: a lesson or one frame in one HTML file, without a server."""
