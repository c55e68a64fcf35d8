"""The advice to install, in environments made like those of pip, pipx, uv and make."""

import json
import os
import re
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

from waiting import SECONDS

ROOT = Path(__file__).parents[1]
SAY = f"import runpy; print(runpy.run_path({str(ROOT / 'lineseg/installation.py')!r})['install_command']('rerun'))"


def said_by(python: Path | str, **environment: str) -> str:
    """The advice that this Python gives."""
    done = subprocess.run(
        [python, "-c", SAY],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=True,
        timeout=SECONDS,
    )
    return done.stdout.strip()


def environment_in(folder: Path, pip: bool = True) -> Path:
    """The Python of a new virtual environment; it needs only a package called pip."""
    venv.create(folder, symlinks=True)
    if pip:
        (packages_of(folder) / "pip").mkdir()
        (packages_of(folder) / "pip" / "__init__.py").touch()
    return folder / "bin" / "python"


def packages_of(folder: Path) -> Path:
    return Path(sysconfig.get_path("purelib", vars={"base": str(folder)}))


def install_editable(environment: Path, checkout: Path) -> None:
    about = packages_of(environment) / "laser_lineseg-0.1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.4\nName: laser-lineseg\nVersion: 0.1.0\n")
    (about / "direct_url.json").write_text(json.dumps({"url": checkout.as_uri(), "dir_info": {"editable": True}}))


def test_in_an_environment_it_is_the_pip_that_belongs_to_it(tmp_path: Path):
    python = environment_in(tmp_path)
    assert said_by(python) == f"{python} -m pip install 'laser-lineseg[rerun]'"


def test_in_an_activated_environment_pip_needs_no_path(tmp_path: Path):
    python = environment_in(tmp_path)
    (tmp_path / "bin" / "pip").touch(0o755)
    path = os.pathsep.join((str(tmp_path / "bin"), os.environ["PATH"]))
    assert said_by(python, PATH=path) == "pip install 'laser-lineseg[rerun]'"


def test_an_environment_without_pip_is_one_of_uv(tmp_path: Path):
    python = environment_in(tmp_path, pip=False)
    assert said_by(python) == f"uv pip install --python {python} 'laser-lineseg[rerun]'"


def test_pipx_adds_to_its_own_environment(tmp_path: Path):
    python = environment_in(tmp_path)
    (tmp_path / "pipx_metadata.json").write_text("{}")
    assert said_by(python) == "pipx inject laser-lineseg 'laser-lineseg[rerun]'"


def test_a_tool_of_uv_keeps_the_extras_that_it_has(tmp_path: Path):
    python = environment_in(tmp_path, pip=False)
    receipt = '[tool]\nrequirements = [{ name = "laser-lineseg", extras = ["plot"] }, { name = "numpy" }]\n'
    (tmp_path / "uv-receipt.toml").write_text(receipt)
    assert said_by(python) == "uv tool install 'laser-lineseg[plot,rerun]'"


def test_a_checkout_that_make_set_up_is_left_to_make(tmp_path: Path):
    python = environment_in(tmp_path / ".venv")
    install_editable(tmp_path / ".venv", tmp_path)
    assert said_by(python) == f"make -C {tmp_path} install EXTRAS=rerun"


def test_a_checkout_in_another_environment_stays_a_checkout(tmp_path: Path):
    checkout = tmp_path / "my checkout"
    python = environment_in(tmp_path / "env")
    install_editable(tmp_path / "env", checkout)
    assert said_by(python) == f"{python} -m pip install -e '{checkout}[rerun]'"


def test_metadata_that_a_build_left_in_the_folder_is_no_way_of_installing(tmp_path: Path):
    python = environment_in(tmp_path / ".venv")
    install_editable(tmp_path / ".venv", tmp_path)
    left = tmp_path / "laser_lineseg.egg-info"
    left.mkdir()
    (left / "PKG-INFO").write_text("Metadata-Version: 2.4\nName: laser-lineseg\nVersion: 0.1.0\n")
    done = subprocess.run(
        [python, "-c", SAY], cwd=tmp_path, capture_output=True, text=True, check=True, timeout=SECONDS
    )
    assert done.stdout.strip() == f"make -C {tmp_path} install EXTRAS=rerun"


def test_a_python_of_the_system_takes_no_packages():
    script = "import sysconfig; print(sysconfig.get_path('stdlib'))"
    base = sys._base_executable
    library = subprocess.run([base, "-c", script], capture_output=True, text=True, check=True).stdout.strip()
    managed = (Path(library) / "EXTERNALLY-MANAGED").is_file()
    assert said_by(base).startswith("pipx install" if managed else ("pip install", f"{base} -m pip install"))


def test_nothing_advises_to_install_the_other_project_of_this_name():
    tracked = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    wrong = re.compile(r"install\s+(-\S+\s+)*['\"]?lineseg\b(?!\.)|(?<![\w-])lineseg\[[a-z,]+\]")
    texts = [ROOT / name for name in tracked if name.endswith((".py", ".js", ".md", ".html", ".toml", ".cff"))]
    found = [f"{path}: {match[0]}" for path in texts for match in wrong.finditer(path.read_text())]
    assert [line for line in found if __file__ not in line] == []
