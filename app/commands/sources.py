"""Live sources on the command line."""

from __future__ import annotations

import os
from importlib.util import find_spec

from lineseg.installation import install_command

from ..bridges.address import EXPECTED, Address, domain_of, is_address

NEEDED = {"ros2": "cyclonedds", "zenoh": "zenoh"}
LIST_SECONDS = 2.0


def address_of(text: str, topic: str | None) -> Address:
    """Raises ValueError if it is none, if what it needs is not installed, or if a variable of ROS cannot be."""
    if not is_address(text):
        raise ValueError(f"{text[:80]!r} is not the address of a robot; {EXPECTED}")
    address = Address(text, topic)
    package = NEEDED.get(address.scheme)
    if package and find_spec(package) is None:
        command = install_command(address.scheme)
        raise ValueError(f"{address.scheme}: needs the package {package}; `{command}` installs it")
    if package and address.domain is None:
        domain_of(os.environ)
    if address.scheme == "ros2":
        from ..bridges.dds_domain import discovery

        discovery(os.environ)
    return address


def list_topics(address: Address) -> bool:
    """Print the laser topics if the address names none and has to; returns whether it did."""
    if address.scheme not in NEEDED or address.topic is not None:
        return False
    offers = _found(address)
    for topic, quality in offers:
        print(f"{address.url}{topic}  {quality}".rstrip())
    if not offers:
        other = ", or ros2://DOMAIN" if address.scheme == "ros2" else ""
        raise ValueError(
            f"no sensor_msgs/LaserScan topic showed up in {LIST_SECONDS:g} s; check that the robot publishes, and its "
            f"domain: ROS_DOMAIN_ID{other}"
        )
    return True


def _found(address: Address) -> list[tuple[str, str]]:
    """Topics, and what is known of how they are published."""
    if address.scheme == "zenoh":
        from ..bridges.zenoh_bridge import zenoh_topics

        return [(offer.topic, "") for offer in zenoh_topics(address.router, domain_of(os.environ), LIST_SECONDS)]
    from ..bridges.dds import laser_topics

    reliabilities, durabilities = ("best effort", "reliable"), ("volatile", "transient local")
    return [
        (each.topic, ", ".join((reliabilities[each.reliable], durabilities[each.kept])))
        for each in laser_topics(address.domain, LIST_SECONDS)
    ]
