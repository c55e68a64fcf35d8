"""Writes thresholds: for ROS 1 and 2 with the names of the authors' program, for Python, for the command line."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..extractors import method_of
from ..knobs import Knob, Thresholds
from ..params import Params
from .version import __version__

EXTENSION = "extension of lineseg; not in the authors' program"


def ros1_launch(params: Thresholds) -> str:
    """A launch file with the parameters in the namespace of the node, where the authors' program reads them."""
    lines = [
        "<launch>",
        "  <!-- Set the name of the line extraction node, or copy the parameters into its <node>. -->",
        '  <arg name="node" default="line_extraction"/>',
        '  <group ns="$(arg node)">',
    ]
    for name, value, knob in _ros_values(params):
        kind = {bool: "bool", int: "int", float: "double"}[type(value)]
        lines.append(
            f'    <param name="{knob.ros or name}" type="{kind}" value="{_yaml(value)}"/>{_note("<!-- {} -->", knob)}'
        )
    return "\n".join([*lines, "  </group>", "</launch>", ""])


def ros2_yaml(params: Thresholds, recording: str = "") -> str:
    """A parameter file for `lineseg node`, which any node can load; its comment says what it is for."""
    method = method_of(params)
    chosen = "" if type(params) is Params else f"--method {method.name} "
    made_for = f", set for {' '.join(recording.split())}" if recording.split() else ""
    lines = [
        f"# Thresholds of {method.name} by lineseg {__version__}{made_for}.",
        f"# To run them on a robot: lineseg node ros2:/scan {chosen}--params THIS_FILE",
        "/**:",
        "  ros__parameters:",
    ]
    lines += [f"    {knob.ros or name}: {_yaml(value)}{_note('# {}', knob)}" for name, value, knob in _values(params)]
    return "\n".join([*lines, ""])


def python(params: Thresholds) -> str:
    """Python source that creates these thresholds."""
    values = ",\n".join(f"    {name}={value!r}" for name, value, _ in _values(params))
    kind = type(params)
    module = "lineseg" if kind is Params else kind.__module__
    return f"from {module} import {kind.__name__}\n\nparams = {kind.__name__}(\n{values},\n)\n"


def flags(params: Thresholds) -> str:
    """Flags of `lineseg extract`."""
    if type(params) is Params:
        return " ".join(f"--{name.replace('_', '-')} {value!r}" for name, value, _ in _values(params)) + "\n"
    values = " ".join(f"{name}={value!r}" for name, value in params.numbers().items())
    return f"--method {method_of(params).name} --set {values}\n"


PARAMS_WRITERS: dict[str, Callable[[Thresholds], str]] = {
    "ros2": ros2_yaml,
    "ros1": ros1_launch,
    "python": python,
    "flags": flags,
}


def params_text(params: Thresholds, format: str, recording: str = "") -> str:
    """`params` in a format of PARAMS_WRITERS, with every threshold, including those at their defaults.

    recording: name of the recording they were set for, told in the file if it is for a node of ROS 2. Raises ValueError
    for an unknown format, and for a ROS 1 launch file of a method that no ROS program has.
    """
    if format not in PARAMS_WRITERS:
        raise ValueError(f"thresholds cannot be written as {format!r}; choose from {', '.join(PARAMS_WRITERS)}.")
    return ros2_yaml(params, recording) if format == "ros2" else PARAMS_WRITERS[format](params)


def _values(params: Thresholds) -> Iterator[tuple[str, int | float, Knob]]:
    for name, _, knob in params.knobs():
        yield name, getattr(params, name), knob


def _ros_values(params: Thresholds) -> list[tuple[str, int | float, Knob]]:
    """The thresholds of the ROS program, and extensions; switches that model a program's behaviour are left out."""
    values = [(name, value, knob) for name, value, knob in _values(params) if knob.ros or knob.extension]
    if not any(knob.ros for _, _, knob in values):
        raise ValueError(
            f"no ROS program has the thresholds of {method_of(params).name}; choose ros2, python or flags."
        )
    return values


def _note(comment: str, knob: Knob) -> str:
    return "  " + comment.format(EXTENSION) if knob.extension else ""


def _yaml(value: int | float) -> str:
    """YAML 1.1 reads 1e-06 as a string, so a float needs a decimal point."""
    text = repr(value).lower()
    return text if isinstance(value, int) or "." in text else text.replace("e", ".0e")
