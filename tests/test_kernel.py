"""Compiled kernels are forgotten when what they were compiled from has changed."""

import os
from pathlib import Path

from lineseg.kernel import drop_stale_kernels


def write(path: Path, age: float) -> Path:
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(b"")
    os.utime(path, (1e9 - age, 1e9 - age))
    return path


def test_a_changed_file_makes_what_was_compiled_before_stale(tmp_path):
    write(tmp_path / "entry.py", age=30)
    write(tmp_path / "inner" / "called.py", age=10)
    old = [write(tmp_path / "__pycache__" / f"entry.{ending}", age=20) for ending in ("nbi", "1.nbc")]
    new = [write(tmp_path / "inner" / f"called.{ending}", age=5) for ending in ("nbi", "1.nbc")]
    module = write(tmp_path / "__pycache__" / "entry.pyc", age=40)
    drop_stale_kernels(tmp_path)
    assert not any(file.exists() for file in old)
    assert all(file.exists() for file in [*new, module])
