"""Who may use the server."""

from __future__ import annotations

import queue
import re
import socket
import threading
import time
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest
from lineseg_app.guard import policies
from lineseg_app.keys import COOKIE_SECONDS, GUESS_EVERY, GUESSES, Keys, TooManyGuessesError
from lineseg_app.listening import listen, server_of
from lineseg_app.routes.page import state_of
from lineseg_app.server import Settings, create_app, serve
from live import Address, Page, connect, page_of, serving
from waiting import SECONDS
from websockets.exceptions import InvalidStatus


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8765", "127.0.0.1.evil.example", "", "localhost@evil.example"]
)
def test_a_foreign_host_is_refused(server: Address, host: str):
    answer = server.get("/", headers={"Host": host})
    assert answer.status_code == 403
    assert "not a name of this server" in answer.json()["message"]


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1", "[::1]", "localhost:9000", "LOCALHOST:9000"])
def test_this_machine_may_be_reached_through_a_tunnel(server: Address, host: str):
    assert server.get("/static/index.html", headers={"Host": host}).status_code == 200


FOREIGN = ["http://evil.example", "https://evil.example", "null", "http://localhost:1", "http://127.0.0.1.evil.example"]


@pytest.mark.parametrize("origin", FOREIGN)
def test_a_foreign_origin_is_refused_on_http(server: Address, origin: str):
    answer = server.upload("a.npz", b"x", headers={"Origin": origin})
    assert answer.status_code == 403
    assert origin in answer.json()["message"]


@pytest.mark.parametrize("path", ["/api/session", "/s/whatever/viser"])
@pytest.mark.parametrize("origin", FOREIGN)
def test_a_foreign_origin_is_refused_on_sockets(server: Address, origin: str, path: str):
    with pytest.raises(InvalidStatus) as refused, connect(server.ws + path, origin=origin):  # pyright: ignore
        pass
    assert refused.value.response.status_code == 403


def test_a_foreign_host_is_refused_on_sockets(server: Address):
    there = socket.create_connection(("127.0.0.1", server.port))
    with pytest.raises(InvalidStatus) as refused, connect("ws://evil.example/api/session", sock=there):
        pass
    assert refused.value.response.status_code == 403


@pytest.mark.parametrize("start", ["http://{}#evil", "http://{}/", "http://user@{}", "ftp://{}", "http://{}.", "{}"])
def test_an_origin_that_only_resembles_ours_is_refused(server: Address, start: str):
    origin = start.format(f"127.0.0.1:{server.port}")
    assert server.get("/", headers={"Origin": origin}).status_code == 403
    headers = [("Origin", server.http), ("Origin", origin)]
    assert server.get("/", headers=headers).status_code == 403


@pytest.mark.parametrize("host", ["127.0.0.1:8401#evil", "localhost:99999", "localhost:", "local\thost", "[::1", "::1"])
def test_a_host_that_only_resembles_ours_is_refused(server: Address, host: str):
    assert server.get("/", headers={"Host": host}).status_code in (400, 403)


def test_requests_of_the_page_itself_are_accepted(server: Address):
    with page_of(server, origin=server.http) as page:
        page.hello()


def test_other_sites_may_not_embed_what_the_server_has(server: Address):
    for site in ("cross-site", "same-site"):
        assert server.get("/static/main.js", headers={"Sec-Fetch-Site": site}).status_code == 403
    following_a_link = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate"}
    assert server.get("/", headers=following_a_link).status_code == 200


def test_the_page_may_load_from_this_server_only(server: Address):
    headers = server.get("/").headers
    policy = dict(part.split(" ", 1) for part in headers["content-security-policy"].split("; "))
    assert policy["default-src"] == "'none'"
    assert {policy[name] for name in ("style-src", "connect-src")} == {"'self'"}
    assert policy["script-src"] == "'self' 'unsafe-eval'"
    assert policy["frame-ancestors"] == "'none'"
    assert headers["x-content-type-options"] == "nosniff"


def test_the_scene_may_be_framed_by_the_page_only(server: Address, page: Page):
    page.hello()
    policy = server.get(page.welcome["viser"]).headers["content-security-policy"]
    assert "frame-ancestors 'self'" in policy
    assert "connect-src 'self' data: blob:" in policy


def test_a_site_may_show_the_page_in_a_frame_only_if_it_is_named():
    named = policies(("https://Course.example.org", "http://10.0.0.7:8080"))
    ancestors = "frame-ancestors 'self' https://course.example.org http://10.0.0.7:8080"
    assert all(policy.split("; ").count(ancestors) == 1 for policy in named.values())
    assert [policy.count("frame-ancestors") for policy in named.values()] == [1, 1, 1]
    assert policies(())[""].endswith("frame-ancestors 'none'")


@pytest.mark.parametrize("origin", ["*", "null", "course.example.org", "https://a.b/x", "https://a; script-src *", ""])
def test_an_embedding_site_is_named_by_its_origin(origin: str):
    with pytest.raises(ValueError, match=r"--allow-embedding is .* give scheme and name of the other site"):
        Settings(embedders=(origin,))


PATHS = [
    "/static/../pyproject.toml",
    "/static/%2e%2e/pyproject.toml",
    "/static/..%2fpyproject.toml",
    "/static//etc/passwd",
]


@pytest.mark.parametrize("path", PATHS)
def test_no_path_leads_out_of_the_static_folder(server: Address, path: str):
    assert server.get(path).status_code == 404


def test_static_files_are_answered_by_their_etag(server: Address):
    first = server.get("/static/index.html")
    assert first.headers["cache-control"] == "no-cache"
    again = server.get("/static/index.html", headers={"If-None-Match": first.headers["etag"]})
    assert again.status_code == 304


def test_the_page_loads_its_files_from_a_place_that_changes_with_them(server: Address, tmp_path: Path):
    (address,) = re.findall(r'src="(/static/at/\w+/)main.js"', server.get("/").text)
    for name in ("main.js", "declared.js", "bars/strip.css"):
        kept = server.get(address + name)
        assert "immutable" in kept.headers["cache-control"]
        assert kept.content == server.get("/static/" + name).content
    assert server.get(address + "nothing.js").headers["cache-control"] == "no-store"
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "one.js").write_text("1")
    before = state_of(tmp_path, "")
    assert state_of(tmp_path, "") == before != state_of(tmp_path, "declared otherwise")
    (tmp_path / "parts" / "one.js").write_text("12")
    assert state_of(tmp_path, "") != before


def test_an_unknown_address_is_answered_with_a_message(server: Address):
    answer = server.get("/api/nothing")
    assert answer.status_code == 404
    assert list(answer.json()) == ["message"]


def test_a_host_other_than_the_loopback_needs_a_token():
    with pytest.raises(ValueError, match=r"0\.0\.0\.0.*token"):
        create_app(Settings(host="0.0.0.0"))


@pytest.fixture(scope="module")
def public(tmp_path_factory):
    """A server configured for other machines, with its socket on the loopback."""
    with serving(Settings(host="0.0.0.0", token="sesame", data_folder=tmp_path_factory.mktemp("data"))) as address:
        yield address


def test_without_the_token_nothing_is_answered(public: Address):
    for path in ("/", "/?token=wrong", "/static/index.html", "/api/params", "/?token="):
        assert public.get(path).status_code == 403, path
    with pytest.raises(InvalidStatus), page_of(public):
        pass


def test_the_token_becomes_a_cookie_that_opens_the_page(public: Address):
    entered = public.get("/?token=sesame")
    assert (entered.status_code, entered.headers["location"]) == (303, "/")
    cookie = entered.headers["set-cookie"]
    assert "HttpOnly" in cookie
    assert "SameSite=strict" in cookie
    assert "Max-Age=" in cookie
    assert "sesame" not in cookie
    assert public.get("/?token=sesame").headers["set-cookie"] != cookie
    key = {"Cookie": cookie.split(";")[0]}
    assert public.get("/", headers=key).status_code == 200
    with page_of(public, additional_headers=key) as page:
        page.hello()


def test_a_link_on_another_site_opens_the_page_too(public: Address):
    # A browser would not send the strict cookie after a redirect from there.
    answer = public.get("/?token=sesame", headers={"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate"})
    assert (answer.status_code, answer.headers.get("set-cookie")) == (200, None)
    assert 'http-equiv="refresh"' in answer.text


def test_guesses_of_the_token_are_slowed_for_each_address(monkeypatch: pytest.MonkeyPatch):
    keys, clock = Keys("sesame"), [0.0]
    monkeypatch.setattr("lineseg_app.keys.time", SimpleNamespace(monotonic=lambda: clock[0]))
    assert not any(keys.fits(str(guess), "10.0.0.1") for guess in range(GUESSES))
    for offered in ("sesame", "wrong"):
        with pytest.raises(TooManyGuessesError, match="try again in 2 s"):
            keys.fits(offered, "10.0.0.1")
    assert keys.fits("sesame", "10.0.0.2")
    assert not any(keys.fits(str(guess), f"fd00::{guess}") for guess in range(GUESSES))
    with pytest.raises(TooManyGuessesError):
        keys.fits("sesame", "fd00::77")
    clock[0] = GUESS_EVERY
    assert keys.fits("sesame", "fd00::77")


def test_whoever_guesses_is_told_to_wait_whatever_address_a_header_claims(tmp_path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("lineseg_app.keys.GUESS_EVERY", 10 * SECONDS)
    with serving(Settings(token="sesame", data_folder=tmp_path)) as server:
        claims = [{"Authorization": f"Bearer {guess}", "X-Forwarded-For": f"10.0.0.{guess}"} for guess in range(9)]
        answers = [server.get("/api/params", headers=claim).status_code for claim in claims]
        assert (answers[0], answers[-1]) == (403, 429)


def test_a_cookie_ends_with_its_server_and_after_a_week(monkeypatch: pytest.MonkeyPatch):
    keys = Keys("sesame")
    cookie = keys.new_cookie()
    assert keys.opens(cookie)
    assert not Keys("sesame").opens(cookie)
    later = time.monotonic() + COOKIE_SECONDS + 1
    # Not in all of Python: the loop of a server that runs would go to sleep for a week.
    monkeypatch.setattr("lineseg_app.keys.time", SimpleNamespace(monotonic=lambda: later))
    assert not keys.opens(cookie)


def test_the_browser_is_not_given_the_token_as_an_argument(tmp_path, monkeypatch: pytest.MonkeyPatch):
    opened = queue.Queue()
    monkeypatch.setattr("webbrowser.open", opened.put)

    def stop_when_opened() -> None:
        place = Path(url2pathname(urlsplit(opened.get(timeout=SECONDS)).path))
        found.append((place.read_text(), place.stat().st_mode & 0o077))
        servers[0].should_exit = True

    found, servers = [], []
    real = server_of
    monkeypatch.setattr("lineseg_app.server.server_of", lambda *given: servers.append(real(*given)) or servers[0])
    threading.Thread(target=stop_when_opened).start()
    serve(Settings(port=0, token="open sesame", data_folder=tmp_path))
    (text, others) = found[0]
    assert "?token=open%20sesame" in text
    assert others == 0
    assert not list(tmp_path.glob("open-*"))


def test_a_public_server_answers_to_addresses_but_not_to_any_name(public: Address):
    assert public.get("/?token=sesame", headers={"Host": "192.168.1.7:8765"}).status_code == 303
    assert public.get("/?token=sesame", headers={"Host": "evil.example"}).status_code == 403


def test_a_busy_port_is_named_with_a_way_out(server: Address):
    with pytest.raises(OSError, match=rf"port {server.port} .* is in use.*--port"):
        listen("127.0.0.1", server.port)
