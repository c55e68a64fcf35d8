"""The effect of other thresholds on a frame or a recording."""
