"""rerun's web viewer, taken from the installed package."""

from __future__ import annotations

import mmap
import os
import subprocess
import sys
from pathlib import Path

import rerun_cli

from lineseg.installation import install_command

FILES = ("re_viewer.js", "re_viewer_bg.wasm")
SCRIPT_BEGIN, SCRIPT_END = b"let wasm_bindgen = (function(exports) {", b"})({ __proto__: null });\n"
LARGEST_SCRIPT = 4_000_000
WASM_BEGIN, LAST_SECTION = b"\0asm\x01\0\0\0", 13


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
    """Write FILES to `folder`. Raises OSError if they are not found in rerun's program.

    The program has both inside, one after the other and as they are. It would serve them over HTTP, but another program
    could take its port first, and what came from there would run as a script of this page.
    """
    program = executable()
    with program.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as content:
        begin = content.find(SCRIPT_BEGIN)
        module = content.find(WASM_BEGIN, begin)
        script = content[begin:module] if begin >= 0 and module - begin < LARGEST_SCRIPT else b""
        if not script.endswith(SCRIPT_END):
            raise OSError(f"{program}: its web viewer is not where it was in rerun 0.41; install rerun-sdk 0.41")
        (folder / FILES[0]).write_bytes(script)
        (folder / FILES[1]).write_bytes(content[module : _end_of_wasm(content, module)])


def _end_of_wasm(content: mmap.mmap, start: int) -> int:
    """Where a WebAssembly module ends: behind the last of its sections, each of which gives its length as LEB128."""
    place = start + len(WASM_BEGIN)
    while place < len(content) and content[place] <= LAST_SECTION:
        length, shift, place = 0, 0, place + 1
        while True:
            byte = content[place]
            length |= (byte & 0x7F) << shift
            shift, place = shift + 7, place + 1
            if byte < 0x80:
                break
        place += length
    return place
