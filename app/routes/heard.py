"""Text messages from a WebSocket."""

from __future__ import annotations

from starlette.websockets import WebSocket, WebSocketDisconnect


async def text_from(socket: WebSocket) -> str:
    """The next message; bytes are taken as UTF-8. Raises WebSocketDisconnect if the other side has left."""
    message = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code") or 1000)
    text = message.get("text")
    return text if text is not None else (message.get("bytes") or b"").decode("utf-8", errors="replace")
