"""What is kept on disk and may be opened: recordings, uploads, recent files, labels, lessons."""
