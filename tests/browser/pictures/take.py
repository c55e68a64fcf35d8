"""Takes the pictures of the README from the real page: python tests/browser/pictures/take.py"""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path

from lineseg_app.server import Settings
from playwright.sync_api import sync_playwright

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE.parent), str(HERE.parents[1])]

from conftest import FLAGS, Tab  # noqa: E402
from live import serving  # noqa: E402

PICTURES = {
    "tune": "#recording=sample:hallway&frame=150",
    "learn": "#mode=learn&recording=lesson:2_grazing_wall&step=33",
    "inspect": "#mode=inspect&score=suspicion&recording=sample:laboratory&frame=223&beam=275",
}

if __name__ == "__main__":
    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Settings(data_folder=Path(folder))) as server,
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=list(FLAGS))
        for name, link in PICTURES.items():
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            tab = Tab(page, f"{server.http}/").open(link)
            assert tab.scene
            page.wait_for_timeout(15000)
            page.screenshot(path=HERE / f"{name}.png")
            page.close()
