"""Sets thresholds as parameters of a running node over rosbridge, and reads them back."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from websockets.exceptions import WebSocketException

from lineseg import Params

from .address import check_address
from .bridge import why_not
from .heard import list_of
from .rosbridge import RobotError, RosBridge
from .websocket import connected

ALL_SECONDS = 12.0
# rcl_interfaces/msg/ParameterType
NOT_SET, INTEGER, DOUBLE = 0, 2, 3
VALUE_FIELDS = {1: "bool_value", INTEGER: "integer_value", DOUBLE: "double_value", 4: "string_value"}


@dataclass(frozen=True)
class Sent:
    """One parameter: its name, the value sent, the robot's present value (None if unset), and the robot's answer.

    taken: whether the robot now has the value that was sent.
    """

    name: str
    threshold: str
    value: int | float
    now: Any
    taken: bool
    reason: str


def send_params(url: str, node: str, params: Params, ros: int = 2, extensions: bool = False) -> list[Sent]:
    """Set the thresholds of `node` and read them back; refusals are in the result, in the robot's own words.

    extensions: include thresholds that the authors' program does not have. Raises OSError if the robot cannot be
    reached, RobotError if it has no such node.
    """
    check_address(url)
    place = urlsplit(url).netloc
    try:
        with connected(url) as socket:
            bridge = RosBridge(socket, ALL_SECONDS)
            values = dict(_values(params, extensions))
            return (_set_ros1 if ros == 1 else _set_ros2)(bridge, node, values)
    except RobotError as error:
        raise RobotError(f"{place} says: {error}") from None
    except (OSError, WebSocketException) as error:
        raise OSError(why_not(place, error)) from None


def _values(params: Params, extensions: bool) -> Iterator[tuple[str, tuple[str, int | float]]]:
    for field, _, knob in params.knobs():
        if extensions or not knob.extension:
            yield knob.ros or field, (field, getattr(params, field))


def _set_ros2(bridge: RosBridge, node: str, values: dict[str, tuple[str, int | float]]) -> list[Sent]:
    """rcl_interfaces/srv/SetParameters, then GetParameters."""
    parameters = [{"name": name, "value": _value_of(value)} for name, (_, value) in values.items()]
    results = list_of(bridge.call(f"{node}/set_parameters", {"parameters": parameters}).get("results"))
    now = list_of(bridge.call(f"{node}/get_parameters", {"names": list(values)}).get("values"))
    if len(results) != len(values) or len(now) != len(values):
        raise RobotError(f"it sent {len(results)} results and {len(now)} values for {len(values)} parameters")
    answers = [result if isinstance(result, dict) else {} for result in results]
    reasons = ["" if answer.get("successful") else str(answer.get("reason") or "refused") for answer in answers]
    return _sent(values, [_plain(value) for value in now], reasons)


def _set_ros1(bridge: RosBridge, node: str, values: dict[str, tuple[str, int | float]]) -> list[Sent]:
    """Set the ROS 1 parameter server through rosapi; a node reads it when it starts."""
    now, reasons = [], []
    for name, (_, value) in values.items():
        reason = ""
        try:
            bridge.call("/rosapi/set_param", {"name": f"{node}/{name}", "value": json.dumps(value)})
        except RobotError as error:
            reason = str(error)
        reasons.append(reason)
        now.append(_json(bridge.call("/rosapi/get_param", {"name": f"{node}/{name}", "default": ""}).get("value")))
    return _sent(values, now, reasons)


def _sent(values: dict[str, tuple[str, int | float]], now: list[Any], reasons: list[str]) -> list[Sent]:
    rows = zip(values.items(), now, reasons, strict=True)
    return [
        Sent(name, field, value, there, there == value and not reason, reason)
        for (name, (field, value)), there, reason in rows
    ]


def _value_of(value: int | float) -> dict[str, Any]:
    if isinstance(value, int):
        return {"type": INTEGER, "integer_value": value}
    return {"type": DOUBLE, "double_value": value}


def _plain(value: Any) -> Any:
    """The value in a rcl_interfaces/msg/ParameterValue; None if it is not set."""
    field = VALUE_FIELDS.get(value.get("type", NOT_SET)) if isinstance(value, dict) else None
    return value.get(field) if field else None


def _json(text: Any) -> Any:
    try:
        return json.loads(text)
    except (TypeError, ValueError):
        return text or None
