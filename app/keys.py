"""Who may enter: the server's token, the cookies that stand for it in a browser, and how often it may be guessed."""

from __future__ import annotations

import hashlib
import hmac
import ipaddress
import secrets
import time

COOKIE_SECONDS = 7 * 86_400
MOST_COOKIES = 1000
GUESSES, GUESS_EVERY = 5, 2.0
MOST_ADDRESSES = 10_000


class TooManyGuessesError(ValueError):
    """Too many wrong tokens came from one address."""


class Keys:
    """Cookies are random and known to this process only, so they end with it, and after a week."""

    def __init__(self, token: str) -> None:
        self._token = token.encode()
        # Cookies ignore ports, so several servers on one machine need different names.
        self.cookie = f"lineseg-{secrets.token_hex(4)}"
        self._ends: dict[bytes, float] = {}
        self._guesses: dict[str, tuple[float, float]] = {}

    def fits(self, offered: str, address: str | None) -> bool:
        """Whether this is the token. Each address may be wrong 5 times at once, then once every 2 s.

        Raises TooManyGuessesError, without a look at the token, if it was wrong more often.
        """
        place, now = _network(address), time.monotonic()
        left, since = self._guesses.get(place, (float(GUESSES), now))
        left = min(GUESSES, left + (now - since) / GUESS_EVERY)
        if left < 1:
            raise TooManyGuessesError(f"too many wrong tokens came from here; try again in {GUESS_EVERY:g} s")
        if hmac.compare_digest(offered.encode("utf-8", "surrogatepass"), self._token):
            return True
        self._guesses.pop(place, None)
        self._guesses[place] = (left - 1, now)
        while len(self._guesses) > MOST_ADDRESSES:
            del self._guesses[next(iter(self._guesses))]
        return False

    def new_cookie(self) -> str:
        value = secrets.token_urlsafe(32)
        self._ends[_digest(value)] = time.monotonic() + COOKIE_SECONDS
        while len(self._ends) > MOST_COOKIES:
            del self._ends[next(iter(self._ends))]
        return value

    def opens(self, cookie: str) -> bool:
        """Whether a browser's cookie is one of ours, and not too old."""
        return time.monotonic() < self._ends.get(_digest(cookie), 0.0)


def _digest(cookie: str) -> bytes:
    """What is looked up instead of the cookie, so that the time of the search tells nothing about it."""
    return hashlib.sha256(cookie.encode("utf-8", "surrogatepass")).digest()


def _network(address: str | None) -> str:
    """An IPv4 address, or the network of an IPv6 address, of which one host has a whole network."""
    try:
        found = ipaddress.ip_address(address or "")
    except ValueError:
        return address or ""
    if isinstance(found, ipaddress.IPv4Address):
        return str(found)
    return str(ipaddress.ip_network((found, 64), strict=False))
