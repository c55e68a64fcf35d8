"""What is known of one frame under a View: what a method found, how it agrees with the truth, what the page is told."""
