"""One file of each kind that people have, opened in one tab one after the other, following the advice that is given."""

from __future__ import annotations

import os
from base64 import b64encode
from pathlib import Path
from typing import NamedTuple

import pytest

CASES = Path(os.environ.get("LINESEG_DATA", "/nowhere")).parent / "cases"


class Kind(NamedTuple):
    """files: a glob. scans, walls: how many there are in the end; walls are at least 1.5 m long.

    says: words over the scene; press: the button that is offered.
    """

    files: str
    scans: int
    walls: int
    says: str = ""
    press: str = ""


KINDS = [
    Kind("angles_in_degrees/run.bag", 5, 3, "Are the angles in degrees?", "Set unit of angles: deg"),
    Kind("bag_in_a_folder/*/*", 5, 3),
    Kind("bagpy_csv/scan.csv", 4, 4),
    Kind("carmen_flaser_1081/run.log", 2, 3, "Guessed, because the file does not say it: −135…135°."),
    Kind("carmen_rawlaser/run.log", 3, 3),
    Kind("decimal_comma/columns.csv", 1, 3, "radians, counter-clockwise, metres"),
    Kind("echo_yaml/ros2_topic_echo.yaml", 4, 4),
    Kind("first_topic_without_messages/bag/*", 5, 3, "/scan has no scans, so /scan_filtered is shown."),
    Kind("foxglove_mcap/protobuf_foxglove_laserscan.mcap", 5, 3),
    Kind("gmapping_gfs/run.gfs", 3, 3),
    Kind("half_circle_scans_in_columns/scans.csv", 3, 3, "radians"),
    Kind("header_names_with_blanks/units.csv", 1, 4, "counter-clockwise"),
    Kind("json_lines/pairs.json", 1, 4, "columns angle distance"),
    Kind("layers_on_one_topic/bag/*", 5, 4, "world_1_0 is shown; show another?", "Set frame_id: world_1_1"),
    Kind("leading_timestamp/laser.txt", 3, 3, "1 leading column"),
    Kind("lrse_dataset/laser.txt", 3, 3, "column 1 as seconds"),
    Kind("matrix_with_angle_row/scan_dist.csv", 4, 2, "column 1 as seconds"),
    Kind("mcap_of_ros1/converted.mcap", 5, 3),
    Kind("mcap_without_its_end/run.mcap", 4, 3, "read up to there"),
    Kind("millimetres_in_laserscan/run.bag", 5, 3, "Are they in millimetres?", "Set unit of ranges: mm"),
    Kind("multi_echo/echoes.bag", 5, 3),
    Kind("numpy_files/scans.npy", 5, 3, "metres"),
    Kind("one_scan_with_one_beam/run.bag", 4, 3, "1 scan was skipped"),
    Kind("player_log/run.log", 3, 3),
    Kind("plotjuggler_csv/scan.csv", 4, 4),
    Kind("quarter_millimetres/lidar.csv", 1, 4, "millimetres"),
    Kind("range_max_for_no_return/slightly_below.csv", 5, 2, "Does this value mean no return?", "Set no return: 9.99"),
    Kind("range_min_too_large/run.bag", 5, 3, "nearer than range_min = 5 m", "Set range_min: 0"),
    Kind("ros2_echo_csv/scan.csv", 4, 4),
    Kind("rosbag_to_csv/scan.csv", 4, 4),
    Kind("rows_in_brackets/python_lists.txt", 3, 3, "−120…120°"),
    Kind("rplidar_three_columns/ultra_simple_stdout.txt", 1, 4, "millimetres"),
    Kind("split_bag_dropped/run/*", 5, 3),
    Kind("stamp_columns/scan.csv", 4, 4),
    Kind("utf16/excel_unicode.txt", 1, 3, "radians"),
    Kind("varying_rows/rows.csv", 3, 3, "Rows have 239 to 241 ranges"),
    Kind("xy_points/room.xy", 1, 4, "columns x y"),
    Kind("zipped_bag/2020-09-25.zip", 5, 3),
]


DROP = """(files) => {
    const data = new DataTransfer();
    for (const [name, content] of files)
        data.items.add(new File([Uint8Array.from(atob(content), (char) => char.charCodeAt(0))], name));
    const event = new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true });
    document.body.dispatchEvent(event);
}"""


def drop(tab, files: list[Path]) -> None:
    """Faster than a file chooser, which waits for the menu to be drawn."""
    tab.page.evaluate(DROP, [[file.name, b64encode(file.read_bytes()).decode()] for file in files])


@pytest.mark.skipif(not CASES.is_dir(), reason="set LINESEG_DATA to a folder that has the folder cases beside it")
def test_each_kind_of_file_opens_in_the_page_and_its_advice_leads_to_the_room(new_tab):
    tab = new_tab()
    card = tab.page.get_by_label("What this file was taken for")
    for kind in KINDS:
        before = tab.state["place"]
        drop(tab, sorted(CASES.glob(kind.files)))
        tab.until(f"s.place !== {before!r} && s.label !== 'hallway'")
        said = card.inner_text() if card.is_visible() else ""
        assert kind.says in said, kind.files
        if kind.press:
            card.get_by_role("button", name=kind.press).click()
            tab.until("Object.keys(s.readAs).length > 0")
            assert not card.get_by_role("button", name=kind.press).is_visible()
        state = tab.state
        walls = [segment for segment in state["segments"] if segment["length"] >= 1.5]
        assert (state["frames"], len(walls)) == (kind.scans, kind.walls), kind.files
        assert not tab.page.locator(".notice.error").is_visible(), kind.files

    # Lasers that share a topic are a list.
    drop(tab, sorted(CASES.glob("layers_on_one_topic/bag/*")))
    tab.until("s.frameId === 'world_1_0'")
    tab.page.get_by_role("button", name="Change…").click()
    panel = tab.page.get_by_role("dialog")
    lasers = panel.locator("[data-field=frame_id] select")
    panel.get_by_text("as found: world_1_0").wait_for(state="attached")
    assert lasers.locator("option").all_inner_texts()[1:] == ["world_1_0", "world_1_1", "world_1_2"]
    lasers.select_option("world_1_2")
    panel.get_by_role("button", name="Apply").click()
    tab.until("s.frameId === 'world_1_2'")
