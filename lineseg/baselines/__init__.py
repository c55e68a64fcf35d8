"""Other methods to compare with region growing, one file each, with their own thresholds."""
