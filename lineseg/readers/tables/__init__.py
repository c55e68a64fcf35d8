"""Tables of numbers as text: how they are written, and what their rows and columns are."""
