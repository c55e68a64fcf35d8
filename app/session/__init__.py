"""Browser tabs: each has a View, and threads that draw it and survey its recording."""
