"""Files on disk: recordings, uploads, recent files, labels, lessons."""
