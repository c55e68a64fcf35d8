"""What is drawn of a frame: the View as a Picture of points and lines, and the Picture in viser."""
