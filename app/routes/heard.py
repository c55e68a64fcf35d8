"""Text messages from a WebSocket."""

from __future__ import annotations

import asyncio

from starlette.websockets import WebSocket, WebSocketDisconnect

FIRST_SECONDS = 10.0
POLICY_REFUSAL = 1008


async def first_text_from(socket: WebSocket) -> str:
    """The first message. Closes the connection and raises WebSocketDisconnect if none comes for a while."""
    try:
        return await asyncio.wait_for(text_from(socket), FIRST_SECONDS)
    except TimeoutError:
        await socket.close(POLICY_REFUSAL, f"nothing came for {FIRST_SECONDS:g} s")
        raise WebSocketDisconnect(POLICY_REFUSAL) from None


async def text_from(socket: WebSocket) -> str:
    """The next message; bytes are taken as UTF-8. Raises WebSocketDisconnect if the other side has left."""
    message = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code") or 1000)
    text = message.get("text")
    return text if text is not None else (message.get("bytes") or b"").decode("utf-8", errors="replace")
