"""What other thresholds would do to a frame or to a recording."""
