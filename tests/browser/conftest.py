"""A real server and a real browser; a `Tab` does what a person does in a tab."""

from __future__ import annotations

import os
import re
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from lineseg_app.server import Settings
from live import Address, serving
from ports import held_port
from waiting import SECONDS, eventually

try:
    from playwright.sync_api import Browser, ConsoleMessage, Error, Frame, Page, ViewportSize, sync_playwright
except ImportError:
    pytest.skip("pip install playwright", allow_module_level=True)

VIEWPORT = ViewportSize(width=1280, height=800)
# What a tab shows that no link tells what to show.
FIRST = "#recording=sample:hallway"
FLAGS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    # Without a graphics card only the scene is worth drawing as if there were one.
    "--disable-gpu-compositing",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-quic",
)
# Nobody looks at the pixels of a scene in a test, or of rerun, only at what it is drawn from. Painting without a card
# takes as long as all the rest. Nor is the scene cleared, which alone would send a picture of it to the screen.
UNPAINTED = """if (/\\/(viser|rerun)\\//.test(location.pathname))
    for (const draw of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced", "clear"])
        WebGL2RenderingContext.prototype[draw] = () => {};"""
SLIDER = "[data-knob={}] input[type=range]"
FIELD = "[data-knob={}] input.number"


class Tab:
    """A page and its errors."""

    def __init__(self, page: Page, address: str) -> None:
        self.page = page
        self.address = address
        self.complaints: list[str] = []
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self.complaints.append(f"page error: {error}"))
        page.on("request", lambda request: self._watch(request.url))
        page.on("websocket", lambda opened: self._watch(opened.url))

    def _hear(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.complaints.append(f"console: {message.text} {message.location['url']}")

    def _watch(self, url: str) -> None:
        host = re.sub(r"^\w+://", "", self.address).split("/")[0]
        if re.match(r"(http|ws)s?://", url) and url.split("/")[2] != host:
            self.complaints.append(f"foreign request: {url}")

    def forgive(self, *words: str) -> None:
        """Drop errors that the test has provoked."""
        self.complaints[:] = [said for said in self.complaints if not any(word in said for word in words)]

    def open(self, hash: str = "") -> Tab:
        self.page.goto(self.address + hash)
        self.until("true")
        return self

    def look_at(self, hash: str) -> Tab:
        """Open a link in this tab as it is, as a person does who clicks one.

        A link that names no recording shows the one of a fresh tab.
        """
        if "follow=" in hash or hash.startswith("?"):
            self.page.goto("about:blank")
            return self.open(hash)
        self.page.set_viewport_size(VIEWPORT)
        self.page.evaluate(
            """(hash) => new Promise((done) => {
                localStorage.clear();
                for (const dialog of document.querySelectorAll("dialog[open]")) dialog.close();
                document.activeElement?.blur();
                history.replaceState(null, "", "#");
                addEventListener("hashchange", () => setTimeout(done), { once: true });
                location.hash = hash;
            })""",
            hash if "recording=" in hash else f"{FIRST}&{hash[1:]}" if len(hash) > 1 else FIRST,
        )
        self.until("true")
        self.page.evaluate("""() => {
            const tabs = [...document.querySelectorAll("#panel [role=tab]")];
            tabs.find((tab) => tab.checkVisibility())?.click();
        }""")
        return self

    def until(self, condition: str) -> dict[str, Any]:
        """Return the drawn state `s` once `condition` holds for it and no request is under way."""
        return self.found(
            f"const s = window.lineseg?.state; if (s && window.lineseg.settled && ({condition})) return s;", condition
        )

    def found(self, look: str, what: str) -> Any:
        """What `look`, the body of a function in JavaScript, returns as soon as it returns anything.

        what: is waited for; the failure says it, and what is on the screen instead.
        """
        script = f"""async () => {{
            const look = () => {{ {look} }};
            const late = Date.now() + {1000 * SECONDS};
            for (let found; ; await new Promise((go) => setTimeout(go, 10))) {{
                if (found = look()) return found;
                if (Date.now() > late) return null;
            }}
        }}"""
        found = self.page.evaluate(script)
        if found is None:
            raise AssertionError(f"waited {SECONDS} s in vain for {what}; {self._seen()}")
        return found

    def _seen(self) -> str:
        """What is on the screen, for a failure: the state as far as it fits, and the notices."""
        script = """() => [window.lineseg?.settled, JSON.stringify(window.lineseg?.state ?? null).slice(0, 3000),
            [...document.querySelectorAll(".notice, .toast, [role=alert]")].map((each) => each.textContent)]"""
        settled, state, notices = self.page.evaluate(script)
        return f"settled: {settled}; state: {state}; notices: {notices}; complaints: {self.complaints}"

    @property
    def state(self) -> dict[str, Any]:
        return self.until("true")

    @property
    def scene(self) -> Frame:
        """viser's frame, once its camera is the page's and something is drawn."""
        script = "() => Boolean(window.__viserMutable?.cameraControl && window.frameElement.matches('.ready'))"

        def frame_with_camera() -> Frame | None:
            frames = [frame for frame in self.page.frames if "/viser/" in frame.url]
            return frames[0] if frames and frames[0].evaluate(script) else None

        return self.eventually(frame_with_camera, "the scene does not come")

    def eventually(self, check: Callable[[], Any], why: str) -> Any:
        """Return the result of `check` as soon as it is true; a frame may not be ready to answer yet."""
        late, last = time.monotonic() + SECONDS, None
        while time.monotonic() < late:
            try:
                if last := check():
                    return last
            except Error as error:
                last = error
            # Not time.sleep: playwright learns of new frames only while it is asked something.
            self.page.wait_for_timeout(20)
        raise AssertionError(f"{why}, after {SECONDS} s; the last look: {last!r}; {self._seen()}")

    def slider(self, name: str):
        return self.page.locator(SLIDER.format(name))

    def field(self, name: str):
        return self.page.locator(FIELD.format(name))

    def type_value(self, name: str, text: str) -> None:
        self.field(name).fill(text)
        self.field(name).press("Enter")

    def drag(self, name: str, by: float) -> None:
        """Press the slider's thumb and move it without releasing it."""
        slider = self.slider(name)
        box = slider.bounding_box()
        assert box is not None
        place = slider.evaluate("(input) => input.valueAsNumber / input.max")
        x, y = box["x"] + 7 + place * (box["width"] - 14), box["y"] + box["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        for k in range(1, 11):
            self.page.mouse.move(x + by * k / 10, y)

    def choose_recording(self, label: str) -> None:
        self.page.locator(".recording").click()
        self.page.get_by_role("menuitemradio", name=label, exact=True).click()

    def upload(self, *files: Path) -> None:
        with self.page.expect_file_chooser() as chooser:
            self.page.locator(".recording").click()
            self.page.get_by_role("menuitem", name=re.compile("Open file")).click()
        chooser.value.set_files(list(files))

    def drop(self, name: str, content: str) -> None:
        script = """([name, content]) => {
            const data = new DataTransfer();
            data.items.add(new File([content], name));
            for (const kind of ["dragenter", "dragover", "drop"])
                document.body.dispatchEvent(
                    new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
        }"""
        self.page.evaluate(script, [name, content])


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    # The first has no window of its own to draw, which takes a fifth less time.
    names = "chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"
    chromium = next(filter(None, map(shutil.which, names)), None)
    if chromium is None:
        pytest.skip("apt-get install chromium-headless-shell")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=list(FLAGS), timeout=1000 * SECONDS)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Address]:
    with serving(Settings(data_folder=tmp_path_factory.mktemp("recent"))) as address:
        yield address


class Profile:
    """A browser profile, and the tab that the tests of a file share, since opening one takes seconds."""

    def __init__(self, browser: Browser) -> None:
        self.context = browser.new_context(viewport=VIEWPORT, accept_downloads=True)
        self.context.set_default_timeout(1000 * SECONDS)
        self.context.add_init_script(UNPAINTED)
        self._shared: Tab | None = None

    def lend(self, address: str, hash: str) -> Tab:
        """The shared tab, where this link is opened; a new one, if there is none."""
        shared, self._shared = self._shared, None
        if shared is None:
            return Tab(self.context.new_page(), address).open(hash)
        return shared.look_at(hash)

    def take_back(self, tabs: Sequence[Tab], share: bool) -> None:
        """Close these tabs; with share, the next test gets the first."""
        if share and tabs:
            self._shared, *tabs = tabs
        for tab in tabs:
            tab.page.close()


@pytest.fixture(scope="module")
def profile(browser: Browser) -> Iterator[Profile]:
    profile = Profile(browser)
    yield profile
    profile.context.close()


@pytest.fixture
def new_tab(profile: Profile, address: Address, request: pytest.FixtureRequest) -> Iterator[Callable[..., Tab]]:
    """Open tabs of one browser profile; at the end none may have reported an error.

    The first is shared with other tests, unless the mark `own_tab` says that this one needs a fresh tab or leaves
    behind what a link does not set back.
    """
    tabs: list[Tab] = []
    failed = request.session.testsfailed
    own = request.node.get_closest_marker("own_tab") is not None
    usual = f"{address.http}/"

    def open_tab(hash: str = "", at: str = usual) -> Tab:
        lent = not own and not tabs and at == usual
        tabs.append(profile.lend(at, hash) if lent else Tab(profile.context.new_page(), at).open(hash))
        return tabs[-1]

    yield open_tab
    complaints = [complaint for tab in tabs for complaint in tab.complaints]
    sound = not complaints and request.session.testsfailed == failed
    profile.take_back(tabs, sound and not own and tabs[:1] != [] and tabs[0].address == usual)
    assert complaints == []


@pytest.fixture
def tab(new_tab: Callable[..., Tab]) -> Tab:
    return new_tab()


class KillableServer:
    """A server in its own process, on a fixed port."""

    def __init__(self, folder: Path, port: int) -> None:
        self.port = port
        self._folder = folder
        self._process: subprocess.Popen[str] | None = None

    @property
    def http(self) -> str:
        return f"http://127.0.0.1:{self.port}/"

    def start(self) -> None:
        command = [sys.executable, "-m", "lineseg_app", "view", "--no-browser", "--port", str(self.port)]
        environment = {**os.environ, "XDG_DATA_HOME": str(self._folder), "XDG_STATE_HOME": str(self._folder)}
        self._process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
        eventually(self._answers, "the server to start", self._process.poll)

    def _answers(self) -> bool:
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", self.port)) == 0

    def kill(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.wait()


@pytest.fixture
def killable_server(tmp_path: Path) -> Iterator[KillableServer]:
    with held_port() as port:
        server = KillableServer(tmp_path, port)
        server.start()
        yield server
        server.kill()
