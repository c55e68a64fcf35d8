"""Access control by Host, Origin and token, on HTTP and WebSocket, and the headers of every response."""

from __future__ import annotations

import ipaddress
import re
import socket
from collections.abc import Iterable, Mapping, Sequence
from http.cookies import CookieError, SimpleCookie
from typing import NamedTuple
from urllib.parse import parse_qsl

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from .keys import COOKIE_SECONDS, Keys, TooManyGuessesError

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
POLICY_REFUSAL = 1008
PLACE = re.compile(r"(?P<name>[a-z0-9_.-]+|\[[0-9a-f:.]+\])(?::(?P<port>[0-9]{1,5}))?", re.IGNORECASE)
ORIGIN = re.compile(rf"(?P<scheme>https?)://(?P<place>{PLACE.pattern})", re.IGNORECASE)
DEFAULT_PORTS = {"http": 80, "https": 443}

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
    address. Any port is accepted, because requests may come through tunnels. Origin, if sent, must be http or https at
    the same name and port: behind a proxy, the page may be https.
    """

    def __init__(
        self, app: ASGIApp, host: str, token: str | None, names: Iterable[str] = (), embedders: Iterable[str] = ()
    ) -> None:
        """embedders: origins whose pages may show this one in a frame."""
        self._app = app
        self._policies = policies(tuple(embedders))
        self._keys = Keys(token) if token else None
        self._any_address = is_any(host)
        self._names = LOOPBACK_NAMES | {host.lower().strip("[]")} | {name.lower() for name in names}
        if self._any_address:
            self._names |= {socket.gethostname().lower(), f"{socket.gethostname().lower()}.local"}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is None:
            await self._app(scope, receive, _with_headers(scope, send, self._policies))
        elif scope["type"] == "http":
            await refusal(scope, receive, _with_headers(scope, send, self._policies))
        else:
            await _refuse_socket(scope, receive, send, refusal)

    def _refusal(self, scope: Scope) -> Response | None:
        """The response that rejects a request, or None."""
        headers = Headers(scope=scope)
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        host = place_of(hosts[0]) if len(hosts) == 1 else None
        if host is None or not (host.name in self._names or (self._any_address and is_address(host.name))):
            shown = " and ".join(hosts) or "an empty Host"
            return _refused(f"{shown} is not a name of this server; use the address it printed")
        if not all(_is_at(origin, host) for origin in origins):
            return _refused(f"requests from {' and '.join(origins)} are refused; this server answers its own page only")
        site = headers.get("sec-fetch-site")
        if site in ("cross-site", "same-site") and headers.get("sec-fetch-mode") != "navigate":
            return _refused("requests from other pages are refused; this server answers its own page only")
        return self._token_refusal(scope, headers, self._keys) if self._keys else None

    def _token_refusal(self, scope: Scope, headers: Headers, keys: Keys) -> Response | None:
        address = scope["client"][0] if scope.get("client") else None
        try:
            if scope["type"] == "http" and scope["path"] == "/":
                offered = dict(parse_qsl(scope["query_string"].decode("latin-1"))).get("token")
                if offered is not None and keys.fits(offered, address):
                    return _entered(headers, keys)
            scheme, _, offered = headers.get("authorization", "").partition(" ")
            if scheme.lower() == "bearer" and keys.fits(offered.strip(), address):
                return None
        except TooManyGuessesError as error:
            return _refused(str(error), 429)
        if keys.opens(_cookie(headers, keys.cookie)):
            return None
        return _refused(
            "this server requires a token; open the address that it printed at the start, or send the token as "
            "Authorization: Bearer"
        )


class Place(NamedTuple):
    """A name or address, in lower case and without brackets, and a port, if one was given."""

    name: str
    port: int | None


def place_of(host: str) -> Place | None:
    """The parts of `name`, `name:port` or `[address]:port`; None if it is anything else."""
    parts = PLACE.fullmatch(host)
    if parts is None or int(parts["port"] or 0) > 65_535:
        return None
    return Place(parts["name"].lower().strip("[]"), int(parts["port"]) if parts["port"] else None)


def _is_at(origin: str, host: Place) -> bool:
    """Whether an Origin is a page of this host, with the usual port of its scheme if none is given."""
    parts = ORIGIN.fullmatch(origin)
    place = place_of(parts["place"]) if parts else None
    if parts is None or place is None:
        return False
    usual = DEFAULT_PORTS[parts["scheme"].lower()]
    return (place.name, place.port or usual) == (host.name, host.port or usual)


def _entered(headers: Headers, keys: Keys) -> Response:
    """To the page, with a cookie instead of the token in the address.

    A browser sends no strict cookie to where a link on another site led. So the address is first opened once more, by
    ourselves.
    """
    if headers.get("sec-fetch-site") == "cross-site":
        return HTMLResponse('<!doctype html><meta http-equiv="refresh" content="0"><title>lineseg</title>')
    answer = RedirectResponse("/", status_code=303)
    answer.set_cookie(
        keys.cookie,
        keys.new_cookie(),
        max_age=COOKIE_SECONDS,
        httponly=True,
        samesite="strict",
        path="/",
        secure=headers.get("x-forwarded-proto") == "https",
    )
    return answer


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


def _cookie(headers: Headers, name: str) -> str:
    cookies = SimpleCookie()
    try:
        cookies.load(headers.get("cookie", ""))
    except CookieError:
        return ""
    return cookies[name].value if name in cookies else ""


def _refused(sentence: str, status: int = 403) -> Response:
    return JSONResponse({"message": sentence}, status_code=status)


def policies(embedders: Sequence[str]) -> dict[str, str]:
    """The policy for each beginning of a path; the first that fits counts.

    A frame in the page is also in whatever the page is in.
    """
    found = {"/s/": VISER_POLICY, "/rerun/": RERUN_POLICY, "": PAGE_POLICY}
    if not embedders:
        return found
    allowed = f"frame-ancestors 'self' {' '.join(origin.lower() for origin in embedders)}"
    return {start: re.sub(r"frame-ancestors '\w+'", allowed, policy) for start, policy in found.items()}


def check_origin(origin: str) -> None:
    """Raises ValueError if this is not an origin of HTTP: scheme, name and, if need be, port."""
    parts = ORIGIN.fullmatch(origin)
    if parts is None or place_of(parts["place"]) is None:
        raise ValueError(
            f"--allow-embedding is {origin[:80]!r}; give scheme and name of the other site, with its port if it has "
            "one, and without a path: https://course.example.org"
        )


def _with_headers(scope: Scope, send: Send, policies: Mapping[str, str]) -> Send:
    policy = next(policies[start] for start in policies if scope["path"].startswith(start))

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
