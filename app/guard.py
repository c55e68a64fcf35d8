"""Access control by Host, Origin and token, on HTTP and WebSocket, and the headers of every response."""

from __future__ import annotations

import hashlib
import hmac
import ipaddress
import socket
from collections.abc import Iterable
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qsl, urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
POLICY_REFUSAL = 1008

# No inline or foreign code runs. eval stays allowed, because browser automation needs it to wait for conditions.
PAGE_POLICY = (
    "default-src 'none'; script-src 'self' 'unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; "
    "font-src 'self'; connect-src 'self'; frame-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)
# viser's page is one file with inline scripts and styles, and its WebAssembly glue code builds functions from text. It
# may connect to this server only.
VISER_POLICY = (
    "default-src 'none'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob: data:; worker-src blob: data:; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "connect-src 'self' data: blob:; media-src data: blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'self'"
)
# rerun's viewer runs in a frame of the page, and may connect to this server only.
RERUN_POLICY = PAGE_POLICY.replace("frame-ancestors 'none'", "frame-ancestors 'self'")
HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=()",
}


class Guard:
    """ASGI middleware.

    Host must be a name of this machine. This blocks DNS rebinding, where a foreign page points its own name at this
    address. Any port is accepted, because requests may come through tunnels. Origin, if sent, must equal the Host.
    """

    def __init__(self, app: ASGIApp, host: str, token: str | None, names: Iterable[str] = ()) -> None:
        self._app = app
        self._token = token
        self._any_address = is_any(host)
        self._names = LOOPBACK_NAMES | {host.lower().strip("[]")} | {name.lower() for name in names}
        if self._any_address:
            self._names |= {socket.gethostname().lower(), f"{socket.gethostname().lower()}.local"}
        # Cookies ignore ports, so several servers on one machine need different cookie names.
        self.cookie = f"lineseg-{_digest(token or '')[:8]}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is None:
            await self._app(scope, receive, _with_headers(scope, send))
        elif scope["type"] == "http":
            await refusal(scope, receive, _with_headers(scope, send))
        else:
            await _refuse_socket(scope, receive, send, refusal)

    def _refusal(self, scope: Scope) -> Response | None:
        """The response that rejects a request, or None."""
        headers = Headers(scope=scope)
        host, origin = headers.get("host", ""), headers.get("origin")
        if not self._knows(host):
            return _forbidden(f"{host or 'an empty Host'} is not a name of this server; use the address it printed")
        if origin is not None and urlsplit(origin).netloc.lower() != host.lower():
            return _forbidden(f"requests from {origin} are refused; this server answers its own page only")
        site = headers.get("sec-fetch-site")
        if site == "cross-site" and headers.get("sec-fetch-mode") != "navigate":
            return _forbidden("requests from other sites are refused; this server answers its own page only")
        return self._token_refusal(scope, headers) if self._token else None

    def _token_refusal(self, scope: Scope, headers: Headers) -> Response | None:
        if scope["type"] == "http" and scope["path"] == "/":
            offered = dict(parse_qsl(scope["query_string"].decode("latin-1"))).get("token")
            if offered is not None and self._is_token(offered):
                answer = RedirectResponse("/", status_code=303)
                answer.set_cookie(self.cookie, _digest(self._token or ""), httponly=True, samesite="strict", path="/")
                return answer
        scheme, _, offered = headers.get("authorization", "").partition(" ")
        if scheme.lower() == "bearer" and self._is_token(offered.strip()):
            return None
        if hmac.compare_digest(_cookie(headers, self.cookie).encode(), _digest(self._token or "").encode()):
            return None
        return _forbidden(
            "this server requires a token; open the address that it printed at the start, or send the token as "
            "Authorization: Bearer"
        )

    def _is_token(self, offered: str) -> bool:
        return hmac.compare_digest(offered.encode(), (self._token or "").encode())

    def _knows(self, host: str) -> bool:
        try:
            name = urlsplit(f"//{host}").hostname
        except ValueError:
            return False
        if not name or "@" in host or "/" in host:
            return False
        return name in self._names or (self._any_address and is_address(name))


def is_loopback(host: str) -> bool:
    """Whether only this machine can reach the address."""
    name = host.lower().strip("[]")
    return name in LOOPBACK_NAMES or (is_address(name) and ipaddress.ip_address(name).is_loopback)


def is_any(host: str) -> bool:
    return host in ("", "*") or (is_address(host) and ipaddress.ip_address(host.strip("[]")).is_unspecified)


def is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name.strip("[]"))
    except ValueError:
        return False
    return True


def _digest(token: str) -> str:
    return hashlib.sha256(f"lineseg {token}".encode()).hexdigest()


def _cookie(headers: Headers, name: str) -> str:
    cookies = SimpleCookie()
    try:
        cookies.load(headers.get("cookie", ""))
    except CookieError:
        return ""
    return cookies[name].value if name in cookies else ""


def _forbidden(sentence: str) -> Response:
    return JSONResponse({"message": sentence}, status_code=403)


def _with_headers(scope: Scope, send: Send) -> Send:
    policies = {"/s/": VISER_POLICY, "/rerun/": RERUN_POLICY}
    policy = next((policies[start] for start in policies if scope["path"].startswith(start)), PAGE_POLICY)

    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            headers["Content-Security-Policy"] = policy
            for name, value in HEADERS.items():
                headers[name] = value
            headers.setdefault("Cache-Control", "no-store")
        await send(message)

    return sending


async def _refuse_socket(scope: Scope, receive: Receive, send: Send, refusal: Response) -> None:
    """Reject the handshake with the response, or close the socket if the server cannot do that."""
    if "websocket.http.response" not in scope.get("extensions", {}):
        await receive()
        await send({"type": "websocket.close", "code": POLICY_REFUSAL})
        return
    await receive()
    await send({"type": "websocket.http.response.start", "status": refusal.status_code, "headers": refusal.raw_headers})
    await send({"type": "websocket.http.response.body", "body": bytes(refusal.body)})
