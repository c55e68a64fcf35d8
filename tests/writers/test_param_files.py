import json
import subprocess
import sys
from dataclasses import asdict
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ruamel.yaml import YAML

from lineseg import EXTRACTORS, Params, __version__
from lineseg.writers import PARAMS_WRITERS, params_text, read_params


def thresholds():
    def values(kind, knob):
        most = min(knob.most, 1e6)
        return st.integers(int(knob.least), int(most)) if kind is int else st.floats(knob.least, most)

    return st.builds(Params, **{name: values(kind, knob) for name, kind, knob in Params.knobs()})


@given(thresholds(), st.sampled_from(list(PARAMS_WRITERS)))
def test_written_segments_are_read_back(params, format):
    assert read_params(params_text(params, format)) == params


@given(thresholds())
def test_json_is_read_back(params):
    assert read_params(json.dumps(asdict(params))) == params
    assert read_params(json.dumps({"rev": 3, "params": asdict(params)})) == params


@given(thresholds())
def test_python_text_makes_the_same_thresholds(params):
    names = {}
    exec(params_text(params, "python"), names)
    assert names["params"] == params


def test_a_launch_file_has_the_names_of_the_authors_program():
    launch = ElementTree.fromstring(params_text(Params(), "ros1"))
    found = {each.get("name"): each.get("value") for each in launch.iter("param")}
    assert [*found][:5] == [
        "least_thresh",
        "predict_distance",
        "seed_line_points",
        "min_line_points",
        "min_line_length",
    ]
    assert (found["least_thresh"], found["seed_line_points"], found["max_dropout"]) == (
        "0.03",
        "6",
        str(Params().max_dropout),
    )


def test_parameters_of_ros_2_keep_their_types():
    tree = YAML(typ="safe").load(params_text(Params(epsilon=1e-5, max_gap=30.0), "ros2"))
    found = tree["/**"]["ros__parameters"]
    assert (found["least_thresh"], found["max_gap"]) == (1e-5, 30.0)
    assert {name: type(value) for name, value in found.items() if "points" in name} == {
        "seed_line_points": int,
        "min_line_points": int,
    }


@pytest.mark.parametrize("method", EXTRACTORS.values(), ids=list(EXTRACTORS))
def test_a_file_for_a_node_says_what_it_is_for_and_is_read_back(method):
    params = method.params_type(min_points=17)
    text = params_text(params, "ros2", "the\nhall.bag --topic /scan")
    first, second, *_ = text.splitlines()
    assert first == f"# Thresholds of {method.name} by lineseg {__version__}, set for the hall.bag --topic /scan."
    assert (f"--method {method.name} " in second) == (method.name != "region-growing")
    assert read_params(text, method.params_type) == params


def test_extensions_are_marked_where_the_format_has_comments():
    for format in ("ros1", "ros2"):
        marked = [line for line in params_text(Params(), format).splitlines() if "extension" in line]
        assert [name for name in ("max_dropout", "max_gap", "merge_angle") if any(name in line for line in marked)]
        assert len(marked) == sum(knob.extension for _, _, knob in Params.knobs())


def test_written_flags_are_flags_of_the_command_line():
    flags = params_text(Params(epsilon=0.05), "flags").split()
    again = subprocess.run(
        [sys.executable, "-m", "lineseg_app", "params", "--to", "flags", *flags],
        capture_output=True,
        text=True,
        check=True,
    )
    assert again.stdout.split() == flags


def test_a_node_file_with_other_settings_is_read():
    launch = """<?xml version="1.0"?>
    <launch><node pkg="line" type="line" name="line" output="screen">
        <param name="frame_id" value="laser"/> <param name="show_lines" value="true"/>
        <param name="~least_thresh" value="0.04"/> <param name="/line/min_line_points" value="12"/>
    </node></launch>"""
    assert read_params(launch.replace("~", "")) == Params(epsilon=0.04, min_points=12)
    yaml = "line_node:\n  ros__parameters:\n    use_sim_time: false\n    scan_topic: /scan\n    epsilon: 0.04\n"
    assert read_params(yaml) == Params(epsilon=0.04)


def test_plain_yaml_without_a_node_is_read():
    assert read_params("least_thresh: 0.04\nmin_points: 12\n") == Params(epsilon=0.04, min_points=12)


def test_python_is_read_without_being_run():
    text = "import lineseg\nraise SystemExit\nmine = lineseg.Params(\n    epsilon=0.04,\n    min_points=12,\n)\n"
    assert read_params(text) == Params(epsilon=0.04, min_points=12)


def test_a_whole_command_line_is_read():
    text = "lineseg extract corridor.bag --topic /scan \\\n  --epsilon=0.04 --min-points 12 -o out.jsonl"
    assert read_params(text) == Params(epsilon=0.04, min_points=12)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "the text is empty"),
        ('{"epsilonn": 1}', "line 1: there is no threshold 'epsilonn'; choose from least_thresh"),
        ('{\n"epsilon": true}', "line 2: epsilon is True, which is not a number"),
        ('{"epsilon": ', "line 1: this is not JSON"),
        (
            "/**:\n  ros__parameters:\n    least_thresh: wide\n",
            r"line 3: epsilon is 'wide', .* \(written least_thresh\)",
        ),
        ("/**:\n  ros__parameters:\n    seed_points: 2\n", "line 3: seed_points is 2; a seed needs 3 or more points"),
        ("/**:\n  ros__parameters:\n    leest_thresh: 0.03\n", "line 3: there is no threshold 'leest_thresh'"),
        ("a: [1, 2", "line 1: this is not YAML"),
        ("a: &a {b: 1}\nc: *a\n", "line 2: aliases are not allowed"),
        ("a: 2020-13-45\nepsilon: 0.1\n", r"this is not YAML with thresholds: a value cannot be read \(month must be"),
        ('epsilon: !!int ""\n', "this is not YAML with thresholds: a value cannot be read"),
        ("<<: 3\nepsilon: 0.1\n", "line 1: this is not YAML: expected a mapping"),
        ("just words", "this is neither a launch file"),
        ("<launch>\n<param name='least_thresh'/>\n</launch>", "line 2: the param 'least_thresh' has no value"),
        (
            "<launch>\n<param name='min_line_points' value='2.5'/>\n</launch>",
            "line 2: min_points is 2.5, .* whole number",
        ),
        ("params = Params(\n    epsilon=wide,\n)", "line 2: epsilon is 'wide', which is not a number"),
        ("params = Params(epsilon=)", "line 1: this is not Python"),
        ("params = Params()", "there is no threshold in the text"),
        ("--epsilonn 0.03", "line 1: there is no threshold 'epsilonn'"),
        ("--delta 0.1\n--epsilon --min-points 3", "line 2: epsilon is '', which is not a number"),
        ("<launch>", "line 1: this is not a launch file"),
        ("<launch/>", "there is no threshold in the text"),
        ('<!DOCTYPE a [<!ENTITY b "c">]>\n<launch/>', "line 1: a document type is not allowed"),
        ("".join(f"k{number}: 1\n" for number in range(20_000)), "this YAML has 1[0-9]+ characters; .* at most 131072"),
        ("x" * (1 << 21), "the text has 2097152 characters"),
        ("[" * 100_000, "this is not YAML|line 1"),
        ('{"a":' * 100_000, "this is not JSON"),
    ],
)
def test_an_unreadable_line_is_named_with_its_number(text, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        read_params(text)


def test_an_unknown_format_lists_the_known_ones():
    with pytest.raises(ValueError, match="cannot be written as 'ros3'; choose from ros2, ros1, python, flags"):
        params_text(Params(), "ros3")
    assert set(PARAMS_WRITERS) == {"ros2", "ros1", "python", "flags"}
