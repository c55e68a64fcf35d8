"""What the server offers over HTTP and WebSocket, a file a subject."""
