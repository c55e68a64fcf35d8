"""The command that installs optional packages, as needed for the way this program was installed."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tomllib
from importlib.metadata import Distribution
from importlib.util import find_spec
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

# On PyPI `lineseg` is another project; here it is only the import name and the command.
DISTRIBUTION = "laser-lineseg"


def install_command(extra: str) -> str:
    """The shell command that installs what an extra brings (`rerun`, `tune`, …) where this program runs.

    pipx and uv keep a tool in an environment of its own, and only they can add to it. A checkout set up by `make` pins
    its own versions. A system Python accepts no packages.
    """
    wanted = f"{DISTRIBUTION}[{extra}]"
    prefix = Path(sys.prefix)
    if (prefix / "pipx_metadata.json").is_file():
        return _line("pipx", "inject", DISTRIBUTION, wanted)
    if (prefix / "uv-receipt.toml").is_file():
        # uv removes extras that are not listed again.
        extras = sorted({extra, *_extras_of_uv(prefix / "uv-receipt.toml")})
        return _line("uv", "tool", "install", f"{DISTRIBUTION}[{','.join(extras)}]")
    folder = _checkout()
    if folder and (folder / ".venv").resolve() == prefix.resolve():
        return _line("make", "-C", str(folder), "install", f"EXTRAS={extra}")
    if sys.prefix == sys.base_prefix and _belongs_to_the_system():
        return _line("pipx", "install", wanted)
    what = ["-e", f"{folder}[{extra}]"] if folder else [wanted]
    if find_spec("pip") is None:
        return _line("uv", "pip", "install", "--python", sys.executable, *what)
    return _line(*_pip(), "install", *what)


def _extras_of_uv(receipt: Path) -> list[str]:
    tool = tomllib.loads(receipt.read_text())["tool"]
    return [extra for each in tool["requirements"] if each["name"] == DISTRIBUTION for extra in each.get("extras", [])]


def _checkout() -> Path | None:
    """The working copy that an editable installation runs from."""
    # A build leaves metadata in the checkout itself, which says nothing of how it was installed.
    texts = (found.read_text("direct_url.json") for found in Distribution.discover(name=DISTRIBUTION))
    origin = json.loads(next(filter(None, texts), "{}"))
    if not origin.get("dir_info", {}).get("editable"):
        return None
    return Path(url2pathname(urlsplit(origin["url"]).path))


def _belongs_to_the_system() -> bool:
    """Whether pip refuses to install here (PEP 668)."""
    return (Path(sysconfig.get_path("stdlib")) / "EXTERNALLY-MANAGED").is_file()


def _pip() -> list[str]:
    """The command for this environment's pip; just `pip` if the shell finds that one."""
    found = shutil.which("pip")
    active = found is not None and Path(found).parent == Path(sys.executable).parent
    return ["pip"] if active else [sys.executable, "-m", "pip"]


def _line(*words: str) -> str:
    return subprocess.list2cmdline(words) if os.name == "nt" else shlex.join(words)
