"""`python -m lineseg.simulate [folder]` writes the samples, by default into the repository's sample_scans."""

from __future__ import annotations

import argparse
from pathlib import Path

from .samples import write_samples


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m lineseg.simulate", description="Write the simulated samples.")
    here = Path(__file__).resolve().parents[2] / "sample_scans"
    parser.add_argument("folder", nargs="?", type=Path, default=here, help=f"where to (default: {here})")
    folder = parser.parse_args().folder
    write_samples(folder)
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    for path in files:
        print(f"{path.stat().st_size / 1000:9.1f} kB  {path.relative_to(folder)}")
    print(f"{sum(path.stat().st_size for path in files) / 1e6:9.2f} MB in {folder}")


if __name__ == "__main__":
    main()
