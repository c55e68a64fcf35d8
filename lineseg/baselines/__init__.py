"""The other methods of the field, to be held beside region growing: one file each, with thresholds of its own."""
