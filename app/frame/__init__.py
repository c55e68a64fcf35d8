"""One frame under a View: the findings of a method, its agreement with the truth, and the state for the page."""
