"""Drawing of a frame: from the View to a Picture of points and lines, and from the Picture to viser."""
