"""Addresses of live sources."""

from __future__ import annotations

import pytest
from lineseg_app.bridges.address import Address


@pytest.mark.parametrize(
    ("url", "topic", "id"),
    [
        ("ros2:", None, "live:ros2"),
        ("ros2:/scan", "/scan", "live:ros2/scan"),
        ("ROS2://07/robot1/scan/", "/robot1/scan", "live:ros2:7/robot1/scan"),
        ("zenoh:/scan", "/scan", "live:zenoh/scan"),
        ("zenoh://robot/scan", "/scan", "live:zenoh:robot:7447/scan"),
        ("zenoh://[::1]:7448", None, "live:zenoh:[::1]:7448"),
        ("ws://robot:9090", None, "live:robot:9090"),
        ("ws://robot:9090#/rear", "/rear", "live:robot:9090/rear"),
    ],
)
def test_an_address_says_where_and_which_topic(url: str, topic: str | None, id: str):
    address = Address(url)
    assert (address.topic, address.id) == (topic, id)
    assert Address(address.url, address.topic) == address


@pytest.mark.parametrize(
    ("url", "topic", "words"),
    [
        ("ros2://300/scan", None, "is '300'; a domain of DDS is a whole number from 0 to 232"),
        ("ros2://scan", None, "is 'scan'; a domain of DDS"),
        ("ros2:/a b", None, "'/a b' is not a topic of ROS"),
        ("ros2:/scan", "/rear", "name two topics"),
        ("ws://robot:9090#/scan", "/rear", "name two topics"),
        ("zenoh://robot:99999/scan", None, "is not the address of a Zenoh router"),
        ("ros2:scan", None, "is not the address of a robot; give one like ros2:/scan"),
    ],
)
def test_what_cannot_be_an_address_is_told(url: str, topic: str | None, words: str):
    with pytest.raises(ValueError, match=words):
        Address(url, topic)
