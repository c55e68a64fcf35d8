"""Compiled kernels are found by the content that they were compiled from."""

import os
import re
import subprocess
import time
from pathlib import Path

import pytest
from fresh import called_in
from fresh import programs as fresh_programs

from lineseg.kernel.kept import folder, forget_the_unused

CALLED = """
from lineseg.kernel import kernel

@kernel
def called(x):
    return x + 1
"""
ENTRY = """
from lineseg.kernel import entry_kernel
from called import called

@entry_kernel
def entry(x):
    return called(x)

if __name__ == "entry":
    results = entry(1), entry(0.5)
    loaded, compiled = (sum(counted.values()) for counted in (entry.stats.cache_hits, entry.stats.cache_misses))
    said = f"{results[0]} {results[1]} {loaded} loaded {compiled} compiled"
"""


@pytest.fixture
def programs(tmp_path: Path) -> Path:
    """A folder with a kernel in one file, which calls a kernel in another."""
    (tmp_path / "called.py").write_text(CALLED)
    (tmp_path / "entry.py").write_text(ENTRY)
    return tmp_path


def run(programs: Path, kept: str = "kept") -> str:
    """Call the kernel with an integer and with a number, in a program of its own."""
    return together(1, programs, kept)[0]


def together(number: int, programs: Path, kept: str = "kept") -> list[str]:
    """The same in several programs that start at the same time."""
    with fresh_programs(number) as started:
        return list(started.map(called_in, [programs] * number, [programs / kept] * number))


def test_only_a_change_of_a_kernel_is_compiled_and_what_was_before_is_kept(programs):
    assert run(programs) == "2 1.5 0 loaded 2 compiled"
    for file in programs.glob("*.py"):
        file.write_text("# Nothing that counts.\n" + file.read_text() + "\ndef other():\n    return 1\n")
    assert run(programs) == "2 1.5 2 loaded 0 compiled"
    (programs / "called.py").write_text(CALLED.replace("x + 1", "x + 2"))
    assert run(programs) == "3 2.5 0 loaded 2 compiled"
    (programs / "called.py").write_text(CALLED)
    assert run(programs) == "2 1.5 2 loaded 0 compiled"


def test_programs_that_start_together_compile_each_kernel_once(programs):
    compiled = 0
    for said in together(3, programs):
        told = re.fullmatch(r"2 1\.5 \d loaded (\d) compiled", said)
        assert told
        compiled += int(told[1])
    assert compiled == 2
    assert run(programs) == "2 1.5 2 loaded 0 compiled"
    assert len(list((programs / "kept" / "lineseg").iterdir())) == 2


def test_a_file_cut_short_is_compiled_again(programs):
    run(programs)
    for file in (programs / "kept" / "lineseg").iterdir():
        file.write_bytes(file.read_bytes()[:100])
    assert run(programs) == "2 1.5 0 loaded 2 compiled"
    assert run(programs) == "2 1.5 2 loaded 0 compiled"


def test_without_a_place_to_write_each_program_compiles_for_itself(programs):
    (programs / "file").write_text("")
    assert run(programs, "file") == run(programs, "file") == "2 1.5 0 loaded 2 compiled"


def test_kernels_are_kept_in_the_cache_of_the_user_unless_numba_has_another_folder(monkeypatch):
    monkeypatch.setattr("numba.config.CACHE_DIR", "")
    assert folder().parts[-2:] == ("lineseg", "kernels")
    monkeypatch.setattr("numba.config.CACHE_DIR", "/elsewhere")
    assert folder() == Path("/elsewhere/lineseg")


def test_kernels_not_loaded_for_months_are_deleted(tmp_path):
    used, unused = tmp_path / "used.pickle", tmp_path / "unused.pickle"
    for file, days in ((used, 59), (unused, 61)):
        file.write_bytes(b"")
        os.utime(file, (time.time() - days * 86400,) * 2)
    forget_the_unused(tmp_path)
    assert used.exists()
    assert not unused.exists()


def test_a_full_disk_leaves_no_part_of_a_kernel(programs: Path):
    disk = programs / "kept"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8k", "tmpfs", disk], capture_output=True).returncode:
        pytest.skip("mounting a small disk needs root")
    try:
        assert run(programs) == "2 1.5 0 loaded 2 compiled"
        assert not [path for path in disk.rglob("*") if path.is_file() and path.suffix not in (".lock", ".kernel")]
    finally:
        subprocess.run(["umount", "-l", disk], check=True)
