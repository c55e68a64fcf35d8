"""rerun's web viewer, taken from the installed package."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from pathlib import Path

import rerun_cli

from lineseg.installation import install_command

FILES = ("re_viewer.js", "re_viewer_bg.wasm")
START_SECONDS = 30.0


def executable() -> Path:
    """rerun's own program, as it was installed with the SDK."""
    given = os.environ.get("RERUN_CLI_PATH")
    folder = Path(rerun_cli.__file__).parent
    places = (
        [Path(given)] if given else [folder / "rerun", folder / "rerun.exe", folder / "Rerun.app/Contents/MacOS/Rerun"]
    )
    for place in places:
        if place.is_file():
            return place
    raise FileNotFoundError(f"{places[0]}: rerun's program is missing; `{install_command('rerun')}` installs it")


def quiet_environment(folder: Path) -> dict[str, str]:
    """An environment in which rerun's program sends no usage data; its settings are kept in `folder`.

    macOS and Windows do not follow XDG, so the user's own settings apply there: `rerun analytics disable`.
    """
    places = {"XDG_CONFIG_HOME": str(folder), "XDG_DATA_HOME": str(folder)}
    environment = {**os.environ, **places, "TELEMETRY_ENABLED": "false"}
    if sys.platform == "linux":
        subprocess.run([executable(), "analytics", "disable"], env=environment, capture_output=True, check=True)
    return environment


def unpack(folder: Path) -> None:
    """Write FILES to `folder`.

    The files are inside rerun's program, which only serves them over HTTP, so it runs briefly on the loopback.
    """
    port, other = free_ports(2)
    flags = ["--serve-web", "--bind", "127.0.0.1", "--web-viewer-port", str(port), "--port", str(other)]
    with tempfile.TemporaryDirectory() as private:
        environment = quiet_environment(Path(private))
        silent = subprocess.DEVNULL
        with subprocess.Popen([executable(), *flags], env=environment, stdout=silent, stderr=silent) as program:
            try:
                for name in FILES:
                    _fetch(f"http://127.0.0.1:{port}/{name}", folder / name, program)
            finally:
                program.kill()


def _fetch(address: str, file: Path, program: subprocess.Popen) -> None:
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    late = time.monotonic() + START_SECONDS
    while True:
        try:
            with opener.open(address, timeout=START_SECONDS) as answer, file.open("wb") as out:
                shutil.copyfileobj(answer, out)
            return
        except urllib.error.URLError as error:
            if program.poll() is not None or time.monotonic() > late:
                raise OSError(f"rerun's program does not serve its web viewer: {error.reason}") from None
            time.sleep(0.05)


def free_ports(number: int) -> list[int]:
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(number)]
    ports = [opened.getsockname()[1] for opened in sockets]
    for opened in sockets:
        opened.close()
    return ports
