"""The server's HTTP and WebSocket routes, one file for each subject."""
