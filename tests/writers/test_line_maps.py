"""Line maps in files, read back by the programs that they are for."""

import json
import sys
import xml.etree.ElementTree as Tree

import numpy as np
import pytest
from lineseg_app.__main__ import main

from lineseg import open_recording, save_npz
from lineseg.line_map import LineMap, line_map
from lineseg.line_map.posed import PoseNoise
from lineseg.writers.line_maps import write_map

ENDS = np.array([(0.0, 0.0, 4.0, 0.0), (4.0, 0.0, 4.0, -3.0)])
COVARIANCE = np.array([np.diag((1e-4, 1e-6)), np.diag((4e-4, 1e-6))])
MAP = LineMap(ENDS, COVARIANCE, np.array((0.01, 0.02)), np.array((7, 3)), 20, 0.06, 0.9, PoseNoise(0.02, 0.01))


@pytest.fixture
def written(tmp_path):
    def write(suffix):
        write_map(MAP, tmp_path / f"map.{suffix}", "a < b", {"file": "drive.log"})
        return tmp_path / f"map.{suffix}"

    return write


def test_geojson_has_each_line_with_its_covariance(written):
    content = json.loads(written("geojson").read_text())
    assert [each["geometry"]["coordinates"] for each in content["features"]] == ENDS.reshape(-1, 2, 2).tolist()
    line = content["features"][1]["properties"]
    assert (line["length"], line["sigma"], line["seen"], line["rho"], line["theta"]) == (3, 0.02, 3, -4, np.pi)
    assert line["covariance"] == COVARIANCE[1].tolist()
    assert content["about"]["file"] == "drive.log"
    assert "not degrees" in content["coordinates"]


def test_svg_draws_each_line_in_its_place(written):
    root = Tree.parse(written("svg")).getroot()
    lines = root.findall(".//{*}line")
    assert [line[0].text for line in lines] == ["4.00 m, ±10 mm", "3.00 m, ±20 mm"]
    (x1, y1, x2, _), (_, top, _, bottom) = (
        [float(line.attrib[name]) for name in ("x1", "y1", "x2", "y2")] for line in lines
    )
    assert (x2 - x1) / 4 == pytest.approx((bottom - top) / 3, rel=1e-3)
    assert y1 == top


def test_dxf_has_each_line_in_metres(written):
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.readfile(written("dxf"))
    assert drawing.units == 6
    assert not drawing.audit().errors
    lines = [[*line.dxf.start.vec2, *line.dxf.end.vec2] for line in drawing.modelspace().query("LINE")]
    assert np.allclose(lines, ENDS)


def test_npz_has_the_arrays(written):
    with np.load(written("npz"), allow_pickle=False) as arrays:
        assert np.array_equal(arrays["ends"], ENDS)
        assert np.array_equal(arrays["covariance"], COVARIANCE)
        assert json.loads(str(arrays["about"])) == {"file": "drive.log"}


def test_the_command_writes_the_map_and_says_how_much_it_holds(tmp_path, capsys, sample):
    assert main(["map", str(sample), "-o", str(tmp_path / "map.geojson")]) == 0
    found = line_map(open_recording(sample))
    assert capsys.readouterr().out == f"{found.text}\n"
    assert len(json.loads((tmp_path / "map.geojson").read_text())["features"]) == len(found) > 10


@pytest.fixture
def sample(tmp_path, hallway):
    file = tmp_path / "hallway.npz"
    save_npz(hallway.only(np.arange(0, len(hallway), 10)), file)
    return file


@pytest.fixture(scope="module")
def hallway():
    from lineseg_app.places import data_folder

    return open_recording(data_folder("sample_scans") / "hallway.npz")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("map.png", "map.png: use a name that ends in .geojson, .svg, .dxf, .npz"),
        ("missing/map.svg", "the folder .* does not exist"),
    ],
)
def test_files_that_cannot_be_written_are_told_before_the_work(tmp_path, capsys, name, sentence):
    import re

    assert main(["map", "nothing.log", "-o", str(tmp_path / name)]) == 2
    assert re.search(sentence, capsys.readouterr().err)


def test_without_ezdxf_it_says_how_to_get_it(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    monkeypatch.setitem(sys.modules, "ezdxf.filemanagement", None)
    assert main(["map", "nothing.log", "-o", str(tmp_path / "map.dxf")]) == 2
    said = capsys.readouterr().err
    assert "a DXF drawing needs ezdxf" in said
    assert "dxf" in said.split("`")[1]
